import { createRequire } from "node:module";

export const name = "verlet-js";

/** Pixels a metre. */
const scale = 100;

export async function build({ points, sticks, gravity, dt, substeps }) {
    const VerletJS = createRequire(import.meta.url)("verlet-js");
    const { Particle, Vec2 = VerletJS.Vec2 } = VerletJS;
    const canvas = { getContext: () => ({}) };
    const world = new VerletJS(1e6, 1e6, Object.assign(canvas, { onmousedown: null }));
    world.gravity = new Vec2(0, -gravity * scale * dt * dt);
    world.friction = 1;
    world.bounds = () => {};
    const all = new VerletJS.Composite();
    all.particles = points.map(({ x, y }) => new Particle(new Vec2(x * scale, -y * scale)));
    all.constraints = sticks.map(({ a, b, length }) =>
        new VerletJS.DistanceConstraint(all.particles[a], all.particles[b], 1, length * scale));
    points.forEach(({ isPinned }, i) => isPinned && all.pin(i));
    world.composites.push(all);
    return {
        step: () => world.frame(substeps),
        position: (i) => [all.particles[i].pos.x / scale, -all.particles[i].pos.y / scale],
    };
}
