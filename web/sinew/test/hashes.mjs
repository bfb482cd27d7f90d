// The state of every scene after two seconds, in both modes, has the bits of the native library. A file of tests for each
// precision: files run beside each other.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { catalogue } from "../index.js";
import { engine } from "./engine_for_tests.mjs";

const golden = (await readFile(new URL("../../../tests/golden/scenes.txt", import.meta.url), "utf8")).split("\n");
const scenes = new Map((await catalogue()).map((scene) => [scene.name, scene]));

export function compare(wanted) {
    for (const line of golden) {
        if (!line || line.startsWith("#")) continue;
        const [name, mode, precision, hash] = line.split(" ");
        if (precision !== wanted) continue;
        test(`${name} ${mode} ${precision}`, () => {
            const scene = scenes.get(name);
            const simulation = engine.open(scene.text, { ...scene, overrides: { mode, precision } });
            simulation.runUntil(2);
            assert.equal(simulation.hash(), hash);
            simulation.dispose();
        });
    }
}
