// A page of a game: a bundler takes it, a rope hangs on it, and it says where the weight is.
import { load } from "sinew";

const engine = await load();
const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] } });
simulation.addFigure("rope", { length: 2, segments: 20, weight: 5 });
simulation.runUntil(10);
document.body.textContent = `the weight hangs at ${simulation.stateOf("rope/end").position[1].toFixed(3)}`;
