import assert from "node:assert/strict";
import { test } from "node:test";
import { Worker } from "node:worker_threads";
import { abi, load, loadFloat, SceneErrors, SinewError } from "../index.js";
import { engine, floatBytes, moduleBytes, pendulum } from "./engine_for_tests.mjs";

test("the modules need nothing from outside", async () => {
    for (const bytes of [moduleBytes, floatBytes])
        assert.deepEqual(WebAssembly.Module.imports(await WebAssembly.compile(bytes)), []);
});

test("worlds of float are in a module of their own", async () => {
    const inFloat = { overrides: { precision: "float" } };
    const alone = await load(moduleBytes);
    const [error] = alone.check(pendulum, inFloat);
    assert.equal(error.path, "/solver/precision");
    assert.match(error.message, /no worlds of float/);
    assert.throws(() => alone.open(pendulum, inFloat), SceneErrors);
    await loadFloat(alone);
    assert.deepEqual(alone.check(pendulum, inFloat), []);
    assert.equal(alone.open(pendulum, inFloat).precision, "float");
    assert.equal(alone.play(pendulum, inFloat).simulation.precision, "float");
    assert.equal(alone.open(pendulum).precision, "double");
});

test("every way to name a module loads it", async () => {
    const module = await WebAssembly.compile(moduleBytes);
    for (const source of [undefined, moduleBytes, moduleBytes.buffer.slice(moduleBytes.byteOffset, moduleBytes.byteOffset + moduleBytes.length),
        module, new URL("../sinew.wasm", import.meta.url)])
        assert.equal((await load(source)).abi, abi);
});

test("two engines share nothing", async () => {
    const other = await load(moduleBytes);
    const simulation = engine.open(pendulum);
    assert.throws(() => other.call("sinew_world_step", simulation.handle, 1), SinewError);
    simulation.dispose();
});

test("errors have their places and what was meant", () => {
    const text = '{\n  "sinew": 1,\n  "figures": [{"prefab": "rope", "lenght": 3}]\n}';
    const [error] = engine.check(text, { name: "mine.json" });
    assert.equal(error.line, 3);
    assert.equal(error.column, 34);
    assert.equal(error.length, '"lenght"'.length);
    assert.equal(error.path, "/figures/0");
    assert.match(error.message, /unknown property "lenght"/);
    assert.match(error.help, /did you mean "length"/);
    assert.match(error.text, /^mine\.json:3:34: error: /);
    assert.match(error.text, /\^~+/);
    assert.throws(() => engine.open(text), (thrown) => thrown instanceof SceneErrors && thrown.errors.length === 1);
});

test("every error is told, not the first alone", () => {
    const wrong = { sinew: 1, dimension: 4, figures: [{ prefab: "rop" }, { prefab: "rope", length: -1 }] };
    assert.ok(engine.check(wrong).length >= 3);
    assert.deepEqual(engine.check(pendulum), []);
});

test("an override with an error is blamed itself", () => {
    const [error] = engine.check(pendulum, { overrides: ["solver.substep=3"] });
    assert.equal(error.isOverride, true);
    assert.match(error.message, /substep/);
});

test("overrides act as pairs and as an object", () => {
    const pairs = engine.open(pendulum, { overrides: ["precision=float", "mode=classic"] });
    const object = engine.open(pendulum, { overrides: { precision: "float", mode: "classic" } });
    assert.equal(pairs.precision, "float");
    assert.equal(pairs.info().isClassic, true);
    assert.equal(pairs.hash(), object.hash());
});

test("text that is no JSON is refused with its place", () => {
    const [error] = engine.check('{"sinew": 1,');
    assert.equal(error.line, 1);
    assert.ok(error.column > 1);
});

test("descriptions are complete", () => {
    assert.ok(engine.schema().properties.figures);
    for (const { name, dimensions } of engine.prefabs()) for (const dimension of [2, 3]) {
        const build = () => engine.open({ sinew: 1, dimension, figures: [{ prefab: name, name }] }).dispose();
        if (!dimensions.includes(dimension)) assert.throws(build, /does not exist/, `${name} in ${dimension}D`);
        else if (name !== "mesh") build();
    }
    assert.ok(engine.prefabs().some(({ name, parameters }) => name === "rope" && parameters.some((one) => one.path === "length" && one.low >= 0)));
    assert.deepEqual(engine.overlays().map(({ name }) => name), ["strain", "tension", "pins", "names", "forces", "contacts"]);
    assert.ok(engine.tools().some(({ name, key }) => name === "cut" && key === "x"));
    assert.deepEqual(engine.joints().map(({ name }) => name), ["hinge", "spring", "weld", "motor", "winch"]);
    assert.ok(engine.actions().some(({ name }) => name === "undo"));
    assert.ok(!engine.actions().some(({ name }) => name === "save"));
    assert.equal(engine.kinds(2)[0].name, "distance");
    assert.equal(engine.kinds(3).find(({ name }) => name === "volume").particles, 4);
});

test("a worker steps a scene to the same bits", async () => {
    const simulation = engine.open(pendulum);
    simulation.step(100);
    const code = `import { parentPort, workerData } from "node:worker_threads";
        const { load } = await import(workerData.url);
        const simulation = (await load(workerData.bytes)).open(workerData.scene);
        simulation.step(100);
        parentPort.postMessage(simulation.hash());`;
    const worker = new Worker(new URL(`data:text/javascript,${encodeURIComponent(code)}`),
        { workerData: { url: new URL("../index.js", import.meta.url).href, bytes: moduleBytes, scene: pendulum } });
    const hash = await new Promise((resolve, reject) => worker.once("message", resolve).once("error", reject));
    assert.equal(hash, simulation.hash());
});
