// Claims of the lessons on triangles, boxes and chains.
import assert from "node:assert/strict";
import { above, below, claim, close, engine, handAt, lesson, program, programOf, scene, sceneFile, texts } from "./reader.mjs";

/** Distances between all particles. */
function distances(simulation) {
    const { positions: p } = simulation, all = [];
    for (let i = 0; i < p.length; i += 2) for (let k = 0; k < i; k += 2) all.push(Math.hypot(p[i] - p[k], p[i + 1] - p[k + 1]));
    return all;
}
const spread = (corners) => {
    const simulation = scene("triangle", corners), first = distances(simulation);
    simulation.runUntil(4);
    return Math.max(...distances(simulation).map((now, i) => Math.abs(now / first[i] - 1)));
};

claim("triangle", ["a triangle cannot change its shape", "More corners, and it can", "watch it fold", "With twelve corners and no braces you get a bag, or a chain that is closed"], () => {
    below(spread(3), 1e-3);
    for (const corners of [4, 7, 12]) above(spread(corners), 0.2, corners);
});

claim("triangle", ["so n corners have 2n ways to move", "Each stick takes one away", "so 2n − 3 sticks make it stiff", "For a triangle that is 3, and it has 3", "A square has 4, and needs 5", "The figure above has 3 sticks and needs 3"], () => {
    const { live } = lesson("triangle").figures[0];
    for (const n of [3, 4, 12]) assert.deepEqual(live(scene("triangle", n), n), { corners: n, sticks: n, ways: 2 * n, needed: 2 * n - 3, missing: n - 3 });
    const stiff = sceneFile("triangle", 7); // a fan of diagonals: 7 + 4 = 2 * 7 - 3
    stiff.constraints = [2, 3, 4, 5].map((i) => ({ between: [cornersOf(stiff)[0], cornersOf(stiff)[i]] }));
    const simulation = engine.open(stiff), first = distances(simulation);
    assert.equal(simulation.constraintCount, 2 * 7 - 3);
    simulation.runUntil(4);
    below(Math.max(...distances(simulation).map((now, i) => Math.abs(now / first[i] - 1))), 1e-3);
    const loose = sceneFile("triangle", 7);
    loose.constraints = stiff.constraints.slice(1);
    const other = engine.open(loose), before = distances(other);
    other.runUntil(4);
    above(Math.max(...distances(other).map((now, i) => Math.abs(now / before[i] - 1))), 0.02, "one stick less");
});
const cornersOf = (file) => {
    const simulation = engine.open({ ...file, constraints: [] });
    return Array.from({ length: simulation.particleCount }, (_, i) => simulation.nameOf(simulation.particle(i)));
};

claim("triangle", ["some figures are scene files that Sinew runs", "They are text as well"], () => {
    assert.equal(sceneFile("triangle", 3).sinew, 1);
});

const shapeOf = (simulation, seconds) => {
    simulation.runUntil(seconds);
    const ys = [...simulation.positions].filter((_, i) => i % 2 === 1);
    return Math.max(...ys) - Math.min(...ys);
};

claim("box", ["a box that falls flat", "The stick that was missing is a diagonal", "2 · 4 − 3 = 5"], () => {
    below(shapeOf(scene("box", 0), 8), 65);
    for (const braces of [1, 2]) above(shapeOf(scene("box", braces), 8), 120);
    assert.deepEqual([0, 1, 2].map((braces) => scene("box", braces).constraintCount), [4, 5, 6]);
});

claim("box", ["The second diagonal is one stick more than needed", "Where all lengths fit, it changes nothing"], () => {
    const [one, both] = [scene("box", 1), scene("box", 2)];
    for (let seconds = 0.5; seconds <= 3; seconds += 0.5) {
        one.runUntil(seconds);
        both.runUntil(seconds);
        below(Math.max(...one.positions.map((place, i) => Math.abs(place - both.positions[i]))), 1e-6, "pixels");
    }
});

/** A box of one's own: corners and sides as lesson 2 mends them; the last stick is the second diagonal. */
const ownBox = (diagonal, moves = 1) => programOf(`
const corners = [[240, 140], [370, 140], [370, 270], [240, 270]].map(([x, y]) => ({x, y, oldX: x - 1, oldY: y}));
const sticks = [[0, 1, 130], [1, 2, 130], [2, 3, 130], [3, 0, 130], [0, 2, 130 * Math.SQRT2], [1, 3, ${diagonal}]];
function step(dt) {
    for (let i = 0; i < ${moves}; ++i) for (const p of corners) {
        const speedX = 0.99 * (p.x - p.oldX), speedY = 0.99 * (p.y - p.oldY);
        [p.oldX, p.oldY] = [p.x, p.y];
        p.x += speedX;
        p.y += speedY + 700 * dt * dt;
    }
    for (let pass = 0; pass < 8; ++pass) for (const [i, k, length] of sticks) {
        const a = corners[i], b = corners[k], x = b.x - a.x, y = b.y - a.y, now = Math.hypot(x, y), part = (now - length) / now / 2;
        a.x += x * part;  a.y += y * part;  b.x -= x * part;  b.y -= y * part;
    }
    for (const p of corners) walls(p);
}
function draw() {
    show("speed", 60 * Math.max(...corners.map((p) => Math.hypot(p.x - p.oldX, p.y - p.oldY))));
    show("off", Math.max(...sticks.slice(0, 4).map(([i, k, length]) => Math.abs(Math.hypot(corners[k].x - corners[i].x, corners[k].y - corners[i].y) / length - 1))));
}`);
const last = (running, name) => {
    running.run(600);
    return Math.max(...Array.from({ length: 120 }, () => running.run(1).live[name]));
};

claim("box", ["the sticks quarrel, and some do not get their lengths", "before the last brace of the file", "Sinew’s box is bent, and lies still", "a box of your own shakes, and this is the usual reason"], () => {
    const file = sceneFile("box", 1), text = JSON.stringify(file);
    const said = JSON.parse(`{${/"constraints": .*?\}\]/.exec(textOfBox())[0]}}`).constraints;
    const simulation = engine.open(`${text.slice(0, -1)}, "constraints": ${JSON.stringify(said)}}`);
    simulation.runUntil(8);
    above(simulation.report().stretchMax, 0.05);
    const still = simulation.positions.slice();
    simulation.runUntil(10);
    below(Math.max(...still.map((place, i) => Math.abs(place - simulation.positions[i]))), 0.01, "pixels in two seconds");
    below(last(ownBox("130 * Math.SQRT2"), "speed"), 20, "one that fits lies");
    for (const wrong of [150, 220]) {
        above(last(ownBox(wrong), "speed"), 200, "one that does not shakes");
        above(last(ownBox(wrong), "off"), 0.02);
    }
});
/** The lesson's words on the wrong length. */
const textOfBox = () => texts.en.lessons.box.after[0].replace(/<[^>]*>/g, "");

claim("box", ["The box also tumbles, lands on an edge and rolls over"], () => {
    const simulation = scene("box", 1), turns = [];
    for (let i = 1; i <= 30; ++i) {
        simulation.runUntil(i / 10);
        const [ax, ay, bx, by] = simulation.positions;
        turns.push(Math.atan2(by - ay, bx - ax));
    }
    const turned = turns.slice(1).reduce((sum, turn, i) => sum + Math.atan2(Math.sin(turn - turns[i]), Math.cos(turn - turns[i])), 0);
    above(Math.abs(turned), Math.PI / 4, "radians");
});

claim("box", ["The bounce sets the old place too far behind the wall, which gives the point more speed than it had"], () => {
    const speeds = (mirrored) => {
        const running = program("point", "gravity", 0, { replaced: [["ball[old] = inside + 0.85 * (ball[now] - ball[old]);", mirrored]] });
        const all = Array.from({ length: 240 }, () => running.run(1).live.speed);
        return Math.max(...all.slice(60)) / all[0];
    };
    below(speeds("ball[old] = inside + 1 * (ball[now] - ball[old]);"), 1 + 1e-9);
    above(speeds("ball[old] = ball[now] + (ball[now] - ball[old]);"), 1.2, "mirrored in the place behind the wall");
});

claim("box", ["points are moved six times a frame and the sticks only once: then the sticks never catch up", "Move and mend the same number of times"], () => {
    below(last(ownBox("130 * Math.SQRT2", 1), "off"), 0.01);
    const off = last(ownBox("130 * Math.SQRT2", 6), "off");
    assert.ok(!(off < 0.1), `${off}`);
});

claim("chain", ["the angle between two links is at most so large", "A limit, not a value", "acts only when the angle is too large"], () => {
    for (const limit of [5, 20, 60]) {
        const simulation = scene("chain", limit), angles = simulation.constraintsOf("angle");
        assert.equal(angles.length, 12);
        let most = 0, acted = 0;
        for (let i = 0; i < 180; ++i) {
            simulation.step();
            for (const id of angles) {
                const { measure, tension } = simulation.loadOf(id), degrees = Math.abs(measure) * 180 / Math.PI;
                most = Math.max(most, degrees);
                acted += Math.abs(tension) > 0;
                if (degrees < limit - 1) below(Math.abs(tension), 1e-6, `at ${degrees} of ${limit} degrees`);
            }
        }
        below(most, limit + 1);
        if (limit < 20) above(acted, 0, "it acts");
    }
    const free = scene("chain", 180);
    assert.equal(free.constraintsOf("angle").length, 0);
});

claim("chain", ["A chain is sticks in a row", "the lower of two loops takes all of the error: cheap, and it hangs beautifully", "a chain that is dragged about gains speed from nowhere", "The first is gone when loops share the error by their masses"], () => {
    const energyOf = (share) => { // a chain in empty space, once turned: nothing may speed it up
        const running = programOf(`
const loops = Array.from({length: 9}, (_, i) => ({x: 200 + 24 * i, y: 200, oldX: 200 + 24 * i, oldY: 200 - 0.5 * (i - 4)}));
function step() {
    for (const p of loops) { const x = 2 * p.x - p.oldX, y = 2 * p.y - p.oldY; [p.oldX, p.oldY, p.x, p.y] = [p.x, p.y, x, y]; }
    for (let i = 0; i < 8; ++i) {
        const a = loops[i], b = loops[i + 1], x = b.x - a.x, y = b.y - a.y, now = Math.hypot(x, y), part = (now - 24) / now;
        a.x += x * part * ${share};  a.y += y * part * ${share};
        b.x -= x * part * (1 - ${share});  b.y -= y * part * (1 - ${share});
    }
}
function draw() { show("momentum", Math.hypot(loops.reduce((sum, p) => sum + p.x - p.oldX, 0), loops.reduce((sum, p) => sum + p.y - p.oldY, 0))); }`);
        return Math.max(...Array.from({ length: 300 }, () => running.run(1).live.momentum));
    };
    below(energyOf(0.5), 1e-9, "shared by masses");
    above(energyOf(0), 0.1, "the lower one takes all");
});

claim("chain", ["Measure something, say between which limits it may be, and how its points move it", "A rope is a distance of at most L", "An elbow is an angle between 0 and 150°"], () => {
    const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] }, figures: [{ name: "it", particles: { a: { at: [0, 0], pinned: true }, b: { at: [0.5, 0] } }, constraints: [{ between: ["a", "b"], high: 1 }] }] });
    const far = () => Math.hypot(...simulation.stateOf("it/b").position);
    below(far(), 0.6);
    let most = 0;
    for (let i = 0; i < 240; ++i) {
        simulation.step();
        most = Math.max(most, far());
    }
    close(most, 1, 1e-4);
    const bent = engine.open({ sinew: 1, figures: [{ name: "arm", particles: { a: { at: [-1, 0] }, b: { at: [0, 0] }, c: { at: [1, 0.1], velocity: [0, -4] } }, constraints: [{ between: ["a", "b"] }, { between: ["b", "c"] }, { kind: "angle", between: ["a", "b", "c"], low: 0, high: 150 }] }] });
    const [elbow] = bent.constraintsOf("angle");
    for (let i = 0; i < 120; ++i) {
        bent.step();
        above(bent.loadOf(elbow).measure, -0.02, "it does not bend back");
    }
});

claim("chain", ["Its loops are put where the mouse is, and Verlet reads that as speed", "it is displaced twice, and each frame adds", "set the place before to the place now"], () => {
    const dragged = (hand) => {
        const running = program("point", "gravity", 0, { replaced: [["if (held([ball])) {", `if (held([ball])) {\n        ${hand}\n        return;`], ["bounce(\"x\"", "// bounce(\"x\""], ["bounce(\"y\"", "// bounce(\"y\""]], added: "let lastX = 70;\nlessonPointer.speed = () => ball.x - ball.oldX;" });
        for (let i = 0; i < 10; ++i) handAt(running, 70 + 2 * i, 330);
        return running.pointer.speed();
    };
    close(dragged("ball.x = pointer.x;"), 2, 1e-9, "put at the hand: its speed");
    above(dragged("ball.x += pointer.x - lastX; lastX = pointer.x;"), 15, "and displaced twice: each frame adds");
    close(dragged("ball.x = ball.oldX = pointer.x;") + 1, 1, 1e-9, "forgotten");
});
