import { percent, type Lesson } from "../lesson.js";
import program from "../programs/substeps.js?raw";

export const substeps: Lesson = {
    id: "substeps",
    figures: [{
        program, sets: "effort",
        slider: { low: 1, high: 60, step: 1, value: 4, logarithmic: true },
        reading: ({ left = 0, right = 0 }, { reading = "" }) => reading.replace("{left}", percent(left)).replace("{right}", percent(right)),
        challenge: ({ right = 1 }) => right < 0.01,
        rests: true, isFewestBest: true,
    }],
};
