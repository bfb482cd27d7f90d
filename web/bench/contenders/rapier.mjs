import RAPIER from "@dimforge/rapier2d-simd-compat";

export const name = "rapier2d";

export async function build({ points, sticks, gravity, dt, substeps }) {
    await RAPIER.init();
    const world = new RAPIER.World({ x: 0, y: gravity });
    world.timestep = dt;
    world.numSolverIterations = substeps;
    const bodies = points.map(({ x, y, mass, isPinned }) => world.createRigidBody(
        (isPinned ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic()).setTranslation(x, y).setCanSleep(false)
            .setAdditionalMassProperties(mass, { x: 0, y: 0 }, mass * 1e-4).lockRotations()));
    const origin = { x: 0, y: 0 };
    for (const { a, b, length } of sticks)
        world.createImpulseJoint(RAPIER.JointData.rope(length, origin, origin), bodies[a], bodies[b], true);
    return {
        step: () => world.step(),
        position: (i) => [bodies[i].translation().x, bodies[i].translation().y],
    };
}
