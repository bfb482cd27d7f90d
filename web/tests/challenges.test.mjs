// The challenges of the lessons: each has a solution that a reader can find, and is not solved from the start.
import assert from "node:assert/strict";
import { test } from "node:test";
import { above, atRest, engine, everyFigure, handAt, isProgram, lesson, ownText, program, programOf, scene, sceneFile, texts } from "./claims/reader.mjs";

const challengeOf = (id) => lesson(id).figures.find(({ challenge }) => challenge);
/** True if a challenge is fulfilled at the end of a run, of its rest. */
const holds = (id, live, value) => challengeOf(id).challenge(live, value);

const solutions = {
    point() {
        const running = program("point", "gravity", 700);
        let height = 330;
        for (let i = 0; i < 12; ++i) handAt(running, 70, (height -= 8.2)); // thrown upwards
        return Array.from({ length: 60 }, () => handAt(running, 0, 0, false)).some((live) => holds("point", live, 700));
    },
    stick() { // one number: a hundredth in place of the half
        const running = program("stick", "length", 130, { replaced: [["/ now / 2", "/ now / 200"]] });
        handAt(running, 170, 200);
        return Array.from({ length: 40 }, (_, i) => handAt(running, 170 + 10 * Math.min(i, 30), 200)).some((live) => holds("stick", live));
    },
    split: () => holds("split", program("split", "first", 0.3704).run(600).live),
    integrators: () => Array.from({ length: challengeOf("integrators").repeats }, ((running) => () => running.run(60).live)(program("integrators", "rate", 10))).some((live) => holds("integrators", live, 10)),
    triangle() {
        const file = sceneFile("triangle", 6);
        file.constraints = [2, 3, 4].map((i) => ({ between: ["form/corner_0", `form/corner_${i}`] }));
        return holds("triangle", challengeOf("triangle").live(engine.open(file), 6));
    },
    iterations: () => holds("iterations", { stretch: atRest(program("iterations", "passes", challengeOf("iterations").slider.high)) }),
    substeps: () => holds("substeps", { right: atRest(program("substeps", "effort", challengeOf("substeps").slider.high), "right") }),
    tearing() {
        const simulation = scene("tearing", 0.5);
        for (let pull = 0; pull < 12; ++pull) { // points are torn out, one after the other
            const x = 140 + 30 * pull, { particle } = simulation.nearestParticle([x, 250], 600), { position } = simulation.stateOf(particle);
            assert.ok(simulation.grab(particle));
            for (let i = 0; i < 40; ++i) {
                simulation.drag([position[0], position[1] + 10 * i]);
                simulation.step();
            }
            simulation.letGo();
        }
        return holds("tearing", challengeOf("tearing").live(simulation), 0.5);
    },
    ragdoll() {
        const simulation = scene("ragdoll", challengeOf("ragdoll").slider.high);
        simulation.runUntil(6);
        return holds("ragdoll", challengeOf("ragdoll").live(simulation));
    },
    bezier() { // the hand is led to the shoulder
        const running = program("bezier", "forearm", 150, { added: "lessonPointer.hand = hand;" }), { hand } = running.pointer;
        handAt(running, hand.x, hand.y);
        return Array.from({ length: 60 }, (_, i) => handAt(running, hand.x + (250 - hand.x) * i / 40, hand.y + (70 - hand.y) * i / 40)).some((live) => holds("bezier", live));
    },
    compliance: () => holds("compliance", program("compliance", "compliance", 0.102).run(60 * 30).live, 0.102),
    swing() {
        const simulation = scene("swing", 0.07);
        simulation.runUntil(10.1);
        return holds("swing", challengeOf("swing").live(simulation), 0.07);
    },
    capstone: () => holds("capstone", program("capstone", "stiffness", 12, { replaced: [["const points = {", "const points = {\n    tail: [30, 60],"], ["const bones = [", "const bones = [\n    \"leftHip tail\","]] }).run(600).live),
};

test("every challenge that a text sets is checked, and has a solution", () => {
    const challenged = everyFigure().filter(({ figure }) => figure.challenge).map(({ id }) => id);
    for (const [name, text] of Object.entries(texts)) for (const { id, i, figure } of everyFigure()) assert.equal(text.lessons[id].figures[i].challenge !== undefined, figure.challenge !== undefined, `${name} ${id}`);
    assert.deepEqual(Object.keys(solutions).sort(), [...challenged].sort());
    above(challenged.length, 12);
});

for (const [id, solve] of Object.entries(solutions)) test(`${id}: can be solved`, () => assert.ok(solve()));

test("no challenge is solved by waiting", () => {
    for (const { id, i, figure } of everyFigure()) {
        if (!figure.challenge) continue;
        const running = isProgram(figure) ? programOf(ownText(figure, id, i, "en")) : scene(id, figure.slider.value, {}, i);
        for (let second = 0; second < 12; ++second) {
            let live;
            if (isProgram(figure)) ({ live } = running.run(60));
            else {
                running.step(60);
                live = figure.live(running, figure.slider.value);
            }
            assert.ok(second === 0 && figure.rests || !figure.challenge(live, figure.slider.value), `${id} after ${second + 1} s`);
        }
    }
});
