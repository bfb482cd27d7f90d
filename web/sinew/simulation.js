import { valueText } from "./engine.js";
import { constraintSpec, contact, controls as controlsLayout, footing, forceSpec as forceLayout, particleSpec, point as pointLayout, rayHit, region } from "./layout.js";
import { Picture } from "./picture.js";
import { Readable } from "./readable.js";
import { colliderSpec, figureSpec, forceKinds, forceSpec, parameterList } from "./specs.js";

/** Numbers of sinew_phase. */
const phases = ["begin", "persist", "end"];

/** Ids and indices of nothing in bindings/c/sinew.h. */
const noId = 0xffffffffffffffffn, noFigure = 0xffffffff;

/** A running scene without a pointer, or the scene of a player for reading. */
export class Simulation extends Readable {
    step(count = 1) { this.call("sinew_world_step", count); }
    runUntil(seconds) { this.call("sinew_world_run_until", seconds); }
    restart() { this.call("sinew_world_restart"); }

    copy() {
        return new Simulation(this.engine, this.engine.data.uint(this.ask("sinew_world_copy")));
    }

    /** The bytes of the simulation in its present state, for Engine.load(). */
    save() {
        const { data } = this.engine;
        this.call("sinew_world_save", data.result, data.result + 4);
        return new Uint8Array(data.buffer, data.uint(data.result), data.uint(data.result + 4)).slice();
    }

    dispose() {
        if (this.isClosed || this.isReadOnly) return;
        this.isClosed = true;
        this.call("sinew_world_close");
    }

    // --- contacts and queries -------------------------------------------------------------------------------------

    listContacts(on = true) { this.call("sinew_world_list_contacts", on ? 1 : 0); }

    contacts() {
        const { data } = this.engine;
        const count = data.uint(this.ask("sinew_world_contact_count"));
        const orNull = (number, nothing) => (number === nothing ? null : number);
        return Array.from({ length: count }, (_, index) => {
            const { phase, other, collider, figure, otherFigure, point, normal, ...more } = data.read(contact, this.ask("sinew_world_contact_at", index));
            const vector = (numbers) => numbers.slice(0, this.dimension);
            return { phase: phases[phase], ...more, other: orNull(other, noId), collider: orNull(collider, noId), figure: orNull(figure, noFigure),
                otherFigure: orNull(otherFigure, noFigure), point: vector(point), normal: vector(normal) };
        });
    }

    /** Calls a query that finds something or nothing, with a point or more; null for nothing. */
    found(name, point, given, read) {
        const { data } = this.engine;
        return data.within((arena) => {
            const values = [point, ...given].map((value) => (Array.isArray(value) ? arena.point(value) : value));
            return this.engine.finds(name, this.handle, ...values) ? read(data.result) : null;
        });
    }

    nearestParticle(point, reach) {
        const { data } = this.engine;
        const at = data.result;
        return this.found("sinew_world_nearest_particle", point, [reach, at, at + 8],
            () => ({ particle: data.id(at), distance: data.double(at + 8) }));
    }

    nearestLink(point, reach) {
        const { data } = this.engine;
        const at = data.result;
        return this.found("sinew_world_nearest_link", point, [reach, at, at + 8, at + 16],
            () => ({ link: data.id(at), t: data.double(at + 8), distance: data.double(at + 16) }));
    }

    castRay(from, to, { radius = 0, mask = 0xffffffff } = {}) {
        const { data } = this.engine;
        const vector = (numbers) => numbers.slice(0, this.dimension);
        return data.within((arena) => {
            if (!this.engine.finds("sinew_world_cast_ray", this.handle, arena.point(from), arena.point(to), radius, mask, data.result)) return null;
            const { share, point, normal, particle, collider } = data.read(rayHit, data.result);
            return { share, point: vector(point), normal: vector(normal),
                particle: particle === noId ? null : particle, collider: collider === noId ? null : collider };
        });
    }

    overlapping(name, { center, half = [0, 0, 0], radius = 0, turn = 0, axis = [0, 0, 0] }) {
        const { data } = this.engine;
        return data.within((arena) => {
            const within = arena.struct(region, { center, half, radius, turn, axis });
            const count = data.uint(this.ask(name, within, 0, 0));
            const ids = arena.ids(new Array(count).fill(0n));
            this.call(name, within, ids, count, data.result);
            return Array.from({ length: count }, (_, i) => data.id(ids + 8 * i));
        });
    }

    particlesIn(region) { return this.overlapping("sinew_world_overlapping_particles", region); }
    linksIn(region) { return this.overlapping("sinew_world_overlapping_links", region); }

    collider(which) {
        if (typeof which === "bigint") return which;
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_world_find_collider", arena.text(which))));
    }

    moveCollider(collider, position, turn = 0, axis = [0, 0, 0]) {
        const id = this.collider(collider);
        this.engine.data.within((arena) =>
            this.call("sinew_world_move_collider", id, arena.point(position), turn, arena.point(axis)));
    }

    addCollider(collider) {
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_world_add_collider", colliderSpec(arena, collider))));
    }

    removeCollider(collider) { this.call("sinew_world_remove_collider", this.collider(collider)); }

    // --- forces ---------------------------------------------------------------------------------------------------

    addForce(force) {
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_world_add_force", forceSpec(arena, force))));
    }

    setForce(force, values) {
        this.engine.data.within((arena) => this.call("sinew_world_set_force", force, forceSpec(arena, { ...this.force(force), ...values })));
    }

    force(force) {
        const { kind, ...values } = this.engine.data.read(forceLayout, this.ask("sinew_world_get_force", force));
        return { kind: forceKinds[kind], ...values };
    }

    removeForce(force) { this.call("sinew_world_remove_force", force); }

    forces() {
        const { data } = this.engine, ids = [];
        while (this.engine.finds("sinew_world_force_at", this.handle, ids.length, data.result)) ids.push(data.id(data.result));
        return ids;
    }

    // --- edits ----------------------------------------------------------------------------------------------------

    addFigure(prefab, figure = {}) {
        return this.engine.data.within((arena) => this.engine.data.uint(this.ask("sinew_world_add_figure", figureSpec(arena, prefab, figure))));
    }

    setFigure(figure, values) {
        const index = this.figure(figure);
        this.engine.data.within((arena) => {
            const { parameters, parameterCount } = parameterList(arena, values);
            this.call("sinew_world_set_figure", index, parameters, parameterCount);
        });
    }

    removeFigure(figure) { this.call("sinew_world_remove_figure", this.figure(figure)); }

    addParticle({ position, velocity = [0, 0, 0], mass = 1, radius = 0 }) {
        return this.engine.data.within((arena) =>
            this.engine.data.id(this.ask("sinew_world_add_particle", arena.struct(particleSpec, { position, velocity, mass, radius }))));
    }

    removeParticle(particle) { this.call("sinew_world_remove_particle", this.particle(particle)); }

    addConstraint(kind, particles, spec = {}) {
        const { low, high, compliance = 0, maxForce = 0, breakingStrain = 0 } = spec;
        const isMeasured = low === undefined && high === undefined;
        const limits = isMeasured ? { low: 1, high: 0 } : { low: low ?? -Infinity, high: high ?? Infinity };
        const number = this.kind(kind);
        const members = particles.map((particle) => this.particle(particle));
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_world_add_constraint", number, arena.ids(members),
            members.length, arena.struct(constraintSpec, { ...limits, compliance, maxForce, breakingStrain }))));
    }

    removeConstraint(constraint) { this.call("sinew_world_remove_constraint", this.constraint(constraint)); }

    /** Calls a function with an id and a point. */
    at(name, id, point) {
        this.engine.data.within((arena) => this.call(name, id, arena.point(point)));
    }

    setPosition(particle, position) { this.at("sinew_world_set_position", this.particle(particle), position); }
    setVelocity(particle, velocity) { this.at("sinew_world_set_velocity", this.particle(particle), velocity); }
    setMass(particle, mass) { this.call("sinew_world_set_mass", this.particle(particle), mass); }
    applyForce(particle, force) { this.at("sinew_world_apply_force", this.particle(particle), force); }
    applyImpulse(particle, impulse) { this.at("sinew_world_apply_impulse", this.particle(particle), impulse); }
    pin(particle) { return this.engine.data.id(this.ask("sinew_world_pin_particle", this.particle(particle))); }
    movePin(pin, target) { this.at("sinew_world_move_pin", pin, target); }
    unpin(pin) { this.call("sinew_world_unpin", pin); }

    // --- characters and cars --------------------------------------------------------------------------------------

    steer(figure, controls = null) {
        const index = this.figure(figure);
        this.engine.data.within((arena) => this.call("sinew_world_steer", index, controls ? arena.struct(controlsLayout, controls) : 0));
    }

    footing(figure) {
        const { onGround, isHolding, figure: on } = this.engine.data.read(footing, this.ask("sinew_world_get_footing", this.figure(figure)));
        return { onGround: onGround !== 0, isHolding: isHolding !== 0, figure: on === noFigure ? null : on };
    }

    // --- pointer --------------------------------------------------------------------------------------------------

    grab(at, radius = 0) {
        if (!Array.isArray(at)) return this.engine.finds("sinew_world_grab_particle", this.handle, this.particle(at));
        return this.engine.data.within((arena) => this.engine.finds("sinew_world_grab", this.handle, arena.point(at), radius));
    }

    pick(from, to, radius = 0) {
        const { data } = this.engine, at = data.result;
        return this.found("sinew_world_pick", from, [to, radius, at, at + 8], () => ({ particle: data.id(at), share: data.double(at + 8) }));
    }

    addGrab(particle) { return this.engine.data.id(this.ask("sinew_world_add_grab", this.particle(particle))); }
    moveGrab(grab, to) { this.at("sinew_world_move_grab", grab, to); }
    removeGrab(grab) { this.call("sinew_world_remove_grab", grab); }

    drag(to) { this.engine.data.within((arena) => this.call("sinew_world_drag", arena.point(to))); }
    letGo() { this.call("sinew_world_let_go"); }
    pointAt(at) { this.engine.data.within((arena) => this.call("sinew_world_point_at", arena.point(at))); }

    cut(from, to) {
        const { data } = this.engine;
        return data.within((arena) => data.uint(this.ask("sinew_world_cut", arena.point(from), arena.point(to))));
    }

    // --- the scene ------------------------------------------------------------------------------------------------

    sceneText() { return this.engine.data.textFrom(this.ask("sinew_world_scene_text")); }
    parameters() { return JSON.parse(this.engine.data.textFrom(this.ask("sinew_world_parameters"))); }

    set(path, value) {
        this.engine.data.within((arena) => this.call("sinew_world_set", arena.text(`${path}=${valueText(value)}`)));
    }

    // --- picture --------------------------------------------------------------------------------------------------

    draw(width = this.size[0], height = this.size[1], overlays = 0) {
        const at = this.ask("sinew_world_draw", width, height, this.engine.overlayBits(overlays));
        return new Picture(this.engine, at, this.handle, "sinew_world_picture_text", "sinew_world_picture_image");
    }

    toScene([x, y], width = this.size[0], height = this.size[1]) {
        const at = this.ask("sinew_world_unproject", width, height, x, y);
        return this.engine.data.value(pointLayout, at).slice(0, this.dimension);
    }

    toPixel(position, width = this.size[0], height = this.size[1]) {
        const { data } = this.engine;
        return data.within((arena) => {
            this.call("sinew_world_project", width, height, arena.point(position), data.result, data.result + 8);
            return [data.double(data.result), data.double(data.result + 8)];
        });
    }
}

if (Symbol.dispose) Simulation.prototype[Symbol.dispose] = Simulation.prototype.dispose;
