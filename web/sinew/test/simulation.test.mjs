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
    assert.throws(() => engine.call("sinew_world_step", 0xdeadbeef, 1), hasStatus(status.badHandle));
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
    assert.deepEqual(simulation.stateOf(weight), { position: [5, 5], velocity: [2, 0], inverseMass: 0.1, radius: 0, figure: 0xffffffff, isAsleep: false });
});

test("a hand takes hold, carries and lets go", () => {
    const simulation = engine.open(pendulum, { overrides: ["precision=double"] });
    assert.equal(simulation.grab([3, 3], 0.1), false);
    assert.equal(simulation.grab([1.02, 0.01], 0.1), true);
    simulation.drag([0.6, 0.8]);
    simulation.runUntil(1);
    const [x, y] = simulation.stateOf("pendulum/bob").position;
    assert.ok(Math.hypot(x - 0.6, y - 0.8) < 0.05, `${x}, ${y}`);
    simulation.letGo();
    simulation.runUntil(1.7);
    assert.ok(simulation.stateOf("pendulum/bob").position[1] < 0);
});

test("several grabs hold at once, of what is picked", () => {
    const simulation = engine.open({ sinew: 1, dimension: 3, figures: ["a", "b"].map((name, i) => ({ name, particles: { p: { at: [i, 0, 2] } } })) });
    const { particle, share } = simulation.pick([1, 0, 0], [1, 0, 10], 0.1);
    assert.deepEqual([particle, share], [simulation.particle("b/p"), 0.2]);
    assert.equal(simulation.pick([1, 0, 0], [1, 0, 1], 0.1), null);
    const grabs = [simulation.addGrab("a/p"), simulation.addGrab(particle)];
    for (let step = 1; step <= 60; ++step) {
        grabs.forEach((grab, i) => simulation.moveGrab(grab, [i, step / 60, 2]));
        simulation.step();
    }
    assert.ok(["a/p", "b/p"].every((name) => Math.abs(simulation.stateOf(name).position[1] - 1) < 0.01));
    grabs.forEach((grab) => simulation.removeGrab(grab));
    assert.throws(() => simulation.moveGrab(grabs[0], [0, 0, 0]));
});

test("forces come, change and go", () => {
    const simulation = engine.open(pendulum), [gravity] = simulation.forces();
    assert.equal(simulation.force(gravity).kind, "gravity");
    const wind = simulation.addForce({ kind: "wind", velocity: [3, 0], strength: 0.1, gust: [1, 0], seed: 5 });
    simulation.setForce(wind, { strength: 0.5 });
    const { kind, velocity, strength, seed } = simulation.force(wind);
    assert.deepEqual([kind, velocity, strength, seed], ["wind", [3, 0, 0], 0.5, 5n]);
    assert.deepEqual(simulation.forces(), [gravity, wind]);
    assert.throws(() => simulation.setForce(wind, { strength: -1 }), /strength is from 0/);
    simulation.removeForce(wind);
    assert.throws(() => simulation.force(wind));
});

test("a cut parts and is told", () => {
    const simulation = engine.open(pendulum);
    assert.equal(simulation.cut([0.5, -1], [0.5, 1]), 1);
    assert.equal(simulation.constraintCount, 0);
    assert.ok(simulation.events().some(({ what, where }) => what === "cut" && where === "pendulum"));
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
    const substeps = simulation.parameters().find(({ path }) => path === "solver.substeps");
    assert.deepEqual([substeps.type, substeps.low, substeps.high], ["integer", 0, 1000]);
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

/** A ball falls on a target that is held in place, and beside a floor. */
const falling = {
    sinew: 1, world: { gravity: [0, -10] }, colliders: [{ name: "floor", shape: "half_space" }],
    figures: [
        { name: "ball", contact: { figures: true }, particles: { p: { at: [0, 1.1], radius: 0.1 } } },
        { name: "target", contact: { figures: true }, particles: { p: { at: [0, 0.3], radius: 0.2, pinned: true } } },
        { name: "pebble", particles: { p: { at: [1, 0.3], radius: 0.1 } } },
    ],
};

test("contacts begin, persist and end", () => {
    const simulation = engine.open(falling);
    const [ball, target, pebble] = ["ball/p", "target/p", "pebble/p"].map((name) => simulation.particle(name));
    const ofBall = () => simulation.contacts().filter(({ particle, other }) => particle === ball || other === ball);
    simulation.listContacts();
    assert.deepEqual(simulation.contacts(), []);
    while (ofBall().length === 0 && simulation.report().seconds < 1) simulation.step();
    const [begun] = ofBall();
    assert.equal(begun.phase, "begin");
    assert.deepEqual([begun.figure, begun.otherFigure, begun.other, begun.collider], [0, 1, target, null]);
    assert.ok(begun.blow === begun.impulse && begun.blow > 1 && begun.blowBefore === 0);
    const [onFloor] = simulation.contacts().filter(({ particle }) => particle === pebble);
    assert.deepEqual([onFloor.colliderName, onFloor.phase, onFloor.other], ["floor", "persist", null]);
    assert.equal(onFloor.collider, simulation.collider("floor"));
    simulation.step();
    assert.ok(Math.abs(ofBall()[0].blow - Math.sqrt(2 * 10 * 0.5)) < 0.35, `${ofBall()[0].blow}`); // m v, and weight
    simulation.step(10);
    assert.equal(ofBall()[0].phase, "persist");
    simulation.applyImpulse(ball, [0, 4]);
    let ends = 0;
    for (let i = 0; i < 5; ++i) {
        simulation.step();
        ends += ofBall().filter(({ phase }) => phase === "end").length;
    }
    assert.equal(ends, 1);
    simulation.dispose();
});

test("events of a scene happen on contact", () => {
    const simulation = engine.open({ ...falling, events: [{ on: { contact: "hit", of: "ball", with: "target", above: 2 }, note: "thud" }] });
    simulation.runUntil(1);
    const [hit, note] = simulation.events();
    assert.deepEqual([hit.what, hit.where, hit.with, note.what, note.where], ["hit", "ball", "target", "note", "thud"]);
    assert.ok(Math.abs(hit.impulse - Math.sqrt(10)) < 0.35);
    simulation.dispose();
});

test("queries answer in the plane and in space", () => {
    const flat = engine.open(falling);
    const [ball, target] = [flat.particle("ball/p"), flat.particle("target/p")];
    const near = flat.nearestParticle([0.3, 1.1], 1);
    assert.equal(near.particle, ball);
    assert.ok(Math.abs(near.distance - 0.2) < 1e-12);
    assert.equal(flat.nearestParticle([9, 9], 1), null);
    assert.equal(flat.nearestLink([0, 0], 9), null);
    const hit = flat.castRay([0, 3], [0, -1]);
    assert.deepEqual([hit.particle, hit.collider, hit.normal], [ball, null, [0, 1]]);
    assert.ok(Math.abs(hit.share - 1.8 / 4) < 1e-9);
    assert.equal(flat.castRay([5, 3], [5, -1], { radius: 0.5 }).collider, flat.collider("floor"));
    assert.equal(flat.castRay([5, 3], [9, 3]), null);
    assert.deepEqual(flat.particlesIn({ center: [0, 0.7], half: [0.1, 0.5] }), [ball, target]);
    assert.deepEqual(flat.particlesIn({ center: [0, 0.7], half: [0.1, 0.5], turn: Math.PI / 2 }), []);
    assert.throws(() => flat.particlesIn({ center: [NaN, 0], radius: 1 }), hasStatus(status.badArgument));

    const space = engine.open({ sinew: 1, dimension: 3, figures: [{ name: "rod", particles: { a: { at: [0, 0, 0] }, b: { at: [0, 0, 2] } },
        constraints: [{ name: "link", between: ["a", "b"] }] }] });
    const link = space.constraint("rod/link");
    const nearest = space.nearestLink([0.5, 0, 0.5], 1);
    assert.equal(nearest.link, link);
    assert.ok(Math.abs(nearest.t - 0.25) < 1e-12 && Math.abs(nearest.distance - 0.5) < 1e-12);
    assert.deepEqual(space.linksIn({ center: [0.3, 0, 1], radius: 0.4 }), [link]);
    assert.deepEqual(space.linksIn({ center: [0.5, 0, 1], half: [0.1, 0.6, 0.1] }), []);
    assert.deepEqual(space.linksIn({ center: [0.5, 0, 1], half: [0.1, 0.6, 0.1], turn: Math.PI / 2, axis: [0, 0, 1] }), [link]);
    assert.deepEqual(space.particlesIn({ center: [0, 0, 0], radius: 3 }).length, 2);
    for (const simulation of [flat, space]) simulation.dispose();
});

test("what rests falls asleep, and a collider that moves wakes and carries it", () => {
    const simulation = engine.open({ ...falling, solver: { sleep: { speed: 0.05 } } });
    assert.equal(simulation.asleepCount, 0);
    simulation.runUntil(3);
    assert.ok(simulation.stateOf("pebble/p").isAsleep);
    assert.equal(simulation.sleepers.reduce((sum, flag) => sum + flag), simulation.asleepCount);
    for (let i = 1; i <= 30; ++i) {
        simulation.moveCollider("floor", [0, i / 60]);
        simulation.step();
    }
    assert.ok(!simulation.stateOf("pebble/p").isAsleep);
    assert.ok(Math.abs(simulation.stateOf("pebble/p").position[1] - 0.6) < 1e-3);
    simulation.dispose();
});

test("controls that are held are saved", () => {
    const scene = {
        sinew: 1, world: { gravity: [0, -10] }, colliders: [{ shape: "box", size: [90, 1], at: [0, -0.5] }],
        figures: [{ prefab: "character", name: "hero" }, { prefab: "car", name: "racer", at: [9, 0] }],
    };
    const simulation = engine.open(scene);
    for (const figure of ["hero", "racer"]) {
        simulation.steer(figure, { along: 1, hold: true });
        simulation.step(10);
        const restored = engine.load(simulation.save());
        for (const one of [simulation, restored]) one.step(20);
        assert.equal(restored.hash(), simulation.hash());
        restored.steer(figure);
        for (const one of [simulation, restored]) one.step(20);
        assert.notEqual(restored.hash(), simulation.hash());
        restored.dispose();
    }
    simulation.dispose();
});

test("a saved simulation goes on as if it had never stopped", () => {
    for (const precision of ["double", "float"]) {
        const simulation = engine.open(pendulum, { overrides: [`precision=${precision}`] });
        const bob = simulation.particle("pendulum/bob");
        simulation.step(10);
        const bytes = simulation.save();
        const restored = engine.load(bytes);
        assert.equal(restored.hash(), simulation.hash());
        for (const one of [simulation, restored]) one.step(20);
        assert.equal(restored.hash(), simulation.hash());
        assert.deepEqual(restored.stateOf(bob), simulation.stateOf(bob), "ids hold");
        const damaged = bytes.slice();
        damaged[damaged.length - 1] ^= 1;
        assert.throws(() => engine.load(damaged), hasStatus(status.badArgument));
        assert.throws(() => engine.load(bytes.slice(0, -1)), /ends within/);
    }
});
