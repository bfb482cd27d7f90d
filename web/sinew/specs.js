// Structs of bindings/c/sinew.h that begin with their size, of what scripts say.
import { colliderSpec as colliderLayout, figureSpec as figureLayout, parameter } from "./layout.js";

const shapes = ["half_space", "sphere", "capsule", "box", "polygon", "terrain"];
const nothing = [0, 0, 0];

/** sinew_figure_spec: `parameters` are those of a figure in a scene file. */
export function figureSpec(arena, prefab, { name = "", position = nothing, velocity = nothing, turn = 0, ...parameters }) {
    const list = flat(parameters).map(([path, value]) => {
        if (typeof value === "number") return { name: path, number: value };
        return { name: path, word: typeof value === "string" ? value : JSON.stringify(value) };
    });
    return arena.struct(figureLayout, { parameterCount: list.length, parameters: arena.structs(parameter, list), prefab, name, position, velocity, turn });
}

/** Values by path: {contact: {figures: true}} has "contact.figures". */
function flat(values, before = "") {
    return Object.entries(values).flatMap(([name, value]) =>
        value !== null && typeof value === "object" && !Array.isArray(value) ? flat(value, `${before}${name}.`) : [[before + name, value]]);
}

/** sinew_collider_spec. */
export function colliderSpec(arena, { shape, name = "", position = nothing, axis = nothing, turn = 0, half = nothing, radius = 0, points = [], isSensor = false,
    bounce = 0, friction = 0, layers = 0, mask = 0, oneWay = nothing }) {
    const number = shapes.indexOf(shape);
    if (number < 0) throw new RangeError(`a shape is ${shapes.join(", ")}, not "${shape}"`);
    const corners = arena.doubles(points.flatMap(([x, y, z = 0]) => [x, y, z]));
    return arena.struct(colliderLayout, { shape: number, name, position, axis, turn, half, radius, points: corners, pointCount: points.length,
        isSensor, bounce, friction, layers, mask, oneWay });
}
