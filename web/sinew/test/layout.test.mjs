// The layout of the C face's structs is that of its header, and what is written is what is read.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { test } from "node:test";
import * as layout from "../layout.js";
import { Memory } from "../memory.js";
import { colliderSpec, figureSpec, forceSpec } from "../specs.js";

/** A memory without a module: what is freed is lost. */
function memory() {
    let free = 8;
    const exports = { sinew_allocate: (bytes) => ((free += 8 - (free % 8) + bytes), free - bytes), sinew_free() {} };
    return new Memory(exports, new WebAssembly.Memory({ initial: 2 }));
}

test("layout.js and layout.cpp are those of sinew.h", () => {
    execFileSync("node", [fileURLToPath(new URL("../tools/make_layout.mjs", import.meta.url)), "--check"], { stdio: ["ignore", "ignore", "inherit"] });
});

test("a struct is read as it was written, and no field is in another's place", () => {
    for (const [name, struct] of Object.entries(layout)) {
        const values = Object.fromEntries(struct.fields.filter(([, , kind, count]) => typeof kind === "string" && count === undefined && kind !== "text")
            .map(([field, , kind], i) => [field, kind === "id" ? BigInt(i + 1) << 40n : i + 1]));
        const data = memory();
        data.within((arena) => {
            const at = arena.struct(struct, values), read = data.read(struct, at);
            if ("structSize" in values) read.structSize = data.uint(at); // of no use to scripts, and left out
            for (const [field, value] of Object.entries(values)) assert.equal(read[field], value, `${name}.${field}`);
        });
        const ends = struct.fields.map(([, at]) => at);
        assert.ok(ends.every((at, i) => i === 0 || at > ends[i - 1]) && ends.at(-1) < struct.size, name);
    }
});

test("texts, points and lists are where a struct says", () => {
    const data = memory();
    data.within((arena) => {
        const at = figureSpec(arena, "rope", { name: "ö", position: [1, 2], length: 3, contact: { figures: true } }), figure = data.read(layout.figureSpec, at);
        assert.deepEqual([data.uint(at), figure.prefab, figure.name, figure.position], [layout.figureSpec.size, "rope", "ö", [1, 2, 0]]);
        const parameters = [0, 1].map((i) => data.read(layout.parameter, figure.parameters + i * layout.parameter.size));
        assert.deepEqual(parameters.map(({ name, number }) => [name, number]), [["length", 3], ["contact.figures", 0]]);
        assert.equal(parameters[1].word, "true");
        const surface = data.read(layout.colliderSpec, colliderSpec(arena, { shape: "mesh", points: [[0, 0, 0], [0, 0, 1], [1, 0, 0]], triangles: [[0, 1, 2]] }));
        assert.deepEqual([surface.shape, surface.triangleCount, data.uint(surface.triangles + 8)], [6, 1, 2]);
        const field = data.read(layout.colliderSpec, colliderSpec(arena, { shape: "height_field", heights: [[0, 1, 2], [3, 4, 5]], spacing: 2 }));
        assert.deepEqual([field.columns, field.rows, field.spacing, data.double(field.heights + 24)], [3, 2, 2, 3]);
        assert.throws(() => colliderSpec(arena, { shape: "height_field", heights: [[0], [1, 2]] }), RangeError);
        const force = data.read(layout.forceSpec, forceSpec(arena, { kind: "wind", velocity: [1, 2], seed: -1, figure: "ö" }));
        assert.deepEqual([force.kind, force.velocity, force.seed, force.figure, force.strength], [2, [1, 2, 0], 2n ** 64n - 1n, "ö", 0]);
        assert.equal(data.read(layout.forceSpec, forceSpec(arena, { kind: "drag" })).figure, "");
        const collider = data.read(layout.colliderSpec, colliderSpec(arena, { shape: "polygon", points: [[0, 0], [1, 0], [0, 1]], oneWay: [0, 1], mask: 5 }));
        assert.deepEqual([collider.pointCount, collider.mask, collider.oneWay, data.value(layout.point, collider.points + layout.point.size)], [3, 5, [0, 1, 0], [1, 0, 0]]);
    });
});
