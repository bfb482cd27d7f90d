const mostBytes = 16_000_000;

/** A scene in which the mesh of an OBJ file hangs by its highest points, or lies, as cloth; the command's `sinew import` knows more. */
export function sceneOfObj(text: string, name: string): string {
    if (text.length > mostBytes) throw new Error(`${name} has more than 16 MB.`);
    const given = [...text.matchAll(/^[ \t]*v[ \t]+(\S+)[ \t]+(\S+)[ \t]+(\S+)/gm)].map((found) => found.slice(1, 4).map(Number));
    const points = [...new Map(given.map((point) => [point.join(" "), point])).values()]; // the engine joins points of one place
    if (points.length === 0 || !points.every((point) => point.every(Number.isFinite))) throw new Error(`${name} has no vertices that are numbers.`);
    const low = [0, 1, 2].map((i) => points.reduce((least, point) => Math.min(least, point[i]!), Infinity));
    const high = [0, 1, 2].map((i) => points.reduce((most, point) => Math.max(most, point[i]!), -Infinity));
    const extent = low.map((from, i) => high[i]! - from), longest = Math.max(...extent, 1e-9);
    const size = longest >= 0.1 && longest <= 50 ? 1 : 2 / longest; // others are scaled to 2 m
    const at = (i: number, share: number): number => round((low[i]! + extent[i]! * share) * size);
    const hangs = extent[1]! > 0.1 * longest;
    const highest = hangs ? points.flatMap((point, i) => (point[1]! >= high[1]! - 0.02 * extent[1]! ? [i] : [])) : [];
    const far = 2 * Math.hypot(...extent) * size, middle = [0, 1, 2].map((i) => at(i, 0.5));
    const scene = {
        sinew: 1,
        about: `The mesh of ${name}, as cloth.`,
        dimension: 3,
        view: { size: [800, 600], camera: { eye: middle.map((x, i) => round(x + far * [0.4, 0.3, 0.9][i]!)), target: middle } },
        world: { gravity: [0, -9.81, 0], damping: 0.05 },
        colliders: [{ name: "floor", shape: "half_space", at: [0, round(low[1]! * size - 0.4 * Math.max(extent[1]!, 0.2 * longest) * size), 0], friction: 0.6 }],
        figures: [{ prefab: "mesh", name: "model", file: name, size: round(size), thickness: round(0.01 * longest * size), pin_list: highest, contact: { figures: true } }],
    };
    return JSON.stringify(scene, null, 2);
}

const round = (x: number): number => Number(x.toPrecision(6));

/** True for a file that the command makes a scene of, and the page does not. */
export const isForImport = (name: string): boolean => /\.(svg|png|glb|gltf|tmj|tmx)$/i.test(name);
