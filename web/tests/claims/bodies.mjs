// Claims of the lessons on ragdolls, curves and the reader's own engine.
import assert from "node:assert/strict";
import { catalogue } from "../../sinew/index.js";
import { above, below, claim, close, engine, handAt, lesson, program, programOf, programText, scene, sceneFile } from "./reader.mjs";

const sag = (torque) => {
    const simulation = scene("ragdoll", torque);
    simulation.runUntil(6);
    return lesson("ragdoll").figures[0].live(simulation).sag;
};

claim("ragdoll", ["A man is fourteen points: head and neck, and two each of shoulders, elbows, hands, hips, knees and feet", "Bones are sticks between them", "put a dot on every joint"], () => {
    const simulation = scene("ragdoll", 30), names = Array.from({ length: simulation.particleCount }, (_, i) => simulation.nameOf(simulation.particle(i)).replace("bob/", ""));
    const pairs = ["shoulder", "elbow", "hand", "hip", "knee", "foot"].flatMap((part) => [`left_${part}`, `right_${part}`]);
    assert.deepEqual(names.sort(), ["head", "neck", ...pairs].sort());
    above(simulation.constraintsOf("distance").length, 13);
});

claim("ragdoll", ["Elbows and knees are angles with limits, so that they bend one way only", "Last come the limits, or his knees bend backwards"], () => {
    const knee = (limited) => { // the shin thrown forwards, against the limit
        const simulation = engine.open({ sinew: 1, world: { gravity: [0, 0] }, figures: [{ prefab: "ragdoll", name: "bob", height: 1.6, pose: "star" }] });
        if (!limited) for (const id of simulation.constraintsOf("angle")) simulation.removeConstraint(id);
        const places = ["left_hip", "left_knee", "left_foot"].map((name) => simulation.particle(`bob/${name}`));
        const angle = () => {
            const [[ax, ay], [bx, by], [cx, cy]] = places.map((id) => simulation.stateOf(id).position);
            const turn = Math.atan2(cy - by, cx - bx) - Math.atan2(by - ay, bx - ax);
            return Math.atan2(Math.sin(turn), Math.cos(turn));
        };
        const range = [0, 0], first = angle();
        for (const speed of [6, -6]) {
            simulation.setVelocity("bob/left_foot", [speed, 0]);
            for (let i = 0; i < 30; ++i) {
                simulation.step();
                range[speed > 0 ? 1 : 0] = speed > 0 ? Math.max(range[1], angle() - first) : Math.min(range[0], angle() - first);
            }
        }
        return range;
    };
    const [low, high] = knee(true), [freeLow, freeHigh] = knee(false);
    above(freeHigh - freeLow, high - low + 0.2, "without limits it bends further");
    above(Math.max(-low, high), 3 * Math.min(-low, high), "and with them one way only");
});

claim("ragdoll", ["A hand that is pinned hangs him up"], () => {
    const file = sceneFile("ragdoll", 30);
    const simulation = engine.open({ ...file, constraints: [], pins: [file.pins[0]] });
    simulation.runUntil(12);
    const height = (name) => simulation.stateOf(`bob/${name}`).position[1];
    for (const name of ["head", "left_hip", "left_foot", "right_hand"]) below(height(name), height("left_hand") - 0.05, name);
});

claim("ragdoll", ["above their largest torque they give way", "how strong must he be for the cross"], () => {
    for (const torque of [5, 30]) {
        const simulation = scene("ragdoll", torque);
        simulation.runUntil(4);
        const loads = simulation.constraintsOf("angle").slice(-6).map((id) => Math.abs(simulation.loadOf(id).tension));
        close(Math.max(...loads), torque, 0.02, "newton metres");
    }
    const found = [1, 100, 300, 1000].map(sag);
    found.slice(1).forEach((one, i) => below(one, found[i] - 1, "centimetres"));
});

claim("ragdoll", ["hidden sticks (a beam from hip to the other shoulder, a rope from knee to knee) kept the limbs apart", "They still work; open ragdoll in the playground and switch it to classic"], async () => {
    const entry = (await catalogue()).find(({ name }) => name === "ragdoll");
    assert.ok(entry.modes.includes("classic"));
    const [physical, classic] = ["physical", "classic"].map((mode) => engine.open(entry.text, { ...entry, overrides: { mode } }));
    assert.equal(classic.constraintsOf("angle").length, 0);
    above(physical.constraintsOf("angle").length, 0);
    above(classic.constraintsOf("distance").length, physical.constraintsOf("distance").length);
    classic.runUntil(3);
    assert.ok(classic.positions.every(Number.isFinite));
});

claim("ragdoll", ["a trunk of four sticks is a box without a diagonal, so it gets one"], () => {
    const trunk = (name) => lesson("capstone").figures[0].program.includes(name);
    for (const stick of ["leftShoulder rightShoulder", "leftHip rightHip", "leftShoulder leftHip", "rightShoulder rightHip", "leftShoulder rightHip"]) assert.ok(trunk(stick), stick);
});

claim("ragdoll", ["The drawing on top (shirt, head, shoes) hangs on the points and changes nothing"], () => {
    const run = (looks) => {
        const file = sceneFile("ragdoll", 30);
        file.figures[0].looks = looks;
        const simulation = engine.open(file);
        simulation.runUntil(2);
        return [simulation.positions.slice(), simulation.draw().length];
    };
    const [places, items] = run({}), [others, fewer] = run({ all: { hidden: true } });
    assert.deepEqual(places, others);
    below(fewer, items, "another picture");
});

claim("ragdoll", ["Each point is kept out of the wall by itself, the sticks pull the rest along, and so he tumbles", "There is none for him"], () => {
    const text = programText("capstone", "stiffness", 12);
    assert.equal(text.match(/walls\(/g).length, 1);
    const running = programOf(`${text}\nlessonPointer.points = points;`), { points } = running.pointer, turns = new Set();
    for (let i = 0; i < 200; ++i) {
        running.run(1);
        for (const { x, y } of Object.values(points)) assert.ok(x > 14 && x < 626 && y > 14 && y < 386, `${x} ${y}`);
        turns.add(Math.sign(points.head.y - points.leftHip.y));
    }
    assert.ok(turns.size >= 2, "upside down and back");
});

claim("ragdoll", ["Between two points a stick can still dip into a corner; an engine with shapes, as Sinew has for contact, tests the whole stick"], () => {
    const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] }, colliders: [{ shape: "box", name: "post", at: [0, -1], size: [0.1, 1] }], figures: [{ name: "it", particles: { a: { at: [-1, 0], radius: 0.02 }, b: { at: [1, 0.05], radius: 0.02 } }, constraints: [{ between: ["a", "b"] }] }] });
    let lowest = 1;
    for (let i = 0; i < 60; ++i) {
        simulation.step();
        const [ax, ay, bx, by] = simulation.positions;
        if (ax < 0 && bx > 0) lowest = Math.min(lowest, ay + ((by - ay) * -ax) / (bx - ax));
    }
    above(lowest, -0.5, "the whole stick stays above the post");
    const own = program("stick", "length", 130, { replaced: [["walls(a);", "post(a);"], ["walls(b);", "post(b);"], ["{x: 170, y: 200 + length, oldX: 171, oldY: 206 + length}", "{x: 300, y: 200, oldX: 300, oldY: 200}"], ["oldX: 166, oldY: 210", "oldX: 170, oldY: 200"]],
        added: "function post(p) { if (p.x > 230 && p.x < 240 && p.y > 250) p.y = 250; }\nlessonPointer.height = () => (a.y + b.y) / 2;" });
    own.run(60);
    above(own.pointer.height(), 300, "points alone let it through");
});

const arm = () => program("bezier", "forearm", 150, { added: "Object.assign(lessonPointer, {curve, mix, ends: [shoulder, elbow, hand]});" }).pointer;

claim("bezier", ["The curve begins at the shoulder and ends at the hand", "It leaves towards the elbow, and arrives from it, but does not go through it", "The direction of the curve at t = 1 tells how the hand is turned", "Three points are an arm"], () => {
    const { curve, ends: [shoulder, elbow, hand] } = arm(), far = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);
    for (const [t, end] of [[0, shoulder], [1, hand]]) below(far(curve(t), end), 1e-9);
    const slope = (a, b) => Math.atan2(b.y - a.y, b.x - a.x);
    close(slope(shoulder, curve(1e-6)), slope(shoulder, elbow), 1e-4);
    close(slope(curve(1 - 1e-6), hand), slope(elbow, hand), 1e-4);
    above(Math.min(...Array.from({ length: 101 }, (_, i) => far(curve(i / 100), elbow))), 10, "pixels from the elbow");
});

claim("bezier", ["mix(a, b, t) is the point that lies a share t of the way from a to b", "Mixing three times gives a smooth curve", "The yellow points show how it is found", "Sixteen samples of t are enough to draw a sleeve"], () => {
    const { curve, mix, ends } = arm();
    assert.deepEqual({ ...mix({ x: 10, y: 20 }, { x: 20, y: 60 }, 0.25) }, { x: 12.5, y: 30 });
    const exact = (t, name) => (1 - t) ** 2 * ends[0][name] + 2 * t * (1 - t) * ends[1][name] + t ** 2 * ends[2][name];
    let worst = 0;
    for (let i = 0; i <= 160; ++i) {
        const t = i / 160, k = Math.min(Math.floor(i / 10), 15);
        for (const name of ["x", "y"]) {
            close(curve(t)[name], exact(t, name), 1e-12);
            worst = Math.max(worst, Math.abs(curve(t)[name] - mix(curve(k / 16), curve((k + 1) / 16), 16 * t - k)[name]));
        }
    }
    below(worst, 0.5, "pixels off");
    const { commands } = program("bezier", "forearm", 150).run(30), discs = commands.filter(([shape, , , , color]) => shape === "disc" && color === "#e9a820");
    assert.equal(discs.length, 3);
});

claim("bezier", ["The physics is the same; only the pen moves otherwise"], () => {
    const places = (replaced) => {
        const running = program("bezier", "forearm", 150, { replaced, added: "lessonPointer.places = () => [elbow.x, elbow.y, hand.x, hand.y];" });
        running.run(100);
        return [...running.pointer.places()];
    };
    assert.deepEqual(places([]), places([["path(sleeve, 44, \"#3f6fb5\");", ""]]));
});

claim("capstone", ["Its man has 13 points and 25 rules", "12 bones, 6 hidden sticks that hold trunk and head, and 7 distances of at least so much", "the same man, point for point and rule for rule"], () => {
    const { parts } = program("capstone", "stiffness", 12, { added: "lessonPointer.parts = [Object.keys(points).length, bones.length, hidden.length, limits.length, rules.length];" }).pointer;
    assert.deepEqual([...parts], [13, 12, 6, 7, 25]);
    const simulation = scene("capstone", 1, {}, 1);
    assert.deepEqual([simulation.particleCount, simulation.constraintCount], [13, 25]);
    const own = program("capstone", "stiffness", 12, { added: "lessonPointer.points = points; lessonPointer.rules = rules.map(({low, high}) => [low, high]);" }).pointer;
    Object.values(own.points).forEach(({ x, y }, i) => {
        close(simulation.positions[2 * i], x, 1e-9);
        close(simulation.positions[2 * i + 1], y, 1e-9);
    });
    const { particles, constraints } = sceneFile("capstone", 1, 1).figures[0];
    constraints.forEach(({ between: [a, b], low }, i) => close(low ?? Math.hypot(...[0, 1].map((k) => particles[b].at[k] - particles[a].at[k])), own.rules[i][0], 1e-9));
});

claim("capstone", ["which keep knees and elbows from folding flat"], () => {
    const nearest = (replaced) => {
        const running = program("capstone", "stiffness", 12, { replaced, added: "lessonPointer.points = points;" }), { points: p } = running.pointer;
        let least = Infinity;
        for (let i = 0; i < 400; ++i) {
            running.run(1);
            least = Math.min(least, Math.hypot(p.leftFoot.x - p.leftHip.x, p.leftFoot.y - p.leftHip.y), Math.hypot(p.rightHand.x - p.rightShoulder.x, p.rightHand.y - p.rightShoulder.y));
        }
        return least;
    };
    above(nearest([]), 30);
    below(nearest([[".concat(limits.map(", ".concat([].map("]]), 26);
});

claim("capstone", ["Points that fall (1), rules that are mended (2, 3), again and again (7), with limits (9): that is an engine, and the program below is all of it"], () => {
    assert.deepEqual([...lesson("capstone").figures[0].program.matchAll(/\b(disc|line|path|arrow|trail|square|write|graph|held|walls|show|say)\(/g)].map(([, word]) => word).filter((word, i, all) => all.indexOf(word) === i).sort(), ["disc", "held", "line", "show", "walls"], "of the page only the drawing, the hand and the walls");
});

claim("capstone", ["Then give him a third leg, a tail, or a hat: a line in the table of points, a line in the table of bones"], () => {
    const running = program("capstone", "stiffness", 12, { replaced: [["const points = {", "const points = {\n    tail: [30, 60],"], ["const bones = [", "const bones = [\n    \"leftHip tail\","]], added: "lessonPointer.points = points;" });
    running.run(300);
    const { points: p } = running.pointer, length = Math.hypot(45, 60);
    close(Math.hypot(p.tail.x - p.leftHip.x, p.tail.y - p.leftHip.y), length, 0.01);
});

claim("capstone", ["lift him by a foot: his bones keep their lengths to a millionth", "Your own engine knows no masses yet: give it some, as in lesson 7, and compare"], () => {
    const simulation = scene("capstone", 100, {}, 1);
    simulation.runUntil(4);
    assert.ok(simulation.grab("man/left_foot"));
    const { position: [, low] } = simulation.stateOf("man/left_foot");
    for (let i = 0; i < 400; ++i) {
        simulation.drag([320, Math.max(low - 2 * i, 40)]);
        simulation.step();
        below(simulation.report().stretchMax, 1e-6, `step ${i}`);
    }
    close(simulation.stateOf("man/left_foot").position[1], 40, 0.01, "lifted");
    above(simulation.stateOf("man/head").position[1], 200, "head down");
    const mass = "const m = (q) => (q === points.head ? 0.01 : 1), share = (now - wanted) / now / (m(a) + m(b)),";
    const own = program("capstone", "stiffness", 12, { replaced: [["const share = (now - wanted) / now / 2,", mass], ["a.x += x * share;  a.y += y * share;", "a.x += x * share * m(a);  a.y += y * share * m(a);"], ["b.x -= x * share;  b.y -= y * share;", "b.x -= x * share * m(b);  b.y -= y * share * m(b);"]], added: "lessonPointer.points = points;" });
    own.run(200);
    const { x, y } = own.pointer.points.leftFoot, stretches = [handAt(own, x, y).stretch];
    for (let i = 0; i < 300; ++i) stretches.push(handAt(own, 320, Math.max(y - 2 * i, 40)).stretch);
    above(Math.max(...stretches), 0.01);
});

claim("capstone", ["It knows masses, solves his bones exactly, keeps energy, knows the force in each bone, lets him sleep when he lies still, and does the same on every machine", "What you have learnt does not change"], () => {
    const file = sceneFile("capstone", 1, 1), thrown = engine.open({ ...file, world: { gravity: [0, 0] } });
    thrown.step();
    const { kinetic } = thrown.report();
    for (let i = 0; i < 600; ++i) {
        thrown.step();
        below(thrown.report().stretchMax, 1e-6);
    }
    close(thrown.report().kinetic, kinetic, 5e-3, "after ten seconds in empty space; his limits take a blow now and then");
    const lying = scene("capstone", 1, {}, 1);
    lying.runUntil(12);
    assert.equal(lying.asleepCount, 13);
    const hung = engine.open({ ...file, world: { gravity: [0, 900], damping: 2 }, pins: [{ particle: "man/left_foot" }] });
    hung.runUntil(30);
    close(hung.loadOf("man/left_knee_to_left_foot").tension, 12 * 900, 0.01, "what hangs below the foot");
    const again = scene("capstone", 1, {}, 1);
    again.runUntil(12);
    assert.equal(again.hash(), lying.hash());
});

claim("capstone", ["every scene there is text like this"], async () => {
    const scenes = await catalogue();
    above(scenes.length, 30);
    for (const { text } of scenes) assert.equal(JSON.parse(text).sinew, 1);
});
