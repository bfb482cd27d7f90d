// Files of other programs as scenes, by the module for them.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { SinewError, loadImporter } from "../index.js";
import { engine } from "./engine_for_tests.mjs";

const moduleBytes = await readFile(new URL("../sinew-import.wasm", import.meta.url));
const importer = await loadImporter(moduleBytes);
const sample = (name) => readFile(new URL(`../../../tests/files/${name}`, import.meta.url));
const last = (name) => name.replace(/.*\//, "");

/** Options that a scene needs for its own files. */
const optionsFor = (files) => ({
    images: Object.fromEntries(files.filter(({ name }) => name.endsWith(".png")).map(({ name, bytes }) => [name, { width: Buffer.from(bytes).readUInt32BE(16), height: Buffer.from(bytes).readUInt32BE(20) }])),
    models: Object.fromEntries(files.filter(({ name }) => name.endsWith(".obj")).map(({ name, bytes }) => [name, new TextDecoder().decode(bytes)])),
});

for (const [name, ...beside] of [["svg/logo.svg"], ["svg/level.svg"], ["svg/icons.svg"], ["png/cat.png"], ["png/donut.png"], ["png/leaves.png"], ["obj/banner.obj"], ["obj/pudding.obj"],
    ["obj/napkin.obj"], ["gltf/human.glb"], ["gltf/rigged.glb"], ["gltf/tablecloth.gltf"], ["gltf/robot.gltf", "gltf/robot.bin"], ["tiled/level.tmj"], ["tiled/cave.tmj", "tiled/cave.tsx"],
    ["tiled/room.tmj"], ["points/box.json"], ["points/rope.json"], ["points/wheel.json"]])
    test(`${name} becomes a scene that moves`, async () => {
        const files = Object.fromEntries(await Promise.all(beside.map(async (one) => [last(one), await sample(one)])));
        const made = await importer.read(last(name), await sample(name), { files });
        const simulation = engine.open(made.scene, optionsFor(made.files));
        simulation.step(4);
        assert.ok(simulation.positions.every(Number.isFinite));
        assert.ok(simulation.positions.length > 0 || JSON.parse(made.scene).colliders.length > 0);
        simulation.dispose();
    });

test("notes have places, and wishes are followed", async () => {
    const { scene, notes } = await importer.read("logo.svg", await sample("svg/logo.svg"), { role: "jelly", scale: 2 });
    assert.ok(notes.some(({ place, message }) => place.startsWith("23:") && message.includes("<text>")), JSON.stringify(notes));
    assert.equal(JSON.parse(scene).figures[0].internal_damping, 2);
    const plain = JSON.parse((await importer.read("logo.svg", await sample("svg/logo.svg"))).scene);
    assert.ok(JSON.parse(scene).world.bounds.box[1][0] > 1.9 * plain.world.bounds.box[1][0]);
});

test("what cannot be read is told with its place", async () => {
    const refused = [
        ["a.svg", "<svg width='9' height='9'>\n<rect width='x'/></svg>", {}, "a.svg:2:2: <rect>: its width is a length, found \"x\""],
        ["a.svg", "<svg>\n<g>", {}, "a.svg:2:2: the XML breaks off"],
        ["a.png", (await sample("png/cat.png")).subarray(0, 200), {}, "a.png:byte "],
        ["robot.gltf", await sample("gltf/robot.gltf"), {}, "which is not beside it"],
        ["a.obj", "v 0 0 0\nf 1 2 3\n", {}, "a.obj:2:1"],
        ["a.xyz", "nothing", {}, "formats: SVG"],
        ["a.svg", "", {}, "empty"],
        ["a.svg", "<svg width='9' height='9'><rect width='4' height='4'/></svg>", { role: "king" }, "no role \"king\""],
        ["a.svg", "<svg width='9' height='9'><rect width='4' height='4'/></svg>", { scale: NaN }, "error and scale"],
        ["a.svg", new Uint8Array(16_000_001), {}, "16000000 bytes"],
    ];
    for (const [name, bytes, options, part] of refused)
        await assert.rejects(() => importer.read(name, bytes, options), (error) => error instanceof SinewError && error.message.includes(part), `${name}: ${part}`);
    await importer.read("box.json", await sample("points/box.json")); // the next file is read by another instance
});
