import { pixels, stretch, type Lesson } from "../lesson.js";

export const iterations: Lesson = {
    id: "iterations",
    title: "Why iterations?",
    before: [
        `In a rope each point belongs to two sticks. Mend the first, and you have broken the second; mend the second, and the first is wrong again. So you go over all sticks,
         again and again. Each pass makes the errors smaller, but none makes them zero.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 900], damping: 0.995 },
            solver: { mode: "classic", passes: value },
            figures: [{ prefab: "rope", name: "rope", at: [320, 24], length: 240, segments: 24, angle: 60, links: "exact", mass: 2, weight: 2, thickness: 7,
                looks: { rope: { color: "#8a5a32" }, weight: { color: "#3d4352", width: 46 } } }],
        }),
        slider: { label: "passes a frame", low: 1, high: 120, step: 1, value: 4, logarithmic: true },
        reading: stretch,
        task: "Begin with one pass: the rope is a rubber band. How many until it looks like rope?",
    },
    after: [
        `News travels one stick a pass: what the weight does at the lower end reaches the nail after 24 passes. And then the nail has to answer. A rope with <em>twice</em> as many pieces
         needs about <em>four times</em> as many passes to be equally stiff.`,
        `Mathematicians call this Gauss-Seidel iteration; it is from the 19th century, and has always been slow on long chains.`,
    ],
    source: "Jakobsen 2001 (relaxation); figure: classic mode, as in all five tutorials.",
};
