import Matter from "matter-js";

export const name = "matter-js";

/** Pixels a metre: matter-js is tuned for bodies of tens of pixels. */
const scale = 100;

export async function build({ points, sticks, gravity, dt, substeps }) {
    const engine = Matter.Engine.create({ constraintIterations: substeps, positionIterations: 1, velocityIterations: 1 });
    engine.gravity.y = 1;
    engine.gravity.scale = -gravity * scale * 1e-6; // pixels per millisecond squared
    const bodies = points.map(({ x, y, mass, isPinned }) => Matter.Bodies.circle(x * scale, -y * scale, 1,
        { mass, isStatic: isPinned, frictionAir: 0, collisionFilter: { mask: 0 } }));
    const constraints = sticks.map(({ a, b, length }) =>
        Matter.Constraint.create({ bodyA: bodies[a], bodyB: bodies[b], length: length * scale, stiffness: 1 }));
    Matter.Composite.add(engine.world, [...bodies, ...constraints]);
    return {
        step: () => Matter.Engine.update(engine, dt * 1000),
        position: (i) => [bodies[i].position.x / scale, -bodies[i].position.y / scale],
    };
}
