// One contender on one case, in Node and in a browser alike: built once, stepped in parts, measured by its caller.
import { load, loadFloat } from "../sinew/index.js";
import { cases, workOf } from "./cases.mjs";

export const contenders = ["sinew", "plain", "verlet", "matter", "planck", "rapier", "box2d", "jolt", "jolt_lra"];
export const steps = 120; // two seconds
export { cases };

let engine = null;

/** A world of a contender: { name, step, stretch }. */
export async function build(contender, index) {
    engine ??= await loadFloat(await load());
    const simulation = engine.open(cases[index].scene), work = workOf(simulation);
    if (contender === "sinew") return { name: "**Sinew**", step: () => simulation.step(), stretch: () => stretchOf(work, positionsOf(simulation)) };
    simulation.dispose();
    const { name, build } = await import(`./contenders/${contender}.mjs`);
    const world = await build(work);
    return { name, step: world.step, stretch: () => stretchOf(work, world.position) };
}

function positionsOf(simulation) {
    const positions = simulation.positions.slice();
    return (i) => [positions[2 * i], positions[2 * i + 1]];
}

/** Largest and mean excess of the sticks' lengths, as a fraction. */
function stretchOf({ sticks }, position) {
    const excess = sticks.filter(({ length }) => length > 0).map(({ a, b, length }) => {
        const [[ax, ay], [bx, by]] = [position(a), position(b)];
        return Math.max(0, Math.hypot(ax - bx, ay - by) / length - 1);
    });
    return { max: excess.reduce((a, b) => (a > b ? a : b), 0), mean: excess.reduce((a, b) => a + b, 0) / excess.length };
}

const percent = (share) => (Number.isFinite(share) && share < 1e4 ? `${digits(100 * share)} %` : "explodes");
const digits = (value) => (value === 0 ? "0" : value < 1e-3 ? value.toExponential(0) : String(Number(value.toPrecision(2))));

export const head = "| case | contender | ms a step | stretch, largest | mean |\n|---|---|---|---|---|";

/** A row of the table. */
export function row(index, { name, ms, max, mean, taken }) {
    return `| ${cases[index].name} | ${name} | ${ms.toPrecision(3)}${taken < steps ? ` (stopped after ${taken} steps)` : ""} | ${percent(max)} | ${percent(mean)} |`;
}
