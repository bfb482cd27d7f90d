import type { Lesson } from "../lesson.js";
import program from "../programs/bezier.js?raw";

export const bezier: Lesson = {
    id: "bezier",
    figures: [{
        program, sets: "forearm",
        slider: { unit: "px", low: 40, high: 190, step: 1, value: 150 },
        reading: ({ t = 0, gap = 0 }, { reading = "" }) => reading.replace("{t}", t.toFixed(2)).replace("{gap}", gap.toFixed(0)),
        challenge: ({ gap = 0 }) => gap > 70,
    }],
};
