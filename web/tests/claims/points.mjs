// Claims of the lessons on a point, a stick, and who takes the error.
import assert from "node:assert/strict";
import { above, below, claim, close, engine, handAt, lesson, program, programOf, series } from "./reader.mjs";

const fromAbove = [["y: 330", "y: 40"], ["oldY: 339", "oldY: 40"], ["oldX: 66", "oldX: 70"]]; // let go at rest
const mirror = /^ *ball\[old\] = .*\n/gm;

claim("point", ["where it is and where it was a moment ago", "The difference of the two is how fast it goes", "There is no velocity to store", "speed is only the difference", "go on as it went, and add what gravity does"], () => {
    const running = program("point", "gravity", 0, { added: "lessonPointer.ball = ball;" });
    assert.deepEqual(Object.keys(running.pointer.ball).sort(), ["oldX", "oldY", "x", "y"]);
    const { speed } = running.run(1).live, { x, y, oldX, oldY } = running.pointer.ball;
    close(speed, 60 * Math.hypot(x - oldX, y - oldY), 1e-12);
    close(speed, 60 * Math.hypot(4, -9), 1e-12, "it goes on as it went");
    const falling = program("point", "gravity", 600, { added: "lessonPointer.ball = ball;" });
    falling.run(1);
    close(falling.pointer.ball.y - y, 600 / 3600, 1e-9, "what gravity adds in a step");
});

claim("point", ["the whole program", "let go, and it is thrown", "you may move a point, for whatever reason, and the speed mends itself"], () => {
    const running = program("point", "gravity", 0);
    for (let i = 0; i < 10; ++i) handAt(running, 70 + 12 * i, 330 - 6 * i);
    const { speed } = handAt(running, 0, 0, false);
    close(speed, 60 * Math.hypot(12, 6), 1e-9);
});

claim("point", ["the ball stays there", "puts the place before on the far side, and the speed is turned around", "Its 0.85 is how much of the speed is left", "Walls show both sides of this"], () => {
    const without = program("point", "gravity", 700, { replaced: [[mirror, ""]] });
    below(Math.max(...series(without, "height", 400).slice(200)), 1, "without the mirror it stays on the floor");
    const height = series(program("point", "gravity", 700, { replaced: fromAbove }), "height", 130), floor = height.indexOf(Math.min(...height));
    close(Math.max(...height.slice(floor)), 0.85 ** 2 * (384 - 40), 0.05, "height of the bounce");
    const level = program("point", "gravity", 0, { replaced: [["oldX: 66, oldY: 339", "oldX: 66, oldY: 330"]], added: "lessonPointer.ball = ball;" });
    const speeds = Array.from({ length: 400 }, () => (level.run(1), level.pointer.ball.x - level.pointer.ball.oldX));
    const turn = speeds.findIndex((one) => one < 0);
    close(speeds[turn], -0.85 * speeds[0], 1e-9);
});

claim("point", ["First points move as if they were alone", "Then rules move them to where they are allowed to be"], () => {
    const { program: text } = lesson("point").figures[0];
    assert.ok(text.indexOf("ball.y += speedY") < text.indexOf('bounce("x"'));
    assert.ok(series(program("point", "gravity", 1800), "height", 600).every((height) => height >= -1e-9 && height <= 368));
});

claim("point", ["with ½ the ball falls half as far in the same time", "in a time t gravity moves you by ½·g·t²", "over many steps the two halves, one from each neighbour, make a whole", "That is from rest, in one step"], () => {
    const fallen = (to) => 344 - program("point", "gravity", 700, { replaced: [...fromAbove, ["gravity * dt * dt;", to]] }).run(40).live.height;
    const whole = fallen("gravity * dt * dt;");
    close(fallen("gravity * dt * dt / 2;"), whole / 2, 1e-9);
    close(whole, (700 * (40 / 60) ** 2) / 2, 0.03, "school's formula");
});

claim("point", ["the difference of places is a speed per step", "always stepped 60 times a second"], () => {
    const uneven = (dts) => {
        const running = program("point", "gravity", 0, { added: "lessonPointer.go = (dt) => { step(dt); return ball.x - ball.oldX; };" });
        return dts.map(running.pointer.go);
    };
    assert.deepEqual(uneven([1 / 60, 1 / 30]), uneven([1 / 60, 1 / 60]), "a step twice as long takes it no further");
    const asked = programOf("const seen = new Set();\nfunction step(dt) { seen.add(dt); }\nlessonPointer.seen = seen;");
    for (const steps of [1, 3, 0, 6]) asked.run(steps);
    assert.deepEqual([...asked.pointer.seen], [1 / 60]);
});

claim("stick", ["After each step the points have broken it a little", "half of the error each", "drawn 200 times as long as they are", "one rule holds them apart, and tumbling comes out of it", "no angle in it and no spin"], () => {
    const running = program("stick", "length", 130, { added: "lessonPointer.push = () => push; lessonPointer.all = {a, b};" });
    const { commands, live } = running.run(3), arrows = commands.filter(([shape]) => shape === "arrow");
    above(Math.abs(live.error), 1e-6, "broken");
    below(Math.abs(live.stretch), 1e-9, "mended");
    const { push, all: { a, b } } = running.pointer;
    close(Math.hypot(push().x, push().y), Math.abs(live.error) / 2, 1e-9, "half of the error");
    close(arrows[0][3], 200 * push().x, 1e-9);
    close(arrows[1][4], -200 * push().y, 1e-9);
    let least = 1, most = -1;
    for (let i = 0; i < 200; ++i) {
        const { commands } = running.run(1);
        assert.ok(commands.length >= 3);
        const across = (b.x - a.x) / 130;
        [least, most] = [Math.min(least, across), Math.max(most, across)];
    }
    above(most - least, 1.5, "it turns over");
});

claim("stick", ["Swing it fast and the arrows point inwards, along the stick"], () => {
    const running = program("stick", "length", 130, { replaced: [["700 * dt * dt", "0"], ["walls(a);", ""], ["walls(b);", ""], ["oldX: 166, oldY: 210", "oldX: 162, oldY: 200"], ["oldX: 171, oldY: 206 + length", "oldX: 178, oldY: 200 + length"]], added: "lessonPointer.parts = () => [a, b, push];" });
    for (let i = 0; i < 60; ++i) {
        running.run(1);
        const [a, b, push] = running.pointer.parts(), along = push.x * (b.x - a.x) + push.y * (b.y - a.y);
        close(along, Math.hypot(push.x, push.y) * 130, 1e-9, "towards the other end");
    }
});

claim("stick", ["how do the arrows grow"], () => {
    const pushOf = (speed) => {
        const running = program("stick", "length", 130, { replaced: [["700 * dt * dt", "0"], ["oldX: 166, oldY: 210", `oldX: ${170 - speed}, oldY: 200`], ["oldX: 171, oldY: 206 + length", `oldX: ${170 + speed}, oldY: 200 + length`]] });
        return running.run(1).live.error;
    };
    close(pushOf(4) / pushOf(2), 4, 0.01, "with the square of the speed");
});

claim("stick", ["a constraint between two particles, with its rest length"], () => {
    const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] }, figures: [{ name: "it", particles: { a: { at: [0, 0], pinned: true }, b: { at: [1.2, 1.6] } }, constraints: [{ between: ["a", "b"], rest: 2 }] }] });
    simulation.runUntil(1);
    const [ax, ay, bx, by] = simulation.positions;
    close(Math.hypot(bx - ax, by - ay), 2, 1e-9);
    below(by, -0.5, "it has fallen over");
});

claim("stick", ["hyp is its length by Pythagoras", "Math.atan2(dy, dx)", "The physics never asks"], () => {
    close(Math.hypot(3, 4), 5, 1e-15);
    close(Math.atan2(1, 1), Math.PI / 4, 1e-15);
    assert.doesNotMatch(lesson("stick").figures[0].program, /atan2|cos|sin/);
});

claim("stick", ["Divide: error / now / 2", "The line from a to b is as long as the stick", "you need the share of the line that this is"], () => {
    const mended = (share) => program("stick", "length", 130, { replaced: [["x * error / now / 2", `x * ${share}`], ["y * error / now / 2", `y * ${share}`]] });
    below(Math.abs(mended("(error / now / 2)").run(60).live.stretch), 1e-9);
    const wrong = mended("((error - length) / 2)").run(60).live.stretch;
    assert.ok(!(Math.abs(wrong) < 1), `it stretches without end: ${wrong}`);
});

claim("stick", ["two dots, 10 cm apart, that should be 8 cm apart", "The error is 2", "Move each dot 1 cm towards the other", "every line of the code"], () => {
    const running = program("stick", "length", 8, { added: "lessonPointer.mended = () => { [a.x, a.y, b.x, b.y] = [0, 0, 10, 0]; mend(); return [a.x, b.x]; };" });
    const [a, b] = running.pointer.mended();
    close(a, 1, 1e-12);
    close(b, 9, 1e-12);
});

claim("split", ["With 25 % the red one moves 67.5 px and the yellow one 202.5", "The ends are 400 px apart and should be 130", "270 px have to go", "0 leaves the first point alone, 1 makes it take everything", "The stick is too long at first and shrinks", "The red one above has moved 67.5 px, the yellow one 202.5"], () => {
    const { red, yellow, length } = program("split", "first", 0.25).run(600).live;
    close(program("split", "first", 0.25).run(0).live.length, 400, 1e-12);
    close(red, 67.5, 1e-6);
    close(yellow, 202.5, 1e-6);
    close(length, 130, 1e-6);
    for (const first of [0, 0.5, 1]) close(program("split", "first", first).run(600).live.red + 1, 270 * first + 1, 1e-6);
});

claim("split", ["Each point moves in proportion to its inverse mass, 1/m, so that the centre of gravity stays where it is", "A nailed point has inverse mass 0", "If the first point is heavy, or nailed to the wall, the other must take more", "it follows from the masses"], () => {
    const mended = (first, second) => {
        const running = program("iterations", "passes", 1, { added: `lessonPointer.mended = () => { const a = {x: 0, y: 0, mobility: ${first}}, b = {x: 16, y: 12, mobility: ${second}}; mend(a, b); return [a, b]; };` });
        return running.pointer.mended();
    };
    const [heavy, light] = mended(1 / 7, 1);
    close(7 * heavy.x + light.x, 16, 1e-12, "centre of gravity across");
    close(7 * heavy.y + light.y, 12, 1e-12, "and down");
    close(Math.hypot(light.x - heavy.x, light.y - heavy.y), 10, 1e-12);
    above(16 - light.x, 6 * heavy.x, "the light one takes more");
    const [nailed, free] = mended(0, 1);
    assert.deepEqual([nailed.x, nailed.y], [0, 0]);
    close(Math.hypot(free.x, free.y), 10, 1e-12);
});

claim("split", ["a hand that follows the mouse should not be pulled back by the arm"], () => {
    const running = program("split", "first", 0);
    for (let i = 0; i < 30; ++i) handAt(running, 120 + 3 * i, 200);
    const { red } = running.run(60).live;
    close(red, 87, 1e-9, "the held point stays at the hand");
});

