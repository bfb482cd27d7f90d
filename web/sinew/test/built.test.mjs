// Figures and colliders that come and go while a scene runs, and what a renderer reads of them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { SceneErrors, SinewError } from "../index.js";
import { engine } from "./engine_for_tests.mjs";

const room = { sinew: 1, world: { gravity: [0, -10] } };
const space = { sinew: 1, dimension: 3, world: { gravity: [0, -10, 0] } };

test("figures come and go, with parameters as in a scene file", () => {
    const simulation = engine.open(room);
    const rope = simulation.addFigure("rope", { position: [3, 1], length: 2, segments: 8, contact: { figures: true } });
    assert.equal(simulation.figures()[rope].particles, 9);
    const again = simulation.addFigure("rope", { name: "second", segments: 4 });
    assert.deepEqual([simulation.figure("second"), simulation.rowsOf("second").length, simulation.rowsOf(rope).length], [again, 5, 9]);
    for (const row of simulation.rowsOf("second")) assert.match(simulation.nameOf(simulation.particle(row)), /^second\//);
    simulation.runUntil(2);
    assert.throws(() => simulation.addFigure("rope", { name: "second" }), SinewError);
    assert.throws(() => simulation.addFigure("rope", { segmnts: 8 }), (error) => error instanceof SceneErrors && /segmnts/.test(error.message));
    assert.throws(() => simulation.addFigure("roop"), SceneErrors);
    assert.throws(() => simulation.addFigure("rope", { position: [NaN, 0] }), SinewError);
    simulation.removeFigure("second");
    assert.throws(() => simulation.removeFigure(again), SinewError);
    assert.equal(simulation.particleCount, 9);
    simulation.dispose();
});

test("a ball lies on a collider that was added, and falls when it is gone", () => {
    const simulation = engine.open(room);
    const ball = simulation.addParticle({ position: [0, 1], radius: 0.1 });
    const floor = simulation.addCollider({ shape: "box", name: "floor", position: [0, -0.5], half: [5, 0.5], friction: 0.5 });
    simulation.runUntil(3);
    assert.ok(Math.abs(simulation.stateOf(ball).position[1] - 0.1) < 1e-3);
    assert.equal(simulation.collider("floor"), floor);
    simulation.removeCollider("floor");
    simulation.runUntil(4);
    assert.ok(simulation.stateOf(ball).position[1] < -4);
    assert.throws(() => simulation.removeCollider(floor), SinewError);
    assert.throws(() => simulation.addCollider({ shape: "sphere" }), SinewError); // without a radius
    assert.throws(() => simulation.addCollider({ shape: "egg" }), RangeError);
    assert.throws(() => simulation.addCollider({ shape: "polygon", points: [[0, 0], [0, 1], [1, 0]] }), SinewError); // clockwise
    simulation.addCollider({ shape: "polygon", points: [[0, 0], [1, 0], [0, 1]] });
    simulation.addCollider({ shape: "terrain", points: [[-9, -20], [9, -21]], bounce: 0.3, oneWay: [0, 1], layers: 2, mask: 1 });
    simulation.dispose();
});

test("triangles of a cloth cover its area, and go with it", () => {
    const simulation = engine.open(space);
    simulation.addFigure("cloth", { columns: 9, rows: 5, spacing: 0.25, drawn: "fill" });
    const { triangles } = simulation, { positions } = simulation;
    const at = (row) => [0, 1, 2].map((i) => positions[3 * row + i]);
    let area = 0;
    for (let i = 0; i < triangles.length; i += 3) {
        const [a, b, c] = [0, 1, 2].map((corner) => at(triangles[i + corner]));
        const [u, v] = [b, c].map((corner) => corner.map((x, k) => x - a[k]));
        area += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    }
    assert.ok(Math.abs(area - 2) < 1e-9, `${area}`);
    simulation.removeFigure("cloth");
    assert.equal(simulation.triangles.length, 0);
    simulation.dispose();
});

test("tensions of a hanging chain are the weights below", () => {
    const simulation = engine.open({ ...room, figures: [{ name: "line", particles: { top: { at: [0, 0], pinned: true }, middle: { at: [0, -1], mass: 2 }, low: { at: [0, -2], mass: 3 } },
        constraints: [{ between: ["top", "middle"] }, { between: ["middle", "low"] }] }] });
    simulation.runUntil(1);
    const [upper, lower] = simulation.tensions;
    assert.ok(Math.abs(upper - 50) < 1e-3 && Math.abs(lower - 30) < 1e-3, `${upper} ${lower}`);
    assert.ok(simulation.strains.every((strain) => Math.abs(strain) < 1e-9));
    simulation.dispose();
});
