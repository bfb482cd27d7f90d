import { load } from "sinew";

load().then((engine) => {
    const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] } });
    simulation.addFigure("rope", { length: 2, segments: 20, weight: 5 });
    simulation.runUntil(10);
    postMessage(`the weight hangs at ${simulation.stateOf("rope/end").position[1].toFixed(3)}`);
});
