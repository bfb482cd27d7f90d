import assert from "node:assert/strict";
import { test } from "node:test";
import { SinewError, status } from "../index.js";
import { engine, pendulum } from "./engine_for_tests.mjs";

const hasStatus = (wanted) => (error) => error instanceof SinewError && error.status === wanted;

test("a pendulum falls by its law", () => {
    const simulation = engine.open(pendulum, { overrides: ["precision=double", "solver.substeps=32"] });
    const bob = simulation.particle("pendulum/bob");
    const start = simulation.report();
    simulation.runUntil(0.3);
    const { position, velocity } = simulation.stateOf(bob);
    // energy: v^2 = 2 g h
    const speed = Math.hypot(...velocity);
    assert.ok(Math.abs(speed ** 2 + 20 * position[1]) < 0.02, `${speed} at ${position}`);
    assert.ok(Math.abs(Math.hypot(...position) - 1) < 1e-9);
    const { kinetic, potential, seconds } = simulation.report();
    assert.ok(Math.abs(seconds - 0.3) < 0.01);
    assert.ok(Math.abs(kinetic + potential - start.kinetic - start.potential) < 0.01);
    simulation.dispose();
});

test("columns are views of the state", () => {
    const simulation = engine.open(pendulum, { overrides: ["precision=double"] });
    assert.deepEqual([...simulation.positions], [0, 0, 1, 0]);
    assert.deepEqual([...simulation.inverseMasses], [1, 1]);
    assert.deepEqual([...simulation.mobilities], [0, 1]);
    assert.deepEqual([...simulation.ends], [0, 1]);
    assert.deepEqual([...simulation.figureIndices], [0, 0]);
    assert.equal(simulation.positions.buffer, engine.memory.buffer);
    simulation.step(10);
    assert.deepEqual([...simulation.positions.slice(2)], simulation.stateOf("pendulum/bob").position);
    assert.ok(engine.open(pendulum, { overrides: ["precision=float"] }).positions instanceof Float32Array);
});

test("views are made anew when the memory grows", () => {
    const simulation = engine.open(pendulum);
    const before = simulation.positions;
    const bytes = engine.bytes;
    const large = [];
    while (engine.bytes === bytes) large.push(engine.open({ sinew: 1, dimension: 3, figures: [{ prefab: "cloth", columns: 100, rows: 100 }] }));
    assert.equal(before.length, 0); // detached
    assert.deepEqual([...simulation.positions], [0, 0, 1, 0]);
    for (const one of large) one.dispose();
});

test("disposing frees the memory", () => {
    const cloth = { sinew: 1, dimension: 3, figures: [{ prefab: "cloth", columns: 60, rows: 60 }] };
    const once = () => {
        const simulation = engine.open(cloth);
        simulation.step(3);
        simulation.draw();
        simulation.dispose();
    };
    once(), once();
    const bytes = engine.bytes;
    for (let i = 0; i < 20; ++i) once();
    assert.equal(engine.bytes, bytes);
});

test("closed and made-up handles and ids give errors", () => {
    const simulation = engine.open(pendulum);
    const bob = simulation.particle("pendulum/bob");
    assert.throws(() => simulation.stateOf(bob + 1n), hasStatus(status.badId));
    assert.throws(() => simulation.particle("pendulum/bobb"), hasStatus(status.notFound));
    simulation.removeParticle(bob);
    assert.throws(() => simulation.stateOf(bob), hasStatus(status.badId));
    simulation.dispose();
    simulation.dispose();
    assert.throws(() => simulation.step(), hasStatus(status.badHandle));
    assert.throws(() => engine.call("sinew_step", 0xdeadbeef, 1), hasStatus(status.badHandle));
});

test("edits act", () => {
    const simulation = engine.open(pendulum, { overrides: ["precision=double"] });
    const weight = simulation.addParticle({ position: [1, -1], mass: 10 });
    const rope = simulation.addConstraint("distance", ["pendulum/bob", weight], { high: 1 });
    assert.throws(() => simulation.addConstraint("distance", [weight, weight]), hasStatus(status.badId));
    assert.throws(() => simulation.addConstraint("distance", [weight]), hasStatus(status.badArgument));
    simulation.runUntil(0.5);
    assert.ok(simulation.loadOf(rope).tension > 0);
    assert.ok(simulation.loadOf(rope).measure < 1.001);
    simulation.removeConstraint(rope);
    assert.equal(simulation.constraintCount, 1);
    const pin = simulation.pin(weight);
    const [x, y] = simulation.stateOf(weight).position;
    simulation.movePin(pin, [x + 0.1, y]);
    simulation.step();
    assert.ok(Math.abs(simulation.stateOf(weight).position[0] - x - 0.1) < 1e-9);
    simulation.unpin(pin);
    simulation.setPosition(weight, [5, 5]);
    simulation.setVelocity(weight, [0, 0]);
    simulation.applyImpulse(weight, [20, 0]);
    assert.deepEqual(simulation.stateOf(weight), { position: [5, 5], velocity: [2, 0], inverseMass: 0.1, radius: 0, figure: 0xffffffff });
});

test("a hand takes hold, carries and lets go", () => {
    const simulation = engine.open(pendulum, { overrides: ["precision=double"] });
    assert.equal(simulation.grab([3, 3], 0.1), false);
    assert.equal(simulation.grab([1.02, 0.01], 0.1), true);
    simulation.drag([0, 1]);
    simulation.runUntil(1);
    const [x, y] = simulation.stateOf("pendulum/bob").position;
    assert.ok(Math.hypot(x, y - 1) < 0.05, `${x}, ${y}`);
    simulation.letGo();
    simulation.runUntil(3);
    assert.ok(simulation.stateOf("pendulum/bob").position[1] < 0.999);
});

test("a cut parts and is told", () => {
    const simulation = engine.open(pendulum);
    assert.equal(simulation.cut([0.5, -1], [0.5, 1]), 1);
    assert.equal(simulation.constraintCount, 0);
    assert.ok(simulation.events().some(({ what, where }) => what === "cut" && where === "pendulum"));
    assert.match(simulation.sceneText(), /snip/);
});

test("a copy goes on to the same state, an edited one to another", () => {
    const first = engine.open(pendulum);
    first.step(50);
    const second = first.copy(), third = first.copy();
    third.applyImpulse("pendulum/bob", [0.1, 0]);
    for (const one of [first, second, third]) one.step(50);
    assert.equal(first.hash(), second.hash());
    assert.notEqual(first.hash(), third.hash());
    first.restart();
    assert.equal(first.hash(), engine.open(pendulum).hash());
});

test("parameters have values, ranges and units, and can be set while it runs", () => {
    const simulation = engine.open(pendulum);
    const gravity = simulation.parameters().find(({ path }) => path === "world.gravity");
    assert.deepEqual([gravity.value, gravity.type, gravity.unit], [[0, -10], "point", "m/s^2"]);
    const precision = simulation.parameters().find(({ path }) => path === "solver.precision");
    assert.deepEqual(precision.choices, ["float", "double"]);
    const damping = simulation.parameters().find(({ path }) => path === "world.damping");
    assert.deepEqual([damping.type, damping.low], ["number", 0]);
    simulation.step(30);
    const before = simulation.stateOf("pendulum/bob").position;
    simulation.set("world.gravity", [0, 0]);
    assert.deepEqual(simulation.stateOf("pendulum/bob").position, before);
    assert.deepEqual(simulation.parameters().find(({ path }) => path === "world.gravity")?.value, [0, 0]);
    assert.throws(() => simulation.set("world.gravty", 3), { name: "SceneErrors" });
});

test("pixels and places are each other's inverse", () => {
    const simulation = engine.open(pendulum);
    assert.deepEqual(simulation.size, [400, 400]);
    const [x, y] = simulation.toPixel([1, 0.5]);
    assert.ok(Math.hypot(x - 300, y - 150) < 1e-3, `${x}, ${y}`);
    const [u, v] = simulation.toScene([x, y]);
    assert.ok(Math.hypot(u - 1, v - 0.5) < 1e-6);
});
