// node bench.mjs [WORD]: ms a step and stretch of every contender on every case, as a table in Markdown. With a word, only
// cases whose names have it. A contender that is not installed, or fails, is left out with its reason on stderr.
import { load } from "../sinew/index.js";
import { cases, workOf } from "./cases.mjs";

const contenders = ["plain", "matter", "planck", "rapier", "verletjs"];
const seconds = 2;         // simulated
const longest = 60;        // seconds a contender may take for a case
const wanted = process.argv[2] ?? "";

const engine = await load();

function median(numbers) {
    return [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
}

/** Largest and mean excess of the sticks' lengths, as a fraction. */
function stretchOf({ sticks }, position) {
    const excess = sticks.filter(({ length }) => length > 0).map(({ a, b, length }) => {
        const [[ax, ay], [bx, by]] = [position(a), position(b)];
        return Math.max(0, Math.hypot(ax - bx, ay - by) / length - 1);
    });
    return { max: excess.reduce((a, b) => (a > b ? a : b), 0), mean: excess.reduce((a, b) => a + b, 0) / excess.length };
}

/** Steps for two seconds of simulated time; tells the median of the second half. */
function timed(step) {
    const times = [];
    const start = performance.now();
    const steps = seconds * 60;
    for (let i = 0; i < steps && performance.now() - start < longest * 1000; ++i) {
        const before = performance.now();
        step();
        times.push(performance.now() - before);
    }
    return { ms: median(times.slice(times.length >> 1)), isWhole: times.length === steps };
}

function sinewRun({ scene }) {
    const simulation = engine.open(scene);
    const work = workOf(simulation);
    const time = timed(() => simulation.step());
    const { positions } = simulation;
    const stretch = stretchOf(work, (i) => [positions[2 * i], positions[2 * i + 1]]);
    simulation.dispose();
    return { work, result: { name: "Sinew", ...time, ...stretch } };
}

async function contenderRun(file, work) {
    try {
        const contender = await import(`./contenders/${file}.mjs`);
        const world = await contender.build(work);
        return { name: contender.name, ...timed(world.step), ...stretchOf(work, world.position) };
    } catch (error) {
        console.error(`${file}: ${error.message}`);
        return null;
    }
}

const percent = (share) => (Number.isFinite(share) ? `${(100 * share).toPrecision(2)} %` : "explodes");

console.log("| case | contender | ms a step | stretch, largest | mean |\n|---|---|---|---|---|");
for (const one of cases.filter(({ name }) => name.includes(wanted))) {
    const { work, result } = sinewRun(one);
    const results = [result];
    for (const file of contenders) results.push(await contenderRun(file, work));
    for (const { name, ms, max, mean, isWhole } of results.filter(Boolean))
        console.log(`| ${one.name} | ${name} | ${ms.toPrecision(3)}${isWhole ? "" : " (stopped early)"} | ${percent(max)} | ${percent(mean)} |`);
}
