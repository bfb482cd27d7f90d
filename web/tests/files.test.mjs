// Files of other programs on the playground: dropped, they become scenes; and the program of docs/how/rope-for-three.md.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { cp, mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { catalogue, loadExporter } from "../sinew/index.js";
import { desktop, playing, visit } from "./browser.mjs";

const root = path.resolve(import.meta.dirname, "../..");
const sample = (name) => ({ name: path.basename(name), bytes: readFileSync(path.join(root, "tests/files", name)).toString("base64") });

let site;
before(async () => (site = await visit()));
after(() => site.end());

/** Drops files on the page, as a browser does. */
const drop = (page, files) =>
    page.evaluate((files) => {
        const data = new DataTransfer();
        for (const { name, bytes } of files) data.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name));
        dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
    }, files);

const opened = async (page, name) => {
    await page.waitForFunction((name) => window.sinew.opened?.name === name, name, { timeout: 40_000 });
    await playing(page);
};
const notes = (page) => page.locator("dialog.notes[open] li").allTextContents();

/** Files that are dropped together, figures and colliders of the scene, and a note that is shown. */
const drops = [
    [["svg/logo.svg"], "logo", 3, 0, /^23:2: <text>.*is not taken/],
    [["obj/banner.obj"], "banner", 1, 1, /^87:1 texture coordinates/],
    [["gltf/robot.bin", "gltf/robot.gltf"], "robot", undefined, undefined, /points and lines/],
    [["gltf/human.glb"], "human", 1, 1, undefined],
    [["tiled/cave.tsx", "tiled/cave.tmj"], "cave", undefined, undefined, undefined],
    [["points/box.json"], "box", 1, 0, /"color" is not taken/],
    [["png/cat.png"], "cat", 1, 0, undefined],
];

test("files of other programs become scenes where they are dropped, and tell what is not taken", { timeout: 240_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const asked = () => site.server.sent.filter(({ name }) => /sinew-import/.test(name)).length;
        assert.equal(asked(), 0, "the module is loaded when a file is dropped");
        for (const [names, name, figures, colliders, note] of drops) {
            await drop(page, names.map(sample));
            await opened(page, name);
            const scene = await page.evaluate(() => JSON.parse(window.sinew.opened.text));
            if (figures !== undefined) assert.equal(scene.figures?.length ?? 0, figures, name);
            if (colliders !== undefined) assert.equal(scene.colliders?.length ?? 0, colliders, name);
            const told = await notes(page);
            if (note) assert.ok(told.some((one) => note.test(one)), `${name}: ${told.join("\n")}`);
        }
        assert.ok(asked() > 0);
    }));

test("an image of a dropped picture is painted", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        await drop(page, [sample("png/cat.png")]);
        await opened(page, "cat");
        await page.evaluate(() => window.sinew.stage.player.pause(true));
        const folder = process.env.SINEW_PICTURES;
        if (folder) await page.screenshot({ path: path.join(folder, "dropped_cat.png") });
        const { images, colors } = await page.evaluate(() => {
            const { stage } = window.sinew, small = new OffscreenCanvas(160, 100), context = small.getContext("2d");
            context.drawImage(stage.canvas, 0, 0, 160, 100);
            const { data } = context.getImageData(0, 0, 160, 100), seen = new Set();
            for (let i = 0; i < data.length; i += 4) seen.add(`${data[i] >> 4},${data[i + 1] >> 4},${data[i + 2] >> 4}`);
            return { images: window.sinew.opened.text.match(/cat_images\/\d+\.png/g)?.length ?? 0, colors: seen.size };
        });
        assert.ok(images > 10, `${images} images`);
        assert.ok(colors > 12, `${colors} colours`); // paper, lines and one mean colour would be fewer
    }));

test("a file that is broken is told with its place, and the scene stays", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const text = (name, content) => ({ name, bytes: Buffer.from(content).toString("base64") });
        const told = async (part) => page.waitForFunction((part) => document.getElementById("message").textContent.includes(part), part, { timeout: 30_000 });
        await drop(page, [text("a.svg", "<svg width='9' height='9'>\n<rect width='x'/></svg>")]);
        await told("a.svg:2:2");
        const png = readFileSync(path.join(root, "tests/files/png/cat.png"));
        png[100] ^= 1;
        await drop(page, [{ name: "b.png", bytes: png.toString("base64") }]);
        await told("b.png:byte ");
        await drop(page, [sample("gltf/robot.gltf")]);
        await told("robot.bin\", which is not beside it");
        assert.equal(await page.evaluate(() => window.sinew.opened.name), "rope");
        assert.deepEqual(await notes(page), []);
    }));

test("the program of docs/how/rope-for-three.md shows a rope that moves", { timeout: 120_000 }, async () => {
    const folder = await mkdtemp(path.join(tmpdir(), "sinew-three-"));
    const guide = await readFile(path.join(root, "docs/how/rope-for-three.md"), "utf8");
    const exporter = await loadExporter(await readFile(path.join(root, "web/sinew/sinew-export.wasm")));
    const scene = (await catalogue()).find(({ name }) => name === "rope");
    const { files: [glb] } = await exporter.write(scene.text, "rope.glb", { figures: ["rope"] });
    await writeFile(path.join(folder, "rope.glb"), glb.bytes);
    const [, html] = /```html\n([^]*?)```/.exec(guide);
    // The page stands at the root of a server there, and below a path here.
    await writeFile(path.join(folder, "index.html"), html.replaceAll('"/node_modules', '"./node_modules').replace("<!doctype html>", "<!doctype html><link rel=icon href=data:,>"));
    await mkdir(path.join(folder, "node_modules"));
    await cp(path.join(root, "web/node_modules/three"), path.join(folder, "node_modules/three"), { recursive: true });
    const json = JSON.parse(Buffer.from(glb.bytes).toString("utf8", 20, 20 + Buffer.from(glb.bytes).readUInt32LE(12)));
    const names = json.nodes.map(({ name }) => name);
    for (const said of ["rope", "rope/rope_0", "rope/rope_1"]) assert.ok(names.includes(said), said);
    const own = await visit(folder);
    try {
        await own.on({ viewport: { width: 640, height: 480 } }, "", async (page) => {
            await page.locator("canvas").waitFor();
            const dark = async () => {
                const shot = (await page.screenshot()).toString("base64");
                return page.evaluate(async (shot) => {
                    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${shot}`)).blob());
                    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
                    context.drawImage(image, 0, 0);
                    const { data } = context.getImageData(0, 0, image.width, image.height), found = [];
                    for (let i = 0; i < data.length; i += 4) if (data[i] + data[i + 1] + data[i + 2] < 600) found.push(i / 4);
                    return found;
                }, shot);
            };
            let first = [];
            for (let i = 0; i < 40 && first.length < 50; ++i) first = (await page.waitForTimeout(250), await dark());
            assert.ok(first.length >= 50, `${first.length} pixels of a rope`);
            if (process.env.SINEW_PICTURES) await page.screenshot({ path: path.join(process.env.SINEW_PICTURES, "rope_three.png") });
            await page.waitForTimeout(700);
            const later = new Set(await dark());
            const gone = first.filter((pixel) => !later.has(pixel)).length;
            assert.ok(gone > first.length / 10, `${gone} of ${first.length} pixels of the rope have moved`);
        });
    } finally {
        await own.end();
        await rm(folder, { recursive: true, force: true });
    }
});
