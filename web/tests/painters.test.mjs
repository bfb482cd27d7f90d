// The two painters of the package in a browser: WebGL2 (on software GL) paints every scene as Canvas2D does.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { cp, mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { visit } from "./browser.mjs";

let site;
before(async () => (site = await visit(path.resolve(import.meta.dirname, "../sinew"))));
after(() => site.end());

/** Runs in the page: a painter of each kind on a canvas of its own. */
async function begin([width, height]) {
    const { load, loadFloat, catalogue, Canvas2DPainter, WebGL2Painter } = await import("./index.js");
    const canvas = () => Object.assign(document.createElement("canvas"), { width, height });
    const [flat, gl] = [canvas(), canvas()];
    const painters = [[flat, new Canvas2DPainter(flat.getContext("2d", { alpha: false }))], [gl, new WebGL2Painter(gl, { preserveDrawingBuffer: true })]];
    Object.assign(window, { engine: await loadFloat(await load()), scenes: await catalogue(), painters });
    return window.scenes.map(({ name }) => name);
}

/** Runs in the page: both pictures of a scene after a second, as data URLs. */
async function paintedTwice(name) {
    const scene = window.scenes.find((one) => one.name === name);
    const simulation = window.engine.open(scene.text, scene);
    simulation.runUntil(1);
    const images = await Promise.all(Object.keys(scene.images).map(async (image) => [image, await createImageBitmap(await (await fetch(`images/${image}`)).blob())]));
    const pictures = window.painters.map(([canvas, painter]) => {
        for (const [image, bitmap] of images) painter.setImage(image, bitmap);
        painter.paint(simulation.draw(canvas.width, canvas.height));
        return canvas.toDataURL("image/png");
    });
    simulation.dispose();
    return pictures;
}

/** SSIM of each picture with its like of another folder, in order. */
async function similarities(folder, a, b) {
    const log = path.join(folder, "ssim.txt");
    const input = (name) => ["-start_number", "0", "-i", path.join(folder, name, "%03d.png")];
    await promisify(execFile)("ffmpeg", ["-hide_banner", "-loglevel", "error", ...input(a), ...input(b), "-lavfi", `ssim=stats_file=${log}`, "-f", "null", "-"]);
    return (await readFile(log, "utf8")).trim().split("\n").map((line) => Number(/All:([\d.]+)/.exec(line)[1]));
}

test("WebGL2 paints every scene as Canvas2D does", { timeout: 300_000 }, () =>
    site.on({}, "", async (page) => {
        const names = await page.evaluate(begin, [640, 480]);
        assert.ok(names.length > 30);
        for (const kind of ["2d", "webgl2"]) await mkdir(path.join(site.folder, kind));
        for (const [i, name] of names.entries()) {
            const pictures = await page.evaluate(paintedTwice, name);
            for (const [k, kind] of ["2d", "webgl2"].entries())
                await writeFile(path.join(site.folder, kind, `${String(i).padStart(3, "0")}.png`), Buffer.from(pictures[k].split(",")[1], "base64"));
        }
        if (process.env.SINEW_KEEP) await cp(site.folder, process.env.SINEW_KEEP, { recursive: true });
        const ssim = await similarities(site.folder, "2d", "webgl2");
        assert.equal(ssim.length, names.length);
        assert.deepEqual(names.filter((_, i) => !(ssim[i] >= 0.97)), [], `worst: ${Math.min(...ssim)}`);
    }));
