import { pixels, stretch, type Lesson } from "../lesson.js";

export const rope: Lesson = {
    id: "rope",
    title: "Ropes that do not stretch",
    before: [
        `On the left the tutorials' rope, with ten passes a frame. On the right Sinew's, a rope of one kilogram with the weight that you choose. (The tutorials have no
         masses: on the left all points weigh the same.)`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            view: { size: [340, 400], center: [320, 180], height: 360 },
            world: { gravity: [0, 900], damping: 0.1 },
            figures: [{ prefab: "rope", name: "rope", at: [320, 20], length: 240, segments: 30, angle: 34, links: "exact", mass: 1, weight: value, thickness: 7,
                looks: { rope: { color: "#8a5a32" }, weight: { color: "#3d4352", width: 56 } } }],
            modes: { classic: { world: { damping: 0.999 }, solver: { passes: 10 }, figures: { rope: { weight: 1 } } } },
        }),
        slider: { label: "weight on the right", unit: "kg", low: 1, high: 1000, step: 1, value: 100, logarithmic: true },
        restarts: true,
        split: true,
        reading: (left, _, right) => `left: ${stretch(left)}; right: ${right ? stretch(right) : "–"}`,
        task: "Swing both. Make the right one a thousand times heavier than its rope.",
    },
    after: [
        `A sweep passes news from stick to stick, and a heavy weight at the end of light sticks is the worst case: each pass moves the light points and hardly the weight. A thousand to one would need about a million passes.`,
        `So Sinew does not sweep a rope at all. All lengths at once are a system of equations, and for a row of sticks it is nearly empty: each knows only its neighbours. Solving it takes one way down and one way up, as many steps
         as there are sticks. Figures that hang together like trees, ropes, ragdolls, chains and bridges are solved like this, <em>exactly</em>. Cloth, with its many loops, is swept.`,
    ],
    source: "Cholesky for banded systems, in Goldenthal and others 2007, Deul and others 2018.",
};
