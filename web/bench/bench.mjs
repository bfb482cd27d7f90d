// node bench.mjs [WORD]: ms of processor time a step and stretch after two seconds, of every contender on every case, in Node, as a table
// in Markdown. With a word, only cases whose names have it. A contender that is not installed, or fails, is left out with its reason on stderr.
import { build, cases, contenders, head, row, steps } from "./run.mjs";

const longest = 30_000; // milliseconds of processor time that a contender may take for a case
const wanted = process.argv[2] ?? "";

/** Milliseconds of processor time so far: a crowded machine does not count. */
function now() {
    const { user, system } = process.cpuUsage();
    return (user + system) / 1000;
}

/** Steps for two seconds of simulated time; tells the mean of the second half. */
function timed(world) {
    const start = now();
    let taken = 0, half = start;
    for (; taken < steps && now() - start < longest; ++taken) {
        if (taken === steps / 2) half = now();
        world.step();
    }
    return { ms: taken > steps / 2 ? (now() - half) / (taken - steps / 2) : (now() - start) / taken, taken };
}

console.log(head);
for (const [index, { name }] of cases.entries()) {
    if (!name.includes(wanted)) continue;
    for (const contender of contenders) {
        try {
            const world = await build(contender, index);
            console.log(row(index, { name: world.name, ...timed(world), ...world.stretch() }));
        } catch (error) {
            console.error(`${contender}: ${error.message ?? error}`);
        }
    }
}
process.exit(0); // some keep workers
