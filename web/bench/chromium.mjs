// node chromium.mjs [WORD]: the table of bench.mjs, measured in Chromium: one page a contender and case, one thread, isolated from other origins.
// Processor time of a page counts in hundredths of a second: a step below 5 ms is the median by the clock instead.
import { mkdtemp, rm } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { build } from "vite";
import { visit } from "../tests/browser.mjs";
import { cases, contenders, head, row, steps } from "./run.mjs";

const wanted = process.argv[2] ?? "";
const slice = 10;       // steps between looks at the clock
const longest = 10_000; // milliseconds of processor time
const coarse = 5;       // milliseconds of a step that the processor time of a page can tell

/** A contender that is not installed throws when it is asked for, and not before. */
const missing = {
    name: "missing",
    async resolveId(name, importer, options) {
        if (name.startsWith(".") || name.startsWith("\0") || path.isAbsolute(name)) return null;
        return (await this.resolve(name, importer, { ...options, skipSelf: true })) ?? `\0missing:${name}`;
    },
    load: (id) => (id.startsWith("\0missing:") ? `throw new Error("${id.slice(9)} is not installed"); export default 0;` : null),
};

const folder = await mkdtemp(path.join(os.tmpdir(), "sinew-bench-"));
await build({
    root: import.meta.dirname,
    configFile: false,
    base: "./",
    logLevel: "silent",
    plugins: [missing],
    worker: { format: "es" },
    build: { outDir: folder, target: "es2022", assetsInlineLimit: 0, lib: { entry: path.resolve(import.meta.dirname, "run.mjs"), formats: ["es"], fileName: "run" } },
});

const site = await visit(folder, { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" });
const devtools = await site.browser.newBrowserCDPSession();

/** Milliseconds that the pages have used so far; a page counts for itself, and other processes of the browser do not. */
async function processorTime() {
    const { processInfo } = await devtools.send("SystemInfo.getProcessInfo");
    return processInfo.filter(({ type }) => type === "renderer").reduce((sum, { cpuTime }) => sum + cpuTime * 1000, 0);
}

/** Runs in the page: takes steps, tells the milliseconds of each. */
function clocked(count) {
    return Array.from({ length: count }, () => {
        const begun = performance.now();
        window.world.step();
        return performance.now() - begun;
    });
}

async function measured(contender, index) {
    const page = await site.browser.newPage();
    try {
        await page.goto(site.address);
        const name = await page.evaluate(async ([contender, index]) => (window.world = await (await import("./run.js")).build(contender, index)).name, [contender, index]);
        const start = await processorTime();
        const times = []; // milliseconds of a step by the clock
        let taken = 0, half = start;
        while (taken < steps && await processorTime() - start < longest) {
            if (taken === steps / 2) half = await processorTime();
            times.push(...await page.evaluate(clocked, slice));
            taken += slice;
        }
        const end = await processorTime();
        const processor = taken > steps / 2 ? (end - half) / (taken - steps / 2) : (end - start) / taken;
        const clock = times.slice(taken >> 1).sort((a, b) => a - b)[taken >> 2];
        const ms = Math.min(processor, clock) < coarse ? clock : processor;
        return { name, ms, taken, ...await page.evaluate(() => window.world.stretch()) };
    } finally {
        await page.close();
    }
}

console.log(head);
for (const [index, { name }] of cases.entries()) {
    if (!name.includes(wanted)) continue;
    for (const contender of contenders) {
        try {
            console.log(row(index, await measured(contender, index)));
        } catch (error) {
            console.error(`${contender}: ${String(error.message ?? error).split("\n")[0]}`);
        }
    }
}
await site.end();
await rm(folder, { recursive: true, force: true });
process.exit(0);
