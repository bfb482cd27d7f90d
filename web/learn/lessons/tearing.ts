import { pixels, percent, type Lesson } from "../lesson.js";

export const tearing: Lesson = {
    id: "tearing",
    title: "Tearing",
    before: [`To tear a cloth, remove a thread that is too long. That is all. The neighbours then carry more, get longer, and tear in turn: a tear runs.`],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 800], damping: 0.4 },
            figures: [{ prefab: "curtain", name: "curtain", at: [320, 30], columns: 41, rows: 27, spacing: 11, mass: 2, breaking_strain: value, uneven: 0.8, rod: 12,
                looks: { cloth: { color: "#b03a48", fill: "#7f2734" }, rod: { color: "#d6a74f" }, knob: { color: "#b8873b" } } }],
        }),
        slider: { label: "a thread tears when stretched by", low: 0.05, high: 2, step: 0.01, value: 0.3, logarithmic: true, words: percent },
        restarts: true,
        reading: (simulation) => `${simulation.events().filter(({ what }) => what === "torn").length} threads torn`,
        task: "Pull fast. Make it weak, then strong. The right mouse button cuts.",
    },
    after: [
        `All threads of one strength would tear in a straight line, all in one moment. So each thread gets a little extra by chance (<code>uneven</code>), and has to be too long for a
         little while, since one jerk of the solver is no tear.`,
        `When a piece comes off, nothing special happens to it: it is points and threads that no longer have a way to the rod.`,
    ],
    source: "Curtain, a tearable cloth tutorial for Processing.",
};
