// scene_hashes.mjs STEPS THREADS: hashes of scenes after so many steps, by the modules beside; a line "scene mode precision" of
// standard input each. tools/renew_determinism compares them with those of native programs.
import { text } from "node:stream/consumers";
import { catalogue, load, loadFloat } from "../index.js";

const [steps, threads] = process.argv.slice(2).map(Number);
const scenes = new Map((await catalogue()).map((scene) => [scene.name, scene]));
const engine = await loadFloat(await load(undefined, { threads }));
for (const line of (await text(process.stdin)).trim().split("\n")) {
    const [name, mode, precision] = line.split(" "), scene = scenes.get(name);
    const simulation = engine.open(scene.text, { ...scene, overrides: { mode, precision } });
    simulation.step(steps);
    console.log(simulation.hash());
    simulation.dispose();
}
process.exit(); // workers of several threads wait for more
