import { Handle } from "./handle.js";
import { constraintState, event, figure as figureLayout, info as infoLayout, particleState, report, view } from "./layout.js";

/** Numbers of sinew_column in bindings/c/sinew.h. */
const column = { position: 0, previous: 1, velocity: 2, inverseMass: 3, radius: 4, figure: 5, ends: 6, mobility: 7, asleep: 8, tension: 9, strain: 10, triangles: 11 };

/** What can be read of a running scene. */
export class Readable extends Handle {
    constructor(engine, handle) {
        super(engine, handle);
        const info = this.info();
        Object.assign(this, {
            dimension: info.dimension, precision: info.precision, rate: info.rate, seconds: info.seconds,
            size: info.size, yIsDown: info.yIsDown, isReadOnly: info.isReadOnly,
        });
    }

    info() {
        const { realBytes, isClassic, yIsDown, readOnly, viewWidth, viewHeight, ...info } =
            this.engine.data.read(infoLayout, this.ask("sinew_world_get_info"));
        return { ...info, precision: realBytes === 4 ? "float" : "double", isClassic: isClassic !== 0, yIsDown: yIsDown !== 0,
            isReadOnly: readOnly !== 0, size: [viewWidth, viewHeight] };
    }

    get particleCount() { return this.info().particles; }
    get constraintCount() { return this.info().constraints; }
    get asleepCount() { return this.info().asleep; }

    hash() {
        return this.engine.data.id(this.ask("sinew_world_state_hash")).toString(16).padStart(16, "0");
    }

    report() {
        return this.engine.data.read(report, this.ask("sinew_world_get_report"));
    }

    events(since = 0) {
        const { data } = this.engine;
        const count = data.uint(this.ask("sinew_world_event_count"));
        return Array.from({ length: Math.max(0, count - since) }, (_, i) => data.read(event, this.ask("sinew_world_event_at", since + i)));
    }

    column(number) {
        const { data } = this.engine;
        const { data: address, rows, components, numberBytes, isInteger } = data.read(view, this.ask("sinew_world_get_column", number));
        const Numbers = isInteger ? Uint32Array : numberBytes === 4 ? Float32Array : Float64Array;
        return rows === 0 ? new Numbers(0) : new Numbers(data.buffer, address, rows * components);
    }

    get positions() { return this.column(column.position); }
    get previous() { return this.column(column.previous); }
    get velocities() { return this.column(column.velocity); }
    get inverseMasses() { return this.column(column.inverseMass); }
    get mobilities() { return this.column(column.mobility); }
    get radii() { return this.column(column.radius); }
    get figureIndices() { return this.column(column.figure); }
    get ends() { return this.column(column.ends); }
    get sleepers() { return this.column(column.asleep); }
    get tensions() { return this.column(column.tension); }
    get strains() { return this.column(column.strain); }
    get triangles() { return this.column(column.triangles); }

    figures() {
        const { data } = this.engine;
        const figures = [];
        for (let index = 0; index < this.info().figures; ++index) {
            if (!this.engine.finds("sinew_world_figure_at", this.handle, index, data.result)) continue;
            const { isQuarantined, ...figure } = data.read(figureLayout, data.result);
            figures.push({ index, ...figure, isQuarantined: isQuarantined !== 0 });
        }
        return figures;
    }

    /** Index of a figure by name; an index is returned as it is. */
    figure(which) {
        if (typeof which === "number") return which;
        return this.engine.data.within((arena) => this.engine.data.uint(this.ask("sinew_world_find_figure", arena.text(which))));
    }

    /** Rows of the particles of a figure, in their order. */
    rowsOf(figure) {
        const index = this.figure(figure), rows = [];
        this.figureIndices.forEach((of, row) => of === index && rows.push(row));
        return Uint32Array.from(rows);
    }

    /** The id of a particle by name or row; an id is returned as it is. */
    particle(which) {
        if (typeof which === "bigint") return which;
        if (typeof which === "number") return this.engine.data.id(this.ask("sinew_world_particle_at", which));
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_world_find_particle", arena.text(which))));
    }

    constraint(which) {
        if (typeof which === "bigint") return which;
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_world_find_constraint", arena.text(which))));
    }

    kind(which) {
        if (typeof which === "number") return which;
        const number = this.engine.kinds(this.dimension).findIndex((kind) => kind.name === which);
        if (number < 0) throw new RangeError(`no kind of constraint of ${this.dimension} dimensions is called "${which}"`);
        return number;
    }

    nameOf(particle) {
        return this.engine.data.textFrom(this.ask("sinew_world_particle_name", this.particle(particle)));
    }

    stateOf(particle) {
        const { position, velocity, isAsleep, ...state } = this.engine.data.read(particleState, this.ask("sinew_world_get_particle", this.particle(particle)));
        return { position: position.slice(0, this.dimension), velocity: velocity.slice(0, this.dimension), ...state, isAsleep: isAsleep !== 0 };
    }

    loadOf(constraint) {
        return this.engine.data.read(constraintState, this.ask("sinew_world_get_constraint", this.constraint(constraint)));
    }

    constraintsOf(kind) {
        const number = this.kind(kind);
        const count = this.engine.data.uint(this.ask("sinew_world_constraint_count", number));
        return Array.from({ length: count }, (_, row) => this.engine.data.id(this.ask("sinew_world_constraint_at", number, row)));
    }
}
