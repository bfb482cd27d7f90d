// The work that every contender gets: points and sticks as the scene begins.

const solver = { precision: "float", rate: 60, substeps: 10 };
const world = { gravity: [0, -9.81] };

function cloth(side) {
    return {
        name: `cloth ${side} x ${side}`,
        scene: { sinew: 1, world, solver, figures: [{ prefab: "cloth", columns: side, rows: side, spacing: 0.03, pins: "corners", mass: side * side }] },
    };
}

const rope = {
    name: "rope of 100 links, weight 100",
    scene: { sinew: 1, world, solver, figures: [{ prefab: "rope", length: 2, segments: 100, weight: 100, angle: 45 }] },
};

/** Each hangs by a hand. The limits of its joints are Sinew's alone: the others get its points and sticks. */
const ragdolls = {
    name: "100 ragdolls that hang by a hand",
    scene: {
        sinew: 1, world, solver,
        figures: Array.from({ length: 100 }, (_, i) => ({ prefab: "ragdoll", name: `r${i}`, at: [1.5 * (i % 10), 2.2 * Math.floor(i / 10)] })),
        pins: Array.from({ length: 100 }, (_, i) => ({ particle: `r${i}/left_hand` })),
    },
};

export const cases = [cloth(64), cloth(128), rope, ragdolls];

/** Points, sticks and settings of a simulation at its start. */
export function workOf(simulation) {
    const [positions, mobilities, inverseMasses, ends] =
        ["positions", "mobilities", "inverseMasses", "ends"].map((column) => simulation[column].slice());
    const points = Array.from(mobilities, (mobility, i) => ({
        x: positions[2 * i], y: positions[2 * i + 1], mass: 1 / inverseMasses[i], isPinned: mobility === 0,
    }));
    const sticks = Array.from({ length: ends.length / 2 }, (_, i) => {
        const [a, b] = [ends[2 * i], ends[2 * i + 1]];
        return { a, b, length: Math.hypot(points[a].x - points[b].x, points[a].y - points[b].y) };
    });
    return { points, sticks, gravity: -9.81, dt: 1 / 60, substeps: 10 };
}
