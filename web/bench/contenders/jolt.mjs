// A soft body of Jolt: its iterations are substeps with one pass of XPBD each.
import makeJolt from "jolt-physics/wasm-compat";

export const name = "jolt-physics";

export async function build(work) {
    return softBody(await makeJolt(), work, () => {});
}

/** `more` adds to the shared settings. */
export function softBody(Jolt, { points, sticks, gravity, dt, substeps }, more) {
    const jolt = new Jolt.JoltInterface(oneLayer(Jolt));
    const system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
    system.SetGravity(new Jolt.Vec3(0, gravity, 0));
    const shared = new Jolt.SoftBodySharedSettings();
    for (const { x, y, mass, isPinned } of points) {
        const vertex = new Jolt.SoftBodySharedSettingsVertex();
        vertex.mPosition = new Jolt.Float3(x, y, 0);
        vertex.mInvMass = isPinned ? 0 : 1 / mass;
        shared.mVertices.push_back(vertex);
    }
    for (const { a, b } of sticks) shared.mEdgeConstraints.push_back(new Jolt.SoftBodySharedSettingsEdge(a, b, 0));
    more(shared);
    shared.CalculateEdgeLengths();
    shared.Optimize();
    const creation = new Jolt.SoftBodyCreationSettings(shared, new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1), 0);
    creation.mNumIterations = substeps;
    creation.mUpdatePosition = false;
    creation.mLinearDamping = 0;
    creation.mAllowSleeping = false;
    creation.mMaxLinearVelocity = 1e6;
    const body = bodies.CreateSoftBody(creation);
    bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
    return {
        step: () => jolt.Step(dt, 1),
        position(i) {
            const at = motion.GetVertex(i).mPosition;
            return [at.GetX(), at.GetY()];
        },
    };
}

function oneLayer(Jolt) {
    const settings = new Jolt.JoltSettings();
    const pairs = new Jolt.ObjectLayerPairFilterTable(1), layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
    layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
    return settings;
}
