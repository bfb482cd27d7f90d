import assert from "node:assert/strict";
import { test } from "node:test";
import { Canvas2DPainter, catalogue, Shape } from "../index.js";
import { Geometry } from "../painters/geometry.js";
import { TileRaster } from "../painters/tile_raster.js";
import { signedArea, triangulate } from "../painters/triangles.js";
import { itemWords } from "../picture.js";
import { engine, pendulum } from "./engine_for_tests.mjs";

/** A 2D context that counts calls. */
function countingContext() {
    const calls = {};
    return new Proxy({ calls }, {
        get: (target, name) => target[name] ?? ((...given) => { (calls[name] ??= []).push(given); }),
    });
}

// Node has no canvas: tinted images go nowhere.
globalThis.OffscreenCanvas ??= class {
    constructor(width, height) { Object.assign(this, { width, height }); }
    getContext() { return countingContext(); }
};

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

/** A picture of polygons, as the painters read it. */
function pictureOf(outlines, color) {
    const points = Float32Array.from(outlines.flat()), words = new Uint32Array(itemWords * outlines.length);
    const floats = new Float32Array(words.buffer);
    let first = 0;
    outlines.forEach((outline, i) => {
        words.set([Shape.polygon, first, outline.length / 2], i * itemWords);
        floats.set(color, i * itemWords + 4);
        first += outline.length / 2;
    });
    return { points, words, floats };
}

/** Pixels of 40 x 40 after polygons of one colour, filled one after another. */
function filled(outlines, color = [0.2, 0.4, 0.6, 1]) {
    const raster = new TileRaster(40, 40, new Int32Array(40 * 40)), picture = pictureOf(outlines, color);
    outlines.forEach((_, i) => raster.fillItem(picture, i));
    return raster.pixels;
}

const coverOf = (pixels) => pixels.reduce((sum, pixel) => sum + (pixel >>> 24) / 255, 0);

test("a filled tile covers as many pixels as its area, at any angle and place", () => {
    for (let i = 0; i < 60; ++i) {
        const [c, s] = [9 * Math.cos(i), 9 * Math.sin(i)], [x, y] = [20 + (i % 7) / 7, 20 + (i % 11) / 11];
        const square = [x + c, y + s, x - s, y + c, x - c, y - s, x + s, y - c];
        const triangle = square.slice(0, 6), backwards = [...square.slice(6), ...square.slice(4, 6), ...square.slice(2, 4), ...square.slice(0, 2)];
        for (const outline of [square, triangle, backwards]) { // a corner may lose half a pixel: what two sides cut off is added up
            const area = Math.abs(signedArea(outline)), cover = coverOf(filled([outline]));
            assert.ok(Math.abs(cover - area) < 1.5, `${outline}: ${cover}, not ${area}`);
        }
    }
});

test("tiles that overlap by a pixel leave no seam, and those beyond the picture change nothing", () => {
    const tiles = [];
    for (let i = 0; i < 4; ++i)
        for (let k = 0; k < 4; ++k) {
            const [left, top, right, bottom] = [5.3 + 6.7 * i - 0.5, 4.9 + 6.7 * k - 0.5, 5.3 + 6.7 * (i + 1) + 0.5, 4.9 + 6.7 * (k + 1) + 0.5];
            tiles.push([left, top, right, top, right, bottom, left, bottom]);
        }
    const pixels = filled(tiles);
    for (let y = 6; y < 30; ++y) for (let x = 6; x < 30; ++x) assert.equal(pixels[40 * y + x] >>> 0, 0xff996633);
    assert.ok(filled([[-30, 5, -20, 5, -20, 9, -30, 9], [50, 50, 60, 50, 60, 60]]).every((pixel) => pixel === 0));
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
