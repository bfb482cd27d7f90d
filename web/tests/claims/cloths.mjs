// Claims of the lessons on cloth and on tearing.
import assert from "node:assert/strict";
import { above, below, claim, engine, lesson, scene, sceneFile } from "./reader.mjs";

claim("cloth", ["a grid of points, threads along and across", "there are four times as many points, and news has twice as far to go"], () => {
    const points = (threads) => scene("cloth", threads).particleCount;
    assert.equal(points(12), 144);
    assert.equal(points(24), 4 * points(12));
});

claim("cloth", ["Diagonals keep the cells from folding flat, as in the box"], () => {
    const folded = (diagonals) => { // a cell that hangs by one corner
        const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81], damping: 1 }, figures: [{ prefab: "cloth", name: "cloth", columns: 2, rows: 2, spacing: 1, diagonals, pins: "list", pin_list: [0] }] });
        simulation.runUntil(8);
        const [, , bx, by, cx, cy] = simulation.positions;
        return 1 - Math.hypot(cx - bx, cy - by) / Math.SQRT2;
    };
    below(Math.abs(folded("both")), 0.01);
    above(folded("none"), 0.3);
});

claim("cloth", ["This is where simple solvers give up: a fine cloth sags like chewing gum", "That holds at once", "not longer than the way along the threads"], () => {
    const after = (overrides, seconds = 4) => {
        const simulation = scene("cloth", 36, overrides);
        simulation.runUntil(seconds);
        return simulation.report().stretchMax;
    };
    const tied = after({}), loose = after({ "figures.cloth.tethers": false }), classic = after({ mode: "classic" });
    above(classic, 1, "a simple solver's thread is more than twice as long");
    below(tied, 0.01);
    above(loose, 10 * tied, "without tethers");
    below(after({}, 0.5), 0.05, "at once");
});

/** Pulls the lower half of the curtain down, evenly; how many threads are torn in each step that tears. */
function tornBySteps(overrides) {
    const simulation = scene("tearing", 0.3, overrides), { positions } = simulation, low = [];
    for (let i = 0; i < simulation.particleCount; ++i) if (positions[2 * i + 1] > 30 + 11 * 25.5) low.push([positions[2 * i], positions[2 * i + 1], i]);
    const pins = low.map(([, , i]) => simulation.pin(simulation.particle(i))), counts = [];
    for (let step = 0, before = 0; step < 120; ++step) {
        low.forEach(([x, y], i) => simulation.movePin(pins[i], [x, y + 3 * step]));
        simulation.step();
        const { torn } = lesson("tearing").figures[0].live(simulation);
        if (torn > before) counts.push(torn - before);
        before = torn;
    }
    return { counts, all: counts.reduce((sum, one) => sum + one, 0) };
}

claim("tearing", ["All threads of one strength would tear in a straight line, all in one moment", "So each thread gets a little extra by chance (uneven)"], () => {
    const even = tornBySteps({ "figures.curtain.uneven": 0 }), uneven = tornBySteps({});
    assert.equal(even.all, 41, "one thread of each column");
    above(Math.max(...even.counts), 0.8 * even.all, "most of them in one step");
    below(Math.max(...uneven.counts), 0.4 * uneven.all, "with chance they go one after the other");
});

claim("tearing", ["To tear a cloth, remove a thread that is too long", "Make it weak, then strong"], () => {
    /** The steps until something tears, of a point that is pulled down by so many pixels a step. */
    const tearsAfter = (strength, pull) => {
        const simulation = scene("tearing", strength);
        simulation.runUntil(0.5);
        if (pull > 0) assert.ok(simulation.grab([320, 200], 60));
        const { constraintCount } = simulation;
        for (let i = 0; i < 60; ++i) {
            if (pull > 0) simulation.drag([320, 200 + pull * i]);
            simulation.step();
            const { torn } = lesson("tearing").figures[0].live(simulation);
            assert.equal(constraintCount - simulation.constraintCount, torn, "torn threads are gone");
            if (torn > 0) return i;
        }
        return Infinity;
    };
    const steps = [0.1, 0.5, 1].map((strength) => tearsAfter(strength, 2));
    assert.ok(steps[0] < steps[1] && steps[1] < steps[2], `${steps}`);
    for (const strength of [0.3, 0.5, 2]) assert.equal(tearsAfter(strength, 0), Infinity, "nothing pulls");
});

/** The curtain, pulled down along both sides of a cut, and the places where it tears. */
claim("tearing", ["The neighbours then carry more, get longer, and tear in turn: a tear runs"], () => {
    const tearsOf = (isCut) => {
        const simulation = scene("tearing", 0.3, { "figures.curtain.uneven": 0 }), { positions } = simulation, low = [];
        for (let i = 0; i < simulation.particleCount; ++i) if (positions[2 * i + 1] > 30 + 11 * 25.5) low.push([positions[2 * i], positions[2 * i + 1], i]);
        if (isCut) simulation.cut([90, 200], [200, 200]);
        const pins = low.map(([, , i]) => simulation.pin(simulation.particle(i)));
        for (let step = 0; step < 120; ++step) {
            low.forEach(([x, y], i) => simulation.movePin(pins[i], [x, y + 2 * step]));
            simulation.step();
            const torn = simulation.events().filter(({ what }) => what === "torn");
            if (torn.length > 0) return { step, count: torn.length };
        }
        return { step: 120, count: 0 };
    };
    below(tearsOf(true).step, tearsOf(false).step, "beside a cut it tears earlier");
});

claim("tearing", ["has to be too long for a little while, since one jerk of the solver is no tear"], () => {
    const damage_limit = engine.prefabs().find(({ name }) => name === "curtain").parameters.find(({ path }) => path.endsWith("damage_limit")).value;
    assert.ok(damage_limit > 0 && !("damage_limit" in sceneFile("tearing", 0.3).figures[0]));
    const stick = (steps) => { // a thread of 1 m that tears at 10 %, pulled 20 % too long for so many steps
        const simulation = engine.open({ sinew: 1, world: { gravity: [0, 0] }, figures: [{ name: "it", particles: { a: { at: [0, 0], pinned: true }, b: { at: [1, 0] } }, constraints: [{ between: ["a", "b"], breaking_strain: 0.1, damage_limit, compliance: 0.01 }] }] });
        const pin = simulation.pin("it/b");
        for (let i = 0; i < 60; ++i) {
            simulation.movePin(pin, [i < steps ? 1.2 : 1, 0]);
            simulation.step();
        }
        return simulation.events().filter(({ what }) => what === "torn").length;
    };
    assert.equal(stick(1), 0);
    assert.equal(stick(30), 1);
});

claim("tearing", ["it is points and threads that no longer have a way to the rod"], () => {
    const simulation = scene("tearing", 2), { particleCount, constraintCount } = simulation;
    simulation.runUntil(0.3);
    const cut = simulation.cut([60, 200], [580, 200]);
    above(cut, 30);
    simulation.runUntil(1);
    assert.equal(simulation.particleCount, particleCount);
    assert.equal(simulation.constraintCount, constraintCount - cut);
    const ys = [...simulation.positions].filter((_, i) => i % 2 === 1);
    above(Math.max(...ys), 430, "it falls");
    below(Math.min(...ys), 60, "and the rest hangs");
});

