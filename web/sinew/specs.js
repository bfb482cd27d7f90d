// Structs of bindings/c/sinew.h that begin with their size, as wasm32 lays them out.

const figureBytes = 80, parameterBytes = 24, colliderBytes = 168;
const shapes = ["half_space", "sphere", "capsule", "box", "polygon", "terrain"];
const nothing = [0, 0, 0];

/** Zeros, and what writes into them. */
function struct(arena, bytes) {
    const at = arena.allocate(bytes), { memory } = arena;
    memory.bytes.fill(0, at, at + bytes);
    return {
        at,
        uint: (offset, number) => memory.view.setUint32(at + offset, number, true),
        double: (offset, number) => memory.view.setFloat64(at + offset, number, true),
        point: (offset, point) => point.forEach((number, i) => memory.view.setFloat64(at + offset + 8 * i, number, true)),
    };
}

/** sinew_figure_spec: `parameters` are those of a figure in a scene file. */
export function figureSpec(arena, prefab, { name = "", position = nothing, velocity = nothing, turn = 0, ...parameters }) {
    const values = flat(parameters), list = struct(arena, parameterBytes * values.length);
    values.forEach(([path, value], i) => {
        list.uint(parameterBytes * i, arena.text(path));
        if (typeof value === "number") list.double(parameterBytes * i + 8, value);
        else list.uint(parameterBytes * i + 16, arena.text(typeof value === "string" ? value : JSON.stringify(value)));
    });
    const spec = struct(arena, figureBytes);
    [figureBytes, values.length, list.at, arena.text(prefab), name === "" ? 0 : arena.text(name)].forEach((word, i) => spec.uint(4 * i, word));
    spec.point(24, position);
    spec.point(48, velocity);
    spec.double(72, turn);
    return spec.at;
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
    const spec = struct(arena, colliderBytes);
    [colliderBytes, number, name === "" ? 0 : arena.text(name)].forEach((word, i) => spec.uint(4 * i, word));
    for (const [offset, point] of [[16, position], [40, axis], [72, half], [144, oneWay]]) spec.point(offset, point);
    for (const [offset, value] of [[64, turn], [96, radius], [120, bounce], [128, friction]]) spec.double(offset, value);
    const corners = arena.doubles(points.flatMap(([x, y, z = 0]) => [x, y, z]));
    for (const [offset, word] of [[104, corners], [108, points.length], [112, Number(isSensor)], [136, layers], [140, mask]]) spec.uint(offset, word);
    return spec.at;
}
