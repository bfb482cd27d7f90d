// node bench/native.mjs [ROUNDS]: the module beside the native library with lanes of the same width (SSE2), by turns, as a table in Markdown.
// A turn is four seconds of a cloth on one thread, in processor time. Needs build/bin/sinew (./dev build), or another in $SINEW.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { load, loadFloat } from "../sinew/index.js";

const rounds = Number(process.argv[2] ?? 15);
const seconds = 4, rate = 60;
const command = process.env.SINEW ?? path.resolve(import.meta.dirname, "../../build/bin/sinew");

const cloth = (side, precision) => ({
    sinew: 1, dimension: 3, world: { gravity: [0, -9.81, 0] }, solver: { precision, rate, substeps: 10 },
    figures: [{ prefab: "cloth", columns: side, rows: side, spacing: 0.03, pins: "corners", mass: side * side }],
});

const median = (numbers) => numbers.toSorted((a, b) => a - b)[numbers.length >> 1];

const folder = mkdtempSync(path.join(os.tmpdir(), "sinew-"));
const engine = await loadFloat(await load());

/** Milliseconds of processor time of a command, and what it prints. */
function commandTime(words) {
    const env = { ...process.env, SINEW_SIMD: "sse2", LC_ALL: "C" };
    const printed = execFileSync("bash", ["-c", '"$@"; times', "bash", command, ...words], { env, encoding: "utf8" }).trim().split("\n");
    const [, ...parts] = /([\d]+)m([\d.]+)s ([\d]+)m([\d.]+)s/.exec(printed.at(-1)); // of the children: user, system
    const [userMinutes, user, systemMinutes, system] = parts.map(Number);
    return { ms: 1000 * (60 * (userMinutes + systemMinutes) + user + system), printed };
}

function nativeTurn(file) {
    const run = (length) => commandTime(["run", file, "--seconds", String(length), "--threads", "1", "--json"]);
    const opening = run(1 / rate), whole = run(seconds + 1 / rate); // both open the scene and take a first step
    const { hash } = JSON.parse(run(seconds).printed.findLast((line) => line.startsWith("{")));
    return { ms: (whole.ms - opening.ms) / (seconds * rate), hash };
}

function moduleTurn(scene) {
    const simulation = engine.open(scene);
    const begun = process.cpuUsage();
    simulation.step(seconds * rate);
    const { user, system } = process.cpuUsage(begun);
    const hash = simulation.hash();
    simulation.dispose();
    return { ms: (user + system) / 1000 / (seconds * rate), hash };
}

console.log(`${rounds} rounds, Node ${process.versions.node}, ${os.cpus()[0].model}, load ${os.loadavg()[0].toFixed(1)} of ${os.cpus().length}\n`);
console.log("| cloth | module, ms a step | native SSE2 | share of its speed: median of the rounds | quartiles |\n|---|---|---|---|---|");
for (const side of [64, 128])
    for (const precision of ["float", "double"]) {
        const scene = cloth(side, precision), file = path.join(folder, "cloth.json");
        writeFileSync(file, JSON.stringify(scene));
        moduleTurn(scene); // compiled by V8's second compiler from then on
        const turns = Array.from({ length: rounds }, () => ({ native: nativeTurn(file), own: moduleTurn(scene) }));
        if (turns.some(({ native, own }) => native.hash !== own.hash)) throw new Error("the hashes differ");
        const shares = turns.map(({ native, own }) => native.ms / own.ms).sort((a, b) => a - b);
        const [lower, middle, upper] = [0.25, 0.5, 0.75].map((share) => shares[Math.floor(share * rounds)].toFixed(2));
        console.log(`| ${side} x ${side}, ${precision} | ${median(turns.map(({ own }) => own.ms)).toPrecision(3)} | ${median(turns.map(({ native }) => native.ms)).toPrecision(3)} | ${middle} | ${lower} to ${upper} |`);
    }
rmSync(folder, { recursive: true });
