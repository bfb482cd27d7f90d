import { Handle } from "./handle.js";

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
        const { data } = this.engine;
        const at = this.ask("sinew_get_info");
        const uint = (offset) => data.uint(at + offset);
        return {
            dimension: uint(0), precision: uint(4) === 4 ? "float" : "double", particles: uint(8), constraints: uint(12),
            figures: uint(16), isClassic: uint(20) !== 0, yIsDown: uint(24) !== 0, isReadOnly: uint(28) !== 0,
            rate: data.double(at + 32), seconds: data.double(at + 40), perMetre: data.double(at + 48),
            perKilogram: data.double(at + 56), perSecond: data.double(at + 64), size: [uint(72), uint(76)], asleep: uint(80),
        };
    }

    get particleCount() { return this.info().particles; }
    get constraintCount() { return this.info().constraints; }
    get asleepCount() { return this.info().asleep; }

    hash() {
        return this.engine.data.id(this.ask("sinew_state_hash")).toString(16).padStart(16, "0");
    }

    report() {
        const at = this.ask("sinew_get_report");
        const names = ["seconds", "steps", "kinetic", "potential", "stored", "energyLost", "stretchMax", "stretchMean", "maxSpeed"];
        return Object.fromEntries(names.map((name, i) => [name, this.engine.data.double(at + 8 * i)]));
    }

    events(since = 0) {
        const { data } = this.engine;
        const count = data.uint(this.ask("sinew_event_count"));
        return Array.from({ length: Math.max(0, count - since) }, (_, i) => {
            const at = this.ask("sinew_event_at", since + i);
            return { seconds: data.double(at), what: data.textFrom(at + 8), where: data.textFrom(at + 12), islands: data.uint(at + 16),
                with: data.textFrom(at + 20), impulse: data.double(at + 24) };
        });
    }

    column(number) {
        const { data } = this.engine;
        const at = this.ask("sinew_get_column", number);
        const [address, rows, components, bytes, isInteger] = [0, 4, 8, 12, 16].map((offset) => data.uint(at + offset));
        const Numbers = isInteger ? Uint32Array : bytes === 4 ? Float32Array : Float64Array;
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
            if (!this.engine.finds("sinew_figure_at", this.handle, index, data.result)) continue;
            const at = data.result;
            figures.push({ index, name: data.textFrom(at), prefab: data.textFrom(at + 4), particles: data.uint(at + 8),
                isQuarantined: data.uint(at + 12) !== 0 });
        }
        return figures;
    }

    /** Index of a figure by name; an index is returned as it is. */
    figure(which) {
        if (typeof which === "number") return which;
        return this.engine.data.within((arena) => this.engine.data.uint(this.ask("sinew_find_figure", arena.text(which))));
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
        if (typeof which === "number") return this.engine.data.id(this.ask("sinew_particle_at", which));
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_find_particle", arena.text(which))));
    }

    constraint(which) {
        if (typeof which === "bigint") return which;
        return this.engine.data.within((arena) => this.engine.data.id(this.ask("sinew_find_constraint", arena.text(which))));
    }

    kind(which) {
        if (typeof which === "number") return which;
        const number = this.engine.kinds(this.dimension).findIndex((kind) => kind.name === which);
        if (number < 0) throw new RangeError(`no kind of constraint of ${this.dimension} dimensions is called "${which}"`);
        return number;
    }

    nameOf(particle) {
        return this.engine.data.textFrom(this.ask("sinew_particle_name", this.particle(particle)));
    }

    stateOf(particle) {
        const { data } = this.engine;
        const at = this.ask("sinew_get_particle", this.particle(particle));
        const vector = (from) => Array.from({ length: this.dimension }, (_, i) => data.double(at + from + 8 * i));
        return { position: vector(0), velocity: vector(24), inverseMass: data.double(at + 48), radius: data.double(at + 56),
            figure: data.uint(at + 64), isAsleep: data.uint(at + 68) !== 0 };
    }

    loadOf(constraint) {
        const { data } = this.engine;
        const at = this.ask("sinew_get_constraint", this.constraint(constraint));
        const [measure, error, strain, tension] = [0, 8, 16, 24].map((offset) => data.double(at + offset));
        return { measure, error, strain, tension };
    }

    constraintsOf(kind) {
        const number = this.kind(kind);
        const count = this.engine.data.uint(this.ask("sinew_constraint_count", number));
        return Array.from({ length: count }, (_, row) => this.engine.data.id(this.ask("sinew_constraint_at", number, row)));
    }
}
