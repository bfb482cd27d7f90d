// Claims of the lessons on softness, exact ropes, energy and determinism.
import assert from "node:assert/strict";
import { load } from "../../sinew/index.js";
import { above, atRest, below, claim, close, engine, lesson, program, programOf, scene, sceneFile, texts } from "./reader.mjs";

const part = "const part = (now - length) / now / (a.mobility + b.mobility + softness);";
/** How far the soft weight hangs, with parts of the program replaced. */
const hangs = (replaced, compliance = 0.05) => program("compliance", "compliance", compliance, { replaced }).run(60 * 40).live.hangs;

claim("compliance", ["the tutorials remove only a part of the error in each pass", "how soft it gets depends on the number of passes and of frames: the same scene is stiffer on a faster computer"], () => {
    const soft = (passes, substeps) => hangs([["softness);", "softness * 0) * 0.02;"], ["substeps = 8", `substeps = ${substeps}`], ["spring(top, soft, 120, compliance / (h * h));", `for (let pass = 0; pass < ${passes}; ++pass) spring(top, soft, 120, 0);`]]);
    above(soft(1, 2), 1.8 * soft(2, 2), "twice the passes");
    above(soft(1, 2), 3 * soft(1, 4), "twice the frames");
    assert.ok(lesson("compliance").figures[0].program.includes(part));
});

claim("compliance", ["how far it gives for each unit of force", "The stiffness upside down", "Zero is rigid", "A weight of 2 kg pulls with m·g = 1960 kg px/s²", "Times the compliance, that is how far it hangs", "98 px, with any number of substeps, on any machine", "compare with the yellow line, the formula’s", "Then write another number of substeps"], () => {
    for (const compliance of [0, 0.02, 0.05, 0.12]) for (const substeps of [1, 4, 16]) close(hangs([["substeps = 8", `substeps = ${substeps}`]], compliance) + 1, 1960 * compliance + 1, 1e-3, `${compliance} ${substeps}`);
    close(1960 * 0.05, 98, 1e-12);
    const running = program("compliance", "compliance", 0.05), { commands } = running.run(1), line = commands.find(([shape, , , color]) => shape === "path" && color === "#e9a820");
    close(line[1][1], 140 + 98, 1e-9);
    const simulation = engine.open({ sinew: 1, units: { length: "px", time: "s", up: "-y" }, world: { gravity: [0, 980], damping: 2 }, figures: [{ name: "it", particles: { a: { at: [0, 0], pinned: true }, b: { at: [0, 120], mass: 2 } }, constraints: [{ between: ["a", "b"], compliance: 0.05 }] }] });
    simulation.runUntil(20);
    close(simulation.stateOf("it/b").position[1], 120 + 98, 1e-3, "in Sinew");
});

claim("compliance", ["The method is called XPBD", "With more than one pass in a step a rule also has to remember the force it has used so far; with one pass, as here, it need not"], () => {
    const passes = ["spring(top, soft, 120, compliance / (h * h));", "lambda = 0;\n        for (let pass = 0; pass < 6; ++pass) spring(top, soft, 120, compliance / (h * h));"];
    const begin = ["function spring(", "let lambda = 0;\nfunction spring("];
    const forgetful = hangs([passes, begin]);
    const remembering = hangs([passes, begin, [part, "const more = -((now - length) + softness * lambda * (softness > 0)) / (a.mobility + b.mobility + softness);\n    if (softness > 0) lambda += more;\n    const part = -more / now;"]]);
    close(remembering, 98, 1e-2);
    below(forgetful, 60, "too stiff");
});

claim("rope", ["On the left the tutorials’ rope, with ten passes a frame", "a rope of one kilogram with the weight that you choose", "on the left all points weigh the same", "Make the right one a thousand times heavier than its rope", "The ropes above are now 16.8 % and 0 % too long"], () => {
    for (const weight of [1, 100, 1000]) {
        const physical = scene("rope", weight), classic = scene("rope", weight, { mode: "classic" });
        const masses = [...physical.inverseMasses].map((inverse) => 1 / inverse);
        close(masses.at(-1), weight, 0.02, "the weight");
        close(masses.slice(0, -1).reduce((sum, mass) => sum + mass, 0), 1, 0.05, "the rope");
        physical.runUntil(4);
        classic.runUntil(4);
        below(physical.report().stretchMax, 1e-5, weight);
        above(classic.report().stretchMax, 0.01);
        classic.runUntil(10);
        close(classic.report().stretchMax, 0.168, 0.01);
    }
    assert.equal(sceneFile("rope", 100).modes.classic.solver.passes, 10);
    assert.equal(new Set(scene("rope", 100, { mode: "classic" }).inverseMasses).size, 1, "on the left all weigh the same");
});

claim("rope", ["A sweep passes news from stick to stick", "a heavy weight at the end of light sticks is the worst case: each pass moves the light points and hardly the weight", "Ten times the weight needs ten times the passes"], () => {
    const replaced = [["const others = [1, 2, 4, 8, 16, 32, 64, 128].map(rope);", "const others = [];"]];
    const heavy = (weight, passes) => atRest(program("iterations", "passes", passes, { replaced: [...replaced, ["weight = 24", `weight = ${weight}`]] }), "stretch", 25);
    close(heavy(1000, 200), heavy(100, 20), 0.35);
    const moved = program("iterations", "passes", 1, { added: "lessonPointer.moved = () => { const a = {x: 0, y: 0, mobility: 1}, b = {x: 0, y: 12, mobility: 1 / weight}; mend(a, b); return [a.y, 12 - b.y]; };" }).pointer.moved();
    close(moved[0] / moved[1], 24, 1e-9);
});

const table = (shape) => {
    const running = program("rope", "shape", shape, { i: 1, added: "lessonPointer.table = table;" });
    const { filled, work } = running.run(900).live, rows = running.pointer.table, n = rows.length;
    const full = rows.reduce((sum, row, i) => sum + row.slice(0, i + 1).filter(Boolean).length, 0);
    return { filled, work, n, share: full / (n * (n + 1) / 2), rows };
};

claim("rope", ["a table in which line i tells how stick i is moved by the forces in all others", "For a row of sticks it is nearly empty, since each knows only its neighbours, and it stays empty while it is solved", "one way down and one way up, as many steps as there are sticks", "A ring fills one line, a net half of the table", "an entry that was empty and had to be filled in", "Blue: two sticks share a point", "Watch the table being solved, line by line"], () => {
    const [row, ring, net] = [0, 1, 2].map(table);
    assert.deepEqual([row.filled, row.work, row.n], [0, 17, 18]);
    below(row.share, 0.25);
    const lines = ring.rows.map((line, i) => line.slice(0, i).filter((entry) => entry === "filled").length);
    assert.deepEqual([...lines].filter((count) => count > 0), [15], "one line");
    close(net.share, 0.5, 0.1);
    above(net.work, 10 * row.work);
});

claim("rope", ["So Sinew does not sweep a rope at all", "Figures that hang together like trees, ropes, ragdolls, chains and bridges are solved like this, exactly", "Cloth, with its many loops, is swept"], () => {
    const stretch = (prefab) => {
        const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] }, figures: [{ prefab }] });
        let most = 0;
        for (let i = 0; i < 120; ++i) {
            simulation.step();
            most = Math.max(most, simulation.report().stretchMax);
        }
        return most;
    };
    for (const prefab of ["rope", "chain", "ragdoll", "bridge"]) below(stretch(prefab), 1e-6, prefab);
    above(stretch("cloth"), 1e-5);
});

const swings = lesson("swing").figures[0];

claim("swing", ["it should swing for ever, as high each time", "Leave it alone for a minute with no friction", "Energy goes to and fro between height and motion: the two bars", "Together they should stay as long as they are, and here they do", "100 % are left"], () => {
    const free = scene("swing", 0), first = swings.live(free).left;
    close(first, 1, 0.01);
    const motions = [];
    for (let i = 1; i <= 600; ++i) {
        free.runUntil(i / 10);
        const { height, motion, left } = swings.live(free);
        motions.push(motion);
        close(height + motion, left, 1e-9);
        close(left, first, 1e-3, `after ${i / 10} s`);
    }
    above(Math.max(...motions), 0.95);
    below(Math.min(...motions), 0.01);
    const late = Math.max(...motions.slice(-60));
    close(late, Math.max(...motions.slice(0, 60)), 0.05, "as fast in the last six seconds");
});

claim("swing", ["Then add some: the energy sinks as fast as you say", "with 0.5 the speed falls to 61 % in a second", "Friction is then a number of yours, in 1/s"], () => {
    const rubbed = scene("swing", 0.2);
    rubbed.runUntil(20);
    close(Math.log(swings.live(rubbed).left), -0.2 * 20, 0.05);
    const lone = engine.open({ sinew: 1, units: { length: "px", time: "s" }, world: { gravity: [0, 0], damping: 0.5 }, figures: [{ name: "one", particles: { one: { at: [0, 0], velocity: [100, 0] } } }] });
    lone.runUntil(1);
    close(lone.stateOf("one/one").velocity[0], 100 * Math.exp(-0.5), 2e-3);
    close(Math.exp(-0.5), 0.61, 0.01);
});

/** A pendulum as lessons 1 and 2 step it, so many steps a frame: how much higher than its pin's height it is lower after so many frames, in pixels. */
const lostHeight = (substeps, frames) => {
    const running = programOf(`
const ball = {x: 470, y: 100, oldX: 470, oldY: 100};
function step(dt) {
    for (let i = 0, h = dt / ${substeps}; i < ${substeps}; ++i) {
        const speedX = ball.x - ball.oldX, speedY = ball.y - ball.oldY;
        [ball.oldX, ball.oldY] = [ball.x, ball.y];
        ball.x += speedX;
        ball.y += speedY + 700 * h * h;
        const x = ball.x - 320, y = ball.y - 100, now = Math.hypot(x, y);
        [ball.x, ball.y] = [320 + x * 150 / now, 100 + y * 150 / now];
    }
}
function draw() { show("lost", ball.y - 100); }`);
    running.run(frames - 150);
    return Math.min(...Array.from({ length: 150 }, () => running.run(1).live.lost));
};

claim("swing", ["Most engines lose a little in each step", "But then the number of steps decides when", "Verlet’s step keeps energy well; the mending loses it", "each such correction comes late, and the longer the step the more it takes", "the pull is that of the end of the step, not of the way there"], () => {
    const lost = [2, 4, 8].map((substeps) => lostHeight(substeps, 300));
    above(lost[0], 10);
    lost.slice(1).forEach((one, i) => close(one, lost[i] / 2, 0.2, "steps of half the length"));
    const planets = program("integrators", "rate", 20);
    below(Math.abs(Array.from({ length: 60 }, () => planets.run(60).live).at(-1).verlet), 0.0065, "nothing is mended");
});

claim("swing", ["Sinew solves for speeds as well as for places, so what was mended also moves along the circle"], () => {
    const simulation = scene("swing", 0), links = simulation.constraintsOf("distance").length;
    for (let step = 0; step < 120; ++step) {
        simulation.step();
        const { positions: p, velocities: v, ends } = simulation, fastest = simulation.report().maxSpeed;
        for (let i = 0; i < links; ++i) {
            const [a, b] = [ends[2 * i], ends[2 * i + 1]], x = p[2 * b] - p[2 * a], y = p[2 * b + 1] - p[2 * a + 1];
            const opening = ((v[2 * b] - v[2 * a]) * x + (v[2 * b + 1] - v[2 * a + 1]) * y) / Math.hypot(x, y);
            below(Math.abs(opening), 1e-3 * Math.max(fastest, 1), `step ${step}, link ${i}`);
        }
    }
});

const pendulums = lesson("determinism").figures[0];
const apartAfter = (value, seconds) => {
    const simulation = scene("determinism", value), seen = [];
    for (let i = 1; i <= 10 * seconds; ++i) {
        simulation.runUntil(i / 10);
        seen.push(pendulums.live(simulation).apart);
    }
    return { simulation, reached: (apart) => (seen.findIndex((one) => one > apart) + 1) / 10, seen };
};

claim("determinism", ["a red one before a blue one", "They start in the same place, to the last bit, and you see only one", "a millionth of a millionth of a pixel, say", "do they ever do something else"], () => {
    const { simulation, seen } = apartAfter(0, 20);
    assert.ok(seen.every((apart) => apart === 0));
    const first = simulation.hash();
    simulation.restart();
    simulation.runUntil(20);
    assert.equal(simulation.hash(), first);
    const { slider } = pendulums;
    assert.ok(slider.low <= -12 && slider.high >= -12);
});

claim("determinism", ["here a difference grows tenfold about every 2.4 seconds, until nothing is the same", "From 10⁻¹³ px to a hundredth of one are eleven decades, so you see two after some 22 seconds", "when do you see two", "And with 10⁻⁶"], () => {
    const { reached, seen } = apartAfter(-13, 60);
    close((reached(1e-2) - reached(1e-11)) / 9, 2.4, 0.15, "seconds a decade");
    close(reached(1e-2), 22, 0.05, "seconds until it shows");
    above(Math.max(...seen), 100, "pixels");
    below(apartAfter(-6, 20).reached(1e-2), 15, "sooner");
});

claim("determinism", ["If two computers differed in the last bit of a single square root, they would soon show another scene"], () => {
    const other = JSON.stringify(sceneFile("determinism", 0)).replace("114.0175425099138", "114.01754250991381");
    const simulation = engine.open(other);
    assert.notEqual(114.0175425099138, 114.01754250991381);
    simulation.runUntil(60);
    above(pendulums.live(simulation).apart, 0.01);
});

claim("determinism", ["Yet a scene of Sinew ends with the same bits on a phone and on a server, with one thread or eight", "sums in the same order always"], async () => {
    const file = { ...sceneFile("cloth", 36), figures: [{ ...sceneFile("cloth", 36).figures[0], columns: 72, rows: 72 }] };
    const hashes = [];
    for (const threads of [1, 2, 8]) {
        const one = await load(undefined, { threads });
        assert.equal(one.threads, threads);
        const simulation = one.open(file);
        simulation.step(5);
        hashes.push(simulation.hash());
        one.stop();
    }
    assert.equal(new Set(hashes).size, 1);
});

claim("determinism", ["a replay is a list of what was pressed, a bug can be sent in a message", "The line below the figure has the hash of everything that moves"], () => {
    const played = () => {
        const simulation = scene("tearing", 0.3);
        simulation.step(20);
        simulation.grab([320, 200], 60);
        for (let i = 0; i < 30; ++i) {
            simulation.drag([320 + 3 * i, 200]);
            simulation.step();
        }
        simulation.letGo();
        simulation.step(20);
        return simulation.hash();
    };
    assert.equal(played(), played());
    const simulation = scene("determinism", 0), before = simulation.hash();
    simulation.setVelocity("red/foot", [0, 1e-12]);
    assert.notEqual(simulation.hash(), before);
});

claim("determinism", ["what every +, −, ×, ÷ and square root must give, to the last bit", "Only order and shortcuts differ", "Rounding is not random, though", "It is."], () => {
    assert.equal(0.1 + 0.2, 0.30000000000000004);
    assert.equal(Math.sqrt(2), 1.4142135623730951);
    assert.notEqual((0.1 + 0.2) + 0.3, 0.1 + (0.2 + 0.3));
});

claim("determinism", ["The same in a program, with the package"], () => {
    const simulation = scene("determinism", -6);
    for (const text of Object.values(texts)) {
        const { code } = text.lessons.determinism.listing;
        let checked = 0;
        new Function("simulation", "console", code)(simulation, { assert: (holds) => { assert.ok(holds); ++checked; } });
        assert.equal(checked, 1);
    }
});

