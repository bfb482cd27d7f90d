import { Circle, DistanceJoint, Vec2, World } from "planck";

export const name = "planck";

export async function build({ points, sticks, gravity, dt, substeps }) {
    const world = new World({ gravity: new Vec2(0, gravity) });
    const bodies = points.map(({ x, y, mass, isPinned }) => {
        const body = world.createBody({ type: isPinned ? "static" : "dynamic", position: new Vec2(x, y), fixedRotation: true });
        body.createFixture({ shape: new Circle(0.01), density: 1, filterMaskBits: 0 });
        body.setMassData({ mass, center: new Vec2(0, 0), I: 0 });
        return body;
    });
    for (const { a, b, length } of sticks)
        world.createJoint(new DistanceJoint({ length }, bodies[a], bodies[b], bodies[a].getPosition(), bodies[b].getPosition()));
    return {
        step: () => world.step(dt, substeps, substeps),
        position: (i) => [bodies[i].getPosition().x, bodies[i].getPosition().y],
    };
}
