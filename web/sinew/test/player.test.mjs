import assert from "node:assert/strict";
import { test } from "node:test";
import { catalogue, SceneErrors, Shape, SinewError } from "../index.js";
import { engine, pendulum } from "./engine_for_tests.mjs";

const ragdoll = (await catalogue()).find(({ name }) => name === "ragdoll");

function playing(scene = pendulum, options = {}) {
    const player = engine.play(scene, options);
    player.resize(400, 400);
    return player;
}

/** Pixel of a particle. */
function pixelOf(player, name) {
    return player.simulation.toPixel(player.simulation.stateOf(name).position, 400, 400);
}

test("real time takes the steps due", () => {
    const player = playing();
    player.advance(0.05);
    assert.ok(player.state().step >= 2);
    player.pause();
    const { step } = player.state();
    player.advance(0.05);
    assert.equal(player.state().step, step);
    player.step();
    assert.equal(player.state().step, step + 1);
});

test("a drag moves the world, and a throw is told", () => {
    const player = playing();
    player.pointerMove(...pixelOf(player, "pendulum/bob"));
    assert.equal(player.state().hovered, "pendulum/bob");
    player.pointerDown();
    assert.equal(player.state().isHolding, true);
    player.pointerMove(200, 100);
    for (let i = 0; i < 60; ++i) player.advance(1 / 60);
    const [x, y] = player.simulation.stateOf("pendulum/bob").position;
    assert.ok(Math.hypot(x, y - 1) < 0.05, `${x}, ${y}`);
    player.pointerUp();
    assert.deepEqual(player.events().map(({ what }) => what).filter((what) => what !== "scene"), ["grab", "let_go"]);
});

test("escape unchooses, and leaves the host alone", () => {
    const player = playing();
    const figures = () => player.simulation.figures().length;
    player.do("choose_all");
    player.key("escape");
    player.key("delete");
    assert.equal(figures(), 1);
    player.do("choose_all");
    player.key("delete");
    assert.equal(figures(), 0);
});

test("the tool cut parts, undo joins, redo parts again", () => {
    const player = playing();
    player.setTool("cut");
    player.pointerMove(250, 100);
    player.pointerDown();
    player.pointerMove(250, 300);
    player.pointerUp();
    assert.equal(player.simulation.constraintCount, 0);
    assert.equal(player.state().undo, "cut");
    player.undo();
    assert.equal(player.simulation.constraintCount, 1);
    player.redo();
    assert.equal(player.simulation.constraintCount, 0);
});

test("the timeline restores the bits of every step", () => {
    const player = playing(ragdoll.text, ragdoll);
    player.pause();
    const hashes = [player.hash()];
    for (let i = 0; i < 40; ++i) player.step(), hashes.push(player.hash());
    for (const step of [0, 40, 17, 16, 39]) {
        player.goTo(step);
        assert.equal(player.hash(), hashes[step]);
    }
    player.stepBack();
    assert.equal(player.hash(), hashes[38]);
    assert.equal(player.state().endStep, 40);
});

test("what is set acts at once, and can be undone", () => {
    const player = playing();
    player.set("world.gravity", [0, 0]);
    assert.deepEqual(player.parameters().find(({ path }) => path === "world.gravity").value, [0, 0]);
    assert.equal(player.state().isEdited, true);
    player.undo();
    assert.match(player.sceneText(), /-10/);
    assert.throws(() => player.set("world.gravty", 1), SinewError);
});

test("spawned figures are part of the scene", () => {
    const player = playing();
    player.setTool("spawn");
    player.setPrefab("box", { width: 0.5 });
    player.pointerMove(100, 100);
    player.pointerDown();
    player.pointerUp();
    assert.ok(player.simulation.figures().some(({ prefab }) => prefab === "box"));
    assert.match(player.sceneText(), /"box"/);
});

test("a tool that fails says so, and time goes on", () => {
    const player = playing();
    player.setTool("spawn");
    player.setPrefab("box", { width: -1 });
    player.pointerMove(100, 100);
    player.pointerDown();
    player.pointerUp();
    assert.match(player.state().message, /width/);
    const { step } = player.state();
    player.advance(0.05);
    assert.ok(player.state().step > step);
});

test("a joint is of the kind that was set", () => {
    const player = playing();
    player.setTool("join");
    assert.throws(() => player.setJoint("glue"), SinewError);
    player.setJoint("spring");
    player.pointerMove(...pixelOf(player, "pendulum/bob"));
    player.pointerDown();
    player.pointerMove(40, 40);
    player.pointerUp();
    assert.match(player.sceneText(), /"spring"/);
});

test("both modes run side by side, each as if alone", () => {
    const player = playing(ragdoll.text, ragdoll);
    player.do("split");
    assert.equal(player.state().panes, 2);
    for (let i = 0; i < 30; ++i) player.step();
    ["classic", "physical"].forEach((mode, pane) => {
        const alone = engine.open(ragdoll.text, { ...ragdoll, overrides: { mode } });
        alone.step(30);
        assert.equal(player.pane(pane).hash(), alone.hash());
    });
    assert.ok(player.draw().texts.includes("classic"));
    player.do("split");
    assert.throws(() => player.pane(1), SinewError);
});

test("both modes fill the picture, with readable names, and a hand takes what is seen", () => {
    const player = engine.play(pendulum), [width, height, density] = [781, 460, 2]; // an odd width, too
    player.resize(width, height, density);
    player.pause();
    player.do("split");
    const picture = player.draw(), items = [...picture];
    assert.deepEqual([picture.width, picture.height], [width, height]);
    for (const { width } of items.filter(({ shape }) => shape === Shape.text)) assert.ok(width >= 14 * density, `letters of ${width} pixels`);
    const [x, y] = player.pane(1).toPixel(player.pane(1).stateOf("pendulum/bob").position, 391, height), at = [390 + x, y];
    assert.ok(items.some(({ points }) => points.length === 2 && Math.hypot(points[0] - at[0], points[1] - at[1]) < 1), "is drawn there");
    player.pointerMove(...at);
    assert.equal(player.state().hovered, "pendulum/bob");
    player.dispose();
});

test("another scene keeps the settings; a broken one changes nothing", () => {
    const player = playing();
    player.setTool("cut");
    player.setTheme("dark");
    assert.throws(() => player.open('{"sinew": 1, "figures": 3}'), SceneErrors);
    assert.equal(player.simulation.figures()[0].name, "pendulum");
    player.open(ragdoll.text, ragdoll);
    assert.deepEqual([player.state().tool, player.state().theme], ["cut", "dark"]);
    assert.notEqual(player.simulation.figures()[0].name, "pendulum");
});

test("an edited scene goes on where it was", () => {
    const player = playing();
    player.pause();
    for (let i = 0; i < 20; ++i) player.step();
    const before = player.simulation.stateOf("pendulum/bob").position;
    player.become({ ...pendulum, world: { gravity: [0, 5] } });
    assert.deepEqual(player.simulation.stateOf("pendulum/bob").position, before);
    player.undo();
    assert.match(player.sceneText(), /-10/);
});

test("a player's simulation is for reading", () => {
    const player = playing();
    assert.equal(player.simulation.isReadOnly, true);
    assert.throws(() => player.simulation.step(), { status: 6 });
    const kept = player.simulation;
    player.dispose();
    assert.throws(() => kept.hash(), { status: 1 });
    assert.throws(() => player.advance(1), { status: 1 });
});

test("the wheel enlarges about the pointer, and all can be seen again", () => {
    const player = playing();
    const rodEnd = () => [...player.draw()].findLast(({ shape, points }) => shape === Shape.polyline && points.length === 4).points[2];
    player.pause();
    const before = rodEnd();
    player.pointerMove(200, 200);
    player.wheel(3);
    assert.ok(Math.abs((rodEnd() - 200) / (before - 200) - 1.15 ** 3) < 0.01);
    player.do("see_all");
    assert.ok(Math.abs(rodEnd() - before) < 0.01);
});

test("keys of the window act; those of files do nothing", () => {
    const player = playing();
    player.key("p");
    assert.equal(player.state().isPaused, true);
    player.key("x");
    assert.equal(player.state().tool, "cut");
    player.key("ctrl+s");
    assert.throws(() => player.do("save"), SinewError);
    assert.throws(() => player.setTool("knife"), SinewError);
});

test("fingers drag and pinch", () => {
    const player = playing();
    player.touch(1, "down", ...pixelOf(player, "pendulum/bob"));
    assert.equal(player.state().isHolding, true);
    player.touch(2, "down", 100, 100);
    assert.equal(player.state().isHolding, false);
    player.touch(2, "move", 50, 50);
    player.touch(2, "up", 50, 50);
    player.touch(1, "up", 300, 200);
});

test("a negative time counts as none: the first frame of a page may be asked for with a time before now", () => {
    const player = engine.play({ sinew: 1, world: { gravity: [0, -9.81] }, figures: [{ prefab: "rope", angle: 60 }] });
    const hash = player.hash();
    for (const seconds of [-1, -1e-9, -Infinity, 0]) player.advance(seconds);
    assert.equal(player.hash(), hash);
    player.advance(0.1);
    assert.notEqual(player.hash(), hash);
    player.dispose();
});

test("a split view has the images of both modes, also where they differ", async () => {
    const rope = (await catalogue()).find(({ name }) => name === "rope"); // its ball is an image in physical mode alone
    const player = engine.play(rope.text, rope);
    player.resize(400, 400);
    const [alone] = [player.draw().images];
    player.do("split");
    assert.deepEqual(player.draw().images, alone);
    assert.ok(alone.length > 0);
    player.dispose();
});
