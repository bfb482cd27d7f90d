// Structs of bindings/c/sinew.h that begin with their size, of what scripts say.
import { colliderSpec as colliderLayout, figureSpec as figureLayout, forceSpec as forceLayout, parameter } from "./layout.js";

const shapes = ["half_space", "sphere", "capsule", "box", "polygon", "terrain", "mesh", "height_field"];
export const forceKinds = ["gravity", "drag", "wind", "attractor", "random_push"];
const nothing = [0, 0, 0];

/** Array of sinew_parameter, those of a figure in a scene file, and their number. */
export function parameterList(arena, values) {
    const list = flat(values).map(([path, value]) => {
        if (typeof value === "number") return { name: path, number: value };
        return { name: path, word: typeof value === "string" ? value : JSON.stringify(value) };
    });
    return { parameters: arena.structs(parameter, list), parameterCount: list.length };
}

/** sinew_figure_spec. */
export function figureSpec(arena, prefab, { name = "", position = nothing, velocity = nothing, turn = 0, ...parameters }) {
    return arena.struct(figureLayout, { ...parameterList(arena, parameters), prefab, name, position, velocity, turn });
}

/** Values by path: {contact: {figures: true}} has "contact.figures". */
function flat(values, before = "") {
    return Object.entries(values).flatMap(([name, value]) =>
        value !== null && typeof value === "object" && !Array.isArray(value) ? flat(value, `${before}${name}.`) : [[before + name, value]]);
}

/** Place of a word in its list. */
function numberOf(words, word, what) {
    const number = words.indexOf(word);
    if (number < 0) throw new RangeError(`${what} is ${words.join(", ")}, not "${word}"`);
    return number;
}

/** sinew_collider_spec. */
export function colliderSpec(arena, { shape, name = "", points = [], triangles = [], heights = [], ...numbers }) {
    const columns = heights[0]?.length ?? 0;
    if (heights.some((row) => row.length !== columns)) throw new RangeError("rows of heights have the same length");
    return arena.struct(colliderLayout, { ...numbers, shape: numberOf(shapes, shape, "a shape"), name,
        points: arena.doubles(points.flatMap(([x, y, z = 0]) => [x, y, z])), pointCount: points.length,
        triangles: arena.uints(triangles.flat()), triangleCount: triangles.length, heights: arena.doubles(heights.flat()), columns, rows: heights.length });
}

/** sinew_force_spec. */
export function forceSpec(arena, { kind, seed = 0, ...values }) {
    return arena.struct(forceLayout, { ...values, kind: numberOf(forceKinds, kind, "a force"), seed: BigInt.asUintN(64, BigInt(seed)) });
}
