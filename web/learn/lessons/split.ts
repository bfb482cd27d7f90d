import type { Lesson } from "../lesson.js";
import program from "../programs/split.js?raw";

export const split: Lesson = {
    id: "split",
    figures: [{
        program, sets: "first", repeats: 4,
        slider: { low: 0, high: 1, step: 0.05, value: 0.25, words: (value) => `${Math.round(value * 100)} %` },
        challenge: ({ red = 0 }) => Math.abs(red - 100) < 0.5, rests: true,
        reading: ({ red = 0, yellow = 0 }, { reading = "" }) => reading.replace("{red}", red.toFixed(0)).replace("{yellow}", yellow.toFixed(0)),
    }],
    files: ["sticks"],
};
