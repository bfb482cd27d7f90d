// Claims of the lessons on integrators, iterations and substeps.
import assert from "node:assert/strict";
import { above, atRest, below, claim, close, engine, lesson, program } from "./reader.mjs";

/** Lowest, highest and last errors of the energies in so many seconds. */
const energies = (rate, seconds, replaced = []) => {
    const running = program("integrators", "rate", rate, { replaced }), seen = Array.from({ length: seconds }, () => running.run(60).live);
    const of = (name) => seen.map((live) => live[name]);
    return (name) => ({ low: Math.min(...of(name)), high: Math.max(...of(name)), end: of(name).at(-1) });
};
/** A function of the program of the integrators. */
const parts = (rate) => program("integrators", "rate", rate, { added: "lessonPointer.parts = {rules, planets, pull, energy, first, h};" }).pointer.parts;

claim("integrators", ["five planets on the same orbit, each moved by another rule", "rather few steps a round", "which in nature would be a level line"], () => {
    const { rules, planets } = parts(20);
    assert.equal(new Set(rules.map(({ name }) => name)).size, 5);
    assert.equal(new Set(planets.map(({ x, y, vx, vy }) => `${x} ${y} ${vx} ${vy}`)).size, 1);
    const fine = energies(120, 10);
    below(Math.abs(fine("rungeKutta4").low), 1e-6, "the finer, the more level");
});

claim("integrators", ["it gains energy in each round and leaves", "the only bad one", "two lines swapped, and you have symplectic Euler"], () => {
    for (const rate of [10, 20, 60]) above(energies(rate, 60)("explicitEuler").end, 0.5, `${rate}`);
    for (const name of ["symplecticEuler", "verlet", "velocityVerlet", "rungeKutta4"]) below(Math.abs(energies(20, 60)(name).end), 0.05, name);
    const { program } = lesson("integrators").figures[0];
    const [first, second] = ["explicitEuler", "symplecticEuler"].map((name) => program.slice(program.indexOf(`function ${name}`)).split("\n").slice(1, 4).map((line) => line.replace(/ *\/\/.*/, "").trim()));
    assert.deepEqual([first[0], first[2], first[1]], second, "two lines are swapped, and nothing else");
});

claim("integrators", ["Mind that its pull is still taken at the old place", "the first rule would be the second in disguise"], () => {
    const { rules: [, second], pull, h } = parts(20), start = { x: 57, y: 0, vx: 0, vy: 125 };
    const disguised = (p) => {
        p.x += h * p.vx;
        p.y += h * p.vy;
        const [ax, ay] = pull(p.x, p.y);
        p.vx += h * ax;
        p.vy += h * ay;
    };
    const one = { ...start }, other = { ...start }, [ax, ay] = pull(57, 0);
    other.vx += h * ax; // the speed of the second rule is that of the next step
    other.vy += h * ay;
    for (let i = 0; i < 50; ++i) {
        second(one);
        disguised(other);
        close(other.x, one.x, 1e-9);
        close(other.y + 1000, one.y + 1000, 1e-9);
    }
});

claim("integrators", ["which stays for ever", "they are off by at most 0.6 %, after a minute and after a day", "swing about the right energy and never drift", "where Verlet keeps within 1.4 %"], () => {
    const found = energies(20, 240);
    assert.ok(found("symplecticEuler").low > -0.03 && found("symplecticEuler").high < 0.05);
    for (const name of ["verlet", "velocityVerlet"]) {
        assert.ok(found(name).low > -0.0065 && found(name).high < 0.001, `${name} ${found(name).low}`);
        above(energies(12, 120)(name).low, -0.0145, name);
    }
    const { rules, energy, first } = parts(20), planet = { x: 57, y: 0, vx: 0, vy: 125 };
    let worst = 0;
    for (let i = 0; i < 24 * 3600 * 20; ++i) {
        rules[3](planet);
        if (i > 23 * 3600 * 20) worst = Math.max(worst, Math.abs(energy(planet) / first - 1));
    }
    below(worst, 0.0065, "the last hour of a day");
});

claim("integrators", ["the most exact over a few rounds, at four times the work", "with 12 steps a second 4 % are gone in two minutes", "Fewer steps make each rule show its character"], () => {
    const few = energies(30, 8);
    for (const name of ["explicitEuler", "symplecticEuler", "verlet", "velocityVerlet"]) below(Math.abs(few("rungeKutta4").low), Math.abs(few(name).low), name);
    close(energies(12, 120)("rungeKutta4").end, -0.04, 0.05);
    const running = program("integrators", "rate", 60, { replaced: [["function pull(x, y) {", "let calls = 0;\nfunction pull(x, y) {\n    ++calls;"]], added: "lessonPointer.work = (rule) => { calls = 0; rules[rule]({...planets[0]}); return calls; };" });
    assert.deepEqual([running.pointer.work(2), running.pointer.work(4)], [1, 4]);
});

claim("integrators", ["Verlet, if things are tied together", "Both with steps of the same length"], () => {
    const wobbling = energies(20, 240, [["const h = 1 / rate;", "let h = 1 / rate;"], ["for (due += dt; due >= h; due -= h)", "for (due += dt; due >= h; due -= h, h = (h > 0.05 ? 0.6 : 1.4) / rate)"]]);
    above(Math.max(Math.abs(wobbling("verlet").low), wobbling("verlet").high), 0.05, "Verlet with uneven steps");
});

const alone = ["const others = [1, 2, 4, 8, 16, 32, 64, 128].map(rope);", "const others = [];"]; // the ropes to compare cost time
const measured = { replaced: [alone], added: "lessonPointer.errors = () => { const found = []; const own_ = own.points; for (const p of own_) if (p.mobility > 0) fall(p, 1 / 60); found.push(worst(own)); for (let k = 0; k < 40; ++k) { for (let i = 0; i < sticks; ++i) mend(own_[i], own_[i + 1]); found.push(worst(own)); } return found; };" };

claim("iterations", ["In a rope each point belongs to two sticks", "Mend the first, and you have broken the second; mend the second, and the first is wrong again", "Each pass makes the errors smaller, but none makes them zero", "again and again"], () => {
    const running = program("iterations", "passes", 4, measured);
    running.run(900);
    const errors = running.pointer.errors();
    errors.slice(1).forEach((error, i) => below(error, errors[i] + 1e-12, `pass ${i + 1}`));
    above(errors.at(-1), 1e-3);
    const pair = program("iterations", "passes", 1, { added: "lessonPointer.pair = () => { const [a, b, c] = [0, 12, 24].map((x) => ({x, y: 0, mobility: 1})); mend(a, b); const first = b.x - a.x; mend(b, c); return [first, b.x - a.x, c.x - b.x]; };" }).pointer.pair();
    close(pair[0], 10, 1e-12);
    close(pair[2], 10, 1e-12);
    above(Math.abs(pair[1] - 10), 0.5, "broken by the second");
});

claim("iterations", ["behind your rope hang eight more, with 1, 2, 4 … 128 passes, and each dot is one of them", "each line is a tenth of the one above", "The large dot is yours", "downwards the error that is left"], () => {
    const running = program("iterations", "passes", 16, { added: "lessonPointer.ropes = others.map(({passes}) => passes); lessonPointer.down = down;" });
    assert.deepEqual([...running.pointer.ropes], [1, 2, 4, 8, 16, 32, 64, 128]);
    const { commands, live } = running.run(900), { down } = running.pointer;
    const dots = commands.filter(([shape, , , radius]) => shape === "disc" && radius === 3.5), graph = commands.find(([shape]) => shape === "graph");
    assert.equal(dots.length, 8);
    close(down(0.01) - down(0.1), down(0.1) - down(1), 1e-12);
    close(down(0.1) - down(1), graph[7] / (graph[3] - graph[2]), 1e-12, "a line");
    const yours = commands.find(([shape, , , radius]) => shape === "disc" && radius === 8);
    close(yours[1], dots[4][1], 1e-12);
    close(yours[2], dots[4][2], 1e-9, "the same passes leave the same error");
    close(live.stretch, 0.07, 0.04);
    dots.slice(1).forEach((dot, i) => above(dot[2], dots[i][2] - 1e-9, "downwards"));
});

claim("iterations", ["the rope is a rubber band", "8 passes leave 14 %, 16 leave 7 %", "Twice the passes leave about half of the error"], () => {
    const left = (passes) => atRest(program("iterations", "passes", passes, { replaced: [alone] }));
    above(left(1), 0.5);
    close(left(8), 0.14, 0.03);
    close(left(16), 0.07, 0.04);
    for (const passes of [8, 16, 32, 60]) {
        const ratio = left(passes) / left(2 * passes);
        assert.ok(ratio > 1.85 && ratio < 2.25, `${passes}: ${ratio}`);
    }
});

claim("iterations", ["A rope with twice as many sticks of half the length needs about four times as many passes"], () => {
    const finer = (sticks, passes) => atRest(program("iterations", "passes", passes, { replaced: [alone,
        ["sticks = 24, length = 10, weight = 24", `sticks = ${sticks}, length = ${240 / sticks}, weight = ${sticks}`],
        ["410 + 8.6 * i, y = 24 + 5 * i", `410 + ${8.6 * 24 / sticks} * i, y = 24 + ${5 * 24 / sticks} * i`]] }), "stretch", 20);
    for (const [sticks, passes] of [[6, 6], [12, 24]]) close(finer(2 * sticks, 4 * passes), finer(sticks, passes), 0.12);
});

claim("iterations", ["a weight ten times as heavy needs about ten times as many"], () => {
    const heavy = (weight, passes) => atRest(program("iterations", "passes", passes, { replaced: [alone, ["weight = 24", `weight = ${weight}`]] }), "stretch", 25);
    close(heavy(1000, 200), heavy(100, 20), 0.35);
});

claim("iterations", ["The rope above is now 29 % too long with 4 passes"], () => close(atRest(program("iterations", "passes", 4, { replaced: [alone] })), 0.285, 0.03));

claim("iterations", ["what the weight does reaches the nail only one stick further a pass"], () => {
    const running = program("iterations", "passes", 1, { replaced: [alone], added: "lessonPointer.news = () => { const p = own.points; p.forEach((one, i) => { [one.x, one.y] = [0, length * i]; }); p[sticks].y += 5; return Array.from({length: 5}, () => { for (let i = 0; i < sticks; ++i) mend(p[i], p[i + 1]); return p.findIndex((one, i) => Math.abs(one.y - length * i) > 0); }); };" });
    assert.deepEqual([...running.pointer.news()], [23, 22, 21, 20, 19]);
});

claim("substeps", ["16 passes leave 4.6 %, 16 substeps 0.31 %", "Twice the substeps leave a quarter of the error, where twice the passes leave about half of it", "Which rope gains more", "The ropes are not", "with 4 of either the ropes above are 19.5 % and 5.0 % too long"], () => {
    const found = (effort) => program("substeps", "effort", effort).run(900).live;
    close(found(16).left, 0.046, 0.03);
    close(found(16).right, 0.0031, 0.03);
    close(found(4).left, 0.195, 0.01);
    close(found(4).right, 0.05, 0.01);
    for (const effort of [2, 4, 8, 16]) {
        close(found(effort).right / found(2 * effort).right, 4, 0.02);
        close(found(effort).left / found(2 * effort).left, 2, 0.12);
    }
});

claim("substeps", ["The sticks are the same, the weights are the same, the work is the same", "go over the sticks 16 times after one step of 1/60 s: that is the rope on the left", "you take 16 steps of 1/960 s, and go over the sticks once after each"], () => {
    const running = program("substeps", "effort", 16, { replaced: [["function mend(a, b) {", "const count = {left: 0, right: 0};\nfunction mend(a, b) {\n    ++count[left.includes(b) ? \"left\" : \"right\"];"],
        ["function move(points, dt, passes) {", "const moves = [];\nfunction move(points, dt, passes) {\n    moves.push([points === left, dt, passes]);"]], added: "lessonPointer.seen = {count, moves, weights: [left, right].map((rope) => rope.map(({mobility}) => mobility).join())};" });
    running.run(1);
    const { count, moves, weights } = running.pointer.seen;
    assert.ok(count.left === 16 * 24 && count.right === count.left, `${count.left} ${count.right}`);
    assert.deepEqual([...moves.map(([isLeft, dt, passes]) => `${isLeft ? "left" : "right"} 1/${Math.round(1 / dt)} ${passes}`)], ["left 1/60 16", ...Array.from({ length: 16 }, () => "right 1/960 1")]);
    assert.equal(weights[0], weights[1]);
});

claim("substeps", ["In a step of half the length a point falls a quarter as far", "there is a quarter of the error to mend"], () => {
    const fallen = (dt) => program("substeps", "effort", 1, { replaced: [["mend(points[i], points[i + 1]);", ";"]], added: `lessonPointer.fallen = () => { const y = left[5].y; move(left, ${dt}, 1); return left[5].y - y; };` }).pointer.fallen();
    close(fallen(1 / 60) / fallen(1 / 120), 4, 1e-9);
});

claim("substeps", ["Small steps win, and they also lose less energy"], () => {
    const running = program("substeps", "effort", 16, { replaced: [["0.995 ** (60 * dt)", "1"], ["x + 3 * i, y: 24 + 9.5 * i", "x + 5 * i, y: 24 + 8.66 * i"]], added: "const drawn = draw; draw = () => { drawn(); show(\"leftSwing\", Math.abs(left[24].x - left[0].x)); show(\"rightSwing\", Math.abs(right[24].x - right[0].x)); };" });
    const seen = Array.from({ length: 1800 }, () => running.run(1).live), last = (name) => Math.max(...seen.slice(-300).map((live) => live[name]));
    above(last("rightSwing"), 1.3 * last("leftSwing"), "after half a minute without air");
});

claim("substeps", ["Sinew takes 16 substeps in physical mode"], () => {
    const after = (substeps) => {
        const simulation = engine.open({ sinew: 1, dimension: 3, world: { gravity: [0, -9.81, 0] }, solver: { substeps }, figures: [{ prefab: "cloth", plane: "horizontal", pins: "corners" }] });
        simulation.runUntil(0.5);
        return simulation.positions.slice();
    };
    assert.deepEqual(after(0), after(16));
    assert.notDeepEqual(after(0), after(15));
});
