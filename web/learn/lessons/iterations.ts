import { percent, type Lesson } from "../lesson.js";
import program from "../programs/iterations.js?raw";

export const iterations: Lesson = {
    id: "iterations",
    figures: [{
        program, sets: "passes",
        slider: { low: 1, high: 120, step: 1, value: 4, logarithmic: true },
        reading: ({ stretch = 0 }, { reading = "" }) => reading.replace("{stretch}", percent(stretch)),
        challenge: ({ stretch = 1 }) => stretch < 0.01,
        rests: true, isFewestBest: true,
    }],
    files: ["rope"],
};
