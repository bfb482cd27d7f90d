import Box2DFactory from "box2d3-wasm";

export const name = "box2d3-wasm";

export async function build({ points, sticks, gravity, dt, substeps }) {
    const b2 = await Box2DFactory({ pthreadCount: 0 });
    const world = makeWorld(b2, gravity);
    const bodies = points.map((point) => makeBody(b2, world, point));
    for (const { a, b, length } of sticks) {
        const joint = b2.b2DefaultDistanceJointDef();
        joint.base.bodyIdA = bodies[a];
        joint.base.bodyIdB = bodies[b];
        joint.length = length;
        b2.b2CreateDistanceJoint(world, joint);
    }
    return {
        step: () => b2.b2World_Step(world, dt, substeps),
        position(i) {
            const { x, y } = b2.b2Body_GetPosition(bodies[i]);
            return [x, y];
        },
    };
}

function makeWorld(b2, gravity) {
    const definition = b2.b2DefaultWorldDef();
    definition.gravity = new b2.b2Vec2(0, gravity);
    definition.enableSleep = false;
    return b2.b2CreateWorld(definition);
}

function makeBody(b2, world, { x, y, mass, isPinned }) {
    const definition = b2.b2DefaultBodyDef();
    definition.type = isPinned ? b2.b2BodyType.b2_staticBody : b2.b2BodyType.b2_dynamicBody;
    definition.position = new b2.b2Vec2(x, y);
    definition.motionLocks.angularZ = true;
    const body = b2.b2CreateBody(world, definition);
    const masses = new b2.b2MassData();
    masses.mass = mass;
    masses.rotationalInertia = 0;
    if (!isPinned) b2.b2Body_SetMassData(body, masses);
    return body;
}
