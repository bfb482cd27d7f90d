// node bench/frames.mjs [WORD [PAINTER...]]: what a frame of every scene of the catalogue costs in Chromium on software GL, as a table
// in Markdown; painters are webgl2 and canvas2d. A frame is a step of the player, its picture, and the painting until the last pixel is
// there. It is measured where the steps of a scene take longest: when the man lies in his hammock, not while he falls. Processor
// time counts every process of the browser, so that neighbours on a busy machine hardly matter.
import os from "node:os";
import path from "node:path";
import { visit } from "../tests/browser.mjs";

const size = [960, 640];
const frames = 24;
const [wanted = "", ...painters] = process.argv.slice(2);
const kinds = ["nothing", ...(painters.length > 0 ? painters : ["webgl2", "canvas2d"])];

/** Runs in the page: players and painters of all kinds. */
async function begin([width, height]) {
    const { load, loadFloat, catalogue, Canvas2DPainter, WebGL2Painter } = await import("./index.js");
    const engine = await loadFloat(await load());
    const canvas = () => Object.assign(document.createElement("canvas"), { width, height });
    const kinds = {
        webgl2() {
            const painter = new WebGL2Painter(canvas()), pixel = new Uint8Array(4);
            return { painter, finish: () => painter.gl.readPixels(0, 0, 1, 1, painter.gl.RGBA, painter.gl.UNSIGNED_BYTE, pixel) };
        },
        canvas2d() {
            const context = canvas().getContext("2d", { alpha: false, willReadFrequently: true }); // as the playground, where GL is software
            return { painter: new Canvas2DPainter(context), finish: () => context.getImageData(0, 0, 1, 1) };
        },
        nothing: () => ({ painter: { paint() {}, setImage() {} }, finish() {} }),
    };
    Object.assign(window, { engine, scenes: await catalogue(), kinds, size: [width, height] });
    return window.scenes.map(({ name }) => name);
}

async function open([name, kind]) {
    const scene = window.scenes.find((one) => one.name === name);
    window.player?.dispose();
    window.painter?.gl?.getExtension("WEBGL_lose_context")?.loseContext();
    const { painter, finish } = window.kinds[kind](); // a canvas of its own: what one scene does to it harms no other
    window.player = window.engine.play(scene.text, scene);
    window.player.resize(...window.size, 1);
    for (const image of Object.keys(scene.images))
        painter.setImage(image, await createImageBitmap(await (await fetch(`images/${image}`)).blob()));
    Object.assign(window, { painter, finish, opened: name });
}

/** Frames until the half second of a scene whose steps and pictures take longest, in windows of so many. */
function busiest(count) {
    const { scenes, player } = window, { seconds } = scenes.find(({ name }) => name === window.opened), times = [];
    for (let i = 0; i < Math.max(seconds * 60, 2 * count); ++i) {
        const begun = performance.now();
        player.advance(1 / 60);
        player.draw();
        times.push(performance.now() - begun);
    }
    const middle = (begin) => times.slice(begin, begin + count).sort((a, b) => a - b)[count >> 1];
    let found = 0;
    for (let begin = 0; begin + count <= times.length; begin += count >> 1) if (middle(begin) > middle(found)) found = begin;
    return found;
}

function goTo(frame) {
    for (let i = 0; i < frame; ++i) window.player.advance(1 / 60);
}

/** Milliseconds of so many frames, the median. */
function run(count) {
    const { painter, finish } = window, times = [];
    for (let i = 0; i < count; ++i) {
        const begun = performance.now();
        window.player.advance(1 / 60);
        painter.paint(window.player.draw());
        finish();
        times.push(performance.now() - begun);
    }
    return times.sort((a, b) => a - b)[count >> 1];
}

const site = await visit(path.resolve(import.meta.dirname, "../sinew"));
const devtools = await site.browser.newBrowserCDPSession();
const processorTime = async () => (await devtools.send("SystemInfo.getProcessInfo")).processInfo.reduce((sum, { cpuTime }) => sum + cpuTime * 1000, 0);

const page = await site.browser.newPage();
await page.goto(site.address);
const names = (await page.evaluate(begin, size)).filter((name) => name.includes(wanted));
console.log(`${size.join(" x ")} pixels, ${frames} frames, ${os.cpus()[0].model}, load ${os.loadavg()[0].toFixed(1)} of ${os.cpus().length}\n`);
const columns = kinds.flatMap((kind) => kind === "nothing" ? ["step and picture, processor ms"] : [`${kind}, processor ms`, `${kind}, ms`]);
console.log(`| scene | second | ${columns.join(" | ")} |\n|---|${"---|".repeat(columns.length + 1)}`);
for (const name of names) {
    await page.evaluate(open, [name, "nothing"]);
    const from = await page.evaluate(busiest, frames), row = [(from / 60).toFixed(1)];
    for (const kind of kinds) {
        await page.evaluate(open, [name, kind]);
        await page.evaluate(goTo, Math.max(from - 4, 0));
        await page.evaluate(run, 4);
        const before = await processorTime();
        const median = await page.evaluate(run, frames);
        const processor = (await processorTime() - before) / frames;
        row.push(...(kind === "nothing" ? [processor] : [processor, median]).map((ms) => ms.toFixed(1)));
    }
    console.log(`| ${name} | ${row.join(" | ")} |`);
}
await site.end();
