import { pixels, stretchReading, type Lesson } from "../lesson.js";
import program from "../programs/matrix.js?raw";

export const rope: Lesson = {
    id: "rope",
    figures: [{
        scene: (value) => ({
            ...pixels,
            view: { size: [340, 400], center: [320, 180], height: 360 },
            world: { gravity: [0, 900], damping: 0.1 },
            figures: [{ prefab: "rope", name: "rope", at: [320, 20], length: 240, segments: 30, angle: 34, links: "exact", mass: 1, weight: value, thickness: 7,
                looks: { rope: { color: "#8a5a32" }, weight: { color: "#3d4352", width: 56 } } }],
            modes: { classic: { world: { damping: 0.999 }, solver: { passes: 10 }, figures: { rope: { weight: 1 } } } },
        }),
        slider: { unit: "kg", low: 1, high: 1000, step: 1, value: 100, logarithmic: true },
        restarts: true,
        split: true,
        live: (left, _, right) => ({ left: left.report().stretchMax, right: right?.report().stretchMax ?? 0 }),
        reading: stretchReading,
    }, {
        program, sets: "shape",
        slider: { low: 0, high: 2, step: 1, value: 0, words: (value, choices) => choices[value] ?? "" },
        reading: ({ filled = 0, work = 0 }, { reading = "" }) => reading.replace("{filled}", `${filled}`).replace("{work}", `${work}`),
    }],
};
