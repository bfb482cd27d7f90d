// scene_hashes.mjs STEPS THREADS: as web/sinew/tools/scene_hashes.mjs, in Chromium.
import path from "node:path";
import { text } from "node:stream/consumers";
import { desktop, visit } from "./browser.mjs";

const [steps, threads] = process.argv.slice(2).map(Number);
const variants = (await text(process.stdin)).trim().split("\n").map((line) => line.split(" "));
const isolated = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
const site = await visit(path.resolve(import.meta.dirname, "../sinew"), isolated);
await site.on(desktop, "", async (page) => {
    await page.evaluate(async ([address, threads]) => {
        const { catalogue, load, loadFloat } = await import(address);
        window.scenes = new Map((await catalogue()).map((scene) => [scene.name, scene]));
        window.engine = await loadFloat(await load(undefined, { threads }));
    }, [`${site.address}index.js`, threads]);
    for (const variant of variants)
        console.log(await page.evaluate(([[name, mode, precision], steps]) => {
            const scene = window.scenes.get(name), simulation = window.engine.open(scene.text, { ...scene, overrides: { mode, precision } });
            simulation.step(steps);
            const hash = simulation.hash();
            simulation.dispose();
            return hash;
        }, [variant, steps]));
});
await site.end();
