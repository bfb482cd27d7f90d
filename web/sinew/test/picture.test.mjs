import assert from "node:assert/strict";
import { test } from "node:test";
import { Canvas2DPainter, catalogue, Shape } from "../index.js";
import { Geometry } from "../painters/geometry.js";
import { signedArea, triangulate } from "../painters/triangles.js";
import { engine, pendulum } from "./engine_for_tests.mjs";

/** A 2D context that counts calls. */
function countingContext() {
    const calls = {};
    return new Proxy({ calls }, {
        get: (target, name) => target[name] ?? ((...given) => { (calls[name] ??= []).push(given); }),
    });
}

test("a picture lists what is seen", () => {
    const simulation = engine.open(pendulum);
    const picture = simulation.draw(400, 400);
    const shapes = [...picture].map(({ shape }) => shape);
    assert.equal(picture.length, shapes.length);
    const rod = [...picture].filter(({ shape }) => shape === Shape.polyline).at(-1);
    assert.deepEqual([...rod.points].map(Math.round), [200, 200, 300, 200]);
    assert.equal(picture.points.buffer, engine.memory.buffer);
});

test("a copy outlives the next draw", () => {
    const simulation = engine.open(pendulum);
    const copy = simulation.draw().copy();
    const points = [...copy.points];
    simulation.step(60);
    simulation.draw();
    assert.deepEqual([...copy.points], points);
    assert.deepEqual([...structuredClone(copy).points], points);
});

test("overlays add to the picture", () => {
    const simulation = engine.open(pendulum);
    const plain = simulation.draw().length;
    assert.ok(simulation.draw(400, 400, ["names"]).texts.includes("pendulum"));
    assert.ok(simulation.draw(400, 400, ["names", "pins"]).length > plain);
    assert.throws(() => simulation.draw(400, 400, ["nmes"]), /nmes/);
    assert.throws(() => simulation.draw(0, 400));
});

test("the painter of 2D contexts paints every item of every scene", async () => {
    for (const scene of await catalogue()) {
        const simulation = engine.open(scene.text, scene);
        simulation.step(20);
        const picture = simulation.draw();
        const context = countingContext();
        const painter = new Canvas2DPainter(context);
        for (const name of Object.keys(scene.images)) painter.setImage(name, { width: 32, height: 32 });
        painter.paint(picture);
        const count = (...shapes) => [...picture].filter(({ shape, color }) => shapes.includes(shape) && color[3] > 0).length;
        assert.equal(context.calls.stroke?.length ?? 0, count(Shape.polyline, Shape.loop), scene.name);
        assert.equal(context.calls.fillText?.length ?? 0, count(Shape.text), scene.name);
        assert.equal(context.calls.fill?.length ?? 0, count(Shape.disc, Shape.polygon, Shape.pane), scene.name);
        const images = [...picture].filter(({ shape }) => shape === Shape.image).length;
        assert.ok((context.calls.drawImage?.length ?? 0) >= images, scene.name);
        assert.equal(context.calls.save.length, context.calls.restore.length, scene.name);
        simulation.dispose();
    }
});

test("triangles cover a polygon exactly", () => {
    const star = [];
    for (let i = 0; i < 10; ++i) star.push(Math.cos(i * Math.PI / 5) * (i % 2 ? 1 : 2), Math.sin(i * Math.PI / 5) * (i % 2 ? 1 : 2));
    for (const outline of [[0, 0, 4, 0, 4, 3], [0, 0, 4, 0, 4, 4, 2, 1, 0, 4], star]) {
        let area = 0;
        triangulate(outline, (a, b, c) => {
            area += Math.abs(signedArea([a, b, c].flatMap((i) => [outline[2 * i], outline[2 * i + 1]])));
        });
        assert.ok(Math.abs(area - Math.abs(signedArea(outline))) < 1e-12);
    }
});

test("geometry of a stroke stays within its width", () => {
    const geometry = new Geometry();
    geometry.addStroke(Float32Array.of(0, 0, 10, 0, 20, 1, 20, 30), false, 4, [0, 0, 0, 1]);
    assert.ok(geometry.indexCount > 0 && geometry.indexCount % 3 === 0);
    const vertices = new Float32Array(geometry.floats.buffer, 0, 7 * geometry.vertexCount);
    for (let i = 0; i < vertices.length; i += 7) {
        assert.ok(vertices[i] >= -3.01 && vertices[i] <= 25 && vertices[i + 1] >= -6 && vertices[i + 1] <= 33.01, `${vertices.slice(i, i + 2)}`);
    }
});
