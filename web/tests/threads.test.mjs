// Threads of the built site: workers on shared memory where the page is cross-origin isolated, elsewhere one; the same bits.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { desktop, playing, visit } from "./browser.mjs";

const isolation = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };

let isolated, plain;
before(async () => ([isolated, plain] = await Promise.all([visit(undefined, isolation), visit()])));
after(() => Promise.all([isolated.end(), plain.end()]));

/** Enough particles to be shared, and ropes, which direct blocks solve. */
const large = {
    sinew: 1, dimension: 3, world: { gravity: [0, -9.81, 0] },
    figures: [
        { prefab: "cloth", name: "cloth", columns: 80, rows: 80, spacing: 0.03, pins: "corners", mass: 1 },
        { prefab: "rope", name: "rope", at: [5, 0, 0], length: 2, segments: 100, weight: 10, angle: 45 },
    ],
};

/** Runs before a page's own scripts: a machine of four processors, and a count of the bytes that each worker's stack holds. */
function script() {
    Object.defineProperty(Navigator.prototype, "hardwareConcurrency", { get: () => 4 });
    const stacks = [], deepest = 65536; // bytes
    window.stacksUsed = () => stacks.map(({ memory, stack }) => new Uint8Array(memory.buffer, stack - deepest, deepest).filter((byte) => byte !== 0).length);
    const post = Worker.prototype.postMessage;
    Worker.prototype.postMessage = function (message, ...more) {
        if (message?.stack) stacks.push(message);
        return post.call(this, message, ...more);
    };
}

/** Runs in the page: hashes of the first steps in both precisions, and how far each worker has come down its stack, before and after. */
function stepped(large) {
    const { engine } = window.sinew, idle = window.stacksUsed();
    const simulations = ["double", "float"].map((precision) => engine.open(large, { overrides: { precision } }));
    const hashes = simulations.map((simulation) => Array.from({ length: 5 }, () => (simulation.step(), simulation.hash())));
    const areUsed = () => window.stacksUsed().every((bytes, i) => bytes > idle[i]);
    for (let i = 0; i < 200 && !areUsed(); ++i) for (const simulation of simulations) simulation.step(); // a busy machine wakes workers late
    for (const simulation of simulations) simulation.dispose();
    return { hashes: hashes.flat(), idle, used: window.stacksUsed(), isIsolated: crossOriginIsolated, threads: engine.threads, isShared: engine.memory.buffer.constructor.name === "SharedArrayBuffer" };
}

/** The same of a site as it is served. */
async function measured(site) {
    let state;
    await site.on({ ...desktop, script }, "#scene=rope&precision=float", async (page) => { // both modules are loaded
        await playing(page);
        state = await page.evaluate(stepped, large);
    });
    return state;
}

test("an isolated page shares large steps with workers; another has one thread; the hashes are the same", { timeout: 120_000 }, async () => {
    const [many, one] = [await measured(isolated), await measured(plain)];
    assert.deepEqual([many.isIsolated, many.isShared, many.threads, many.used.length], [true, true, 3, 4], "two workers for each precision");
    many.used.forEach((bytes, i) => assert.ok(bytes > many.idle[i], `worker ${i} has computed nothing: ${bytes} bytes of its stack, ${many.idle[i]} before`));
    assert.deepEqual([one.isIsolated, one.isShared, one.threads, one.used.length], [false, false, 1, 0]);
    assert.equal(new Set(many.hashes).size, 10);
    assert.deepEqual(many.hashes, one.hashes);
});

test("an isolated page has its threads without a network, too", { timeout: 120_000 }, () =>
    isolated.on({ ...desktop, script }, "", async (page) => {
        await page.evaluate(() => navigator.serviceWorker.ready);
        await page.waitForFunction(() => navigator.serviceWorker.controller !== null, null, { timeout: 30_000 });
        await page.context().setOffline(true);
        await page.goto(`${isolated.address}#scene=boxes`);
        await page.reload();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.engine.threads), 3);
    }));
