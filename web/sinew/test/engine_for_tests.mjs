// One engine for the tests of a file, and a scene small enough to know its motion.
import { readFile } from "node:fs/promises";
import { load, loadFloat } from "../index.js";

export const moduleBytes = await readFile(new URL("../sinew.wasm", import.meta.url));
export const floatBytes = await readFile(new URL("../sinew-float.wasm", import.meta.url));
export const engine = await loadFloat(await load(moduleBytes), floatBytes);

/** A pendulum of one metre in metres and seconds, let go level with its pin. */
export const pendulum = {
    sinew: 1,
    view: { center: [0, 0], height: 4, size: [400, 400] },
    world: { gravity: [0, -10] },
    figures: [{
        name: "pendulum",
        particles: { pivot: { at: [0, 0], pinned: true }, bob: { at: [1, 0] } },
        constraints: [{ name: "rod", between: ["pivot", "bob"] }],
    }],
};
