// Threads share the steps of large worlds, and change no bit of them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load, loadFloat } from "../index.js";

/** Enough particles to be shared, and ropes, which direct blocks solve. */
const large = {
    sinew: 1, dimension: 3, world: { gravity: [0, -9.81, 0] },
    figures: [
        { prefab: "cloth", name: "cloth", columns: 80, rows: 80, spacing: 0.03, pins: "corners", mass: 1 },
        { prefab: "rope", name: "rope", at: [5, 0, 0], length: 2, segments: 100, weight: 10, angle: 45 },
    ],
};

async function hashWith(threads, precision) {
    const engine = await loadFloat(await load(undefined, { threads }));
    assert.equal(engine.threads, threads);
    const simulation = engine.open(large, { overrides: { precision } });
    const hashes = [];
    for (let i = 0; i < 5; ++i) {
        simulation.step();
        hashes.push(simulation.hash());
    }
    engine.stop();
    return hashes;
}

for (const precision of ["double", "float"])
    test(`the hash of ${precision} is the same with one thread, two and three`, async () => {
        const alone = await hashWith(1, precision);
        assert.equal(new Set(alone).size, alone.length);
        assert.deepEqual(await hashWith(2, precision), alone);
        assert.deepEqual(await hashWith(3, precision), alone);
    });

test("texts and columns of shared memory are read as ever", async () => {
    const engine = await load(undefined, { threads: 2 });
    assert.ok(engine.memory.buffer instanceof SharedArrayBuffer);
    assert.match(engine.check({ sinew: 1, figures: [{ prefab: "rop" }] })[0].help, /rope/);
    const simulation = engine.open(large);
    assert.ok(simulation.positions.every(Number.isFinite));
    simulation.dispose();
    engine.stop();
});

test("what has been stopped does not keep Node alive", async () => {
    const engine = await load(undefined, { threads: 2 });
    engine.stop();
    assert.equal(engine.threads, 1);
});
