// verlet-js knows no masses: the rope's weight is as light as its other points. It is made for pages, and asks for a window and a canvas.
export const name = "verlet-js";

async function library() {
    const isBare = globalThis.window === undefined;
    if (isBare) globalThis.window = {};
    const { default: VerletJS } = await import("verlet-js");
    if (isBare) delete globalThis.window;
    return VerletJS;
}

/** Pixels a metre. */
const scale = 100;

export async function build({ points, sticks, gravity, dt, substeps }) {
    const VerletJS = await library(), { Composite, Particle, DistanceConstraint, Vec2 } = VerletJS;
    const simulation = new VerletJS(1e9, 1e9, { getContext: () => null });
    simulation.gravity = new Vec2(0, -gravity * dt * dt * scale);
    simulation.friction = 1;
    simulation.bounds = () => {};
    const all = new Composite();
    all.particles = points.map(({ x, y }) => new Particle(new Vec2(x * scale, -y * scale)));
    all.constraints = sticks.map(({ a, b, length }) => new DistanceConstraint(all.particles[a], all.particles[b], 1, length * scale));
    points.forEach(({ isPinned }, i) => isPinned && all.pin(i));
    simulation.composites.push(all);
    return {
        step: () => simulation.frame(substeps),
        position: (i) => [all.particles[i].pos.x / scale, -all.particles[i].pos.y / scale],
    };
}
