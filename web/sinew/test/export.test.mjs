// Files of other programs, by the module for them.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { SinewError, loadExporter } from "../index.js";
import { engine, pendulum } from "./engine_for_tests.mjs";

const exporter = await loadExporter(await readFile(new URL("../sinew-export.wasm", import.meta.url)));

test("a point cache has the positions of the engine", async () => {
    const { files } = await exporter.write(pendulum, "p.pc2", { seconds: 0.5, fps: 20 });
    assert.deepEqual(files.map(({ name }) => name).sort(), ["p.mtl", "p.obj", "p.pc2"]);
    const { bytes } = files.find(({ name }) => name === "p.pc2");
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    assert.deepEqual([view.getUint32(16, true), view.getUint32(28, true)], [2, 10]); // vertices, frames
    const simulation = engine.open(pendulum);
    for (let frame = 0; frame < 10; ++frame) {
        const [x, y] = simulation.positions.slice(2, 4);
        const at = 32 + 24 * frame + 12;
        assert.ok(Math.hypot(view.getFloat32(at, true) - x, view.getFloat32(at + 4, true) - y) < 1e-6, `frame ${frame}`);
        simulation.step(Math.round(simulation.rate / 20));
    }
    simulation.dispose();
});

test("glTF, Lottie and SVG are written; what cannot be is told", async () => {
    const { files: [glb] } = await exporter.write(pendulum, "p.glb", { seconds: 0.2 });
    assert.equal(new TextDecoder().decode(glb.bytes.slice(0, 4)), "glTF");
    const { files: [lottie], notes } = await exporter.write(pendulum, "p.json", { seconds: 0.2, size: [80, 60] });
    assert.equal(JSON.parse(new TextDecoder().decode(lottie.bytes)).w, 80);
    assert.ok(notes.some((note) => note.includes("px")));
    const { files: [svg] } = await exporter.write(pendulum, "p.svg", { seconds: 0.2, background: "none" });
    assert.match(new TextDecoder().decode(svg.bytes), /^<svg[^]*<animate/);
    for (const [name, options] of [["p.png", {}], ["p.xyz", {}], ["p.glb", { figures: ["nobody"] }], ["p.svg", { background: "blurple" }], ["p.glb", { fps: NaN }]])
        await assert.rejects(() => exporter.write(pendulum, name, options), SinewError, name);
});
