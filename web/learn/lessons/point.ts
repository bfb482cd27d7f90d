import type { Lesson } from "../lesson.js";
import program from "../programs/point.js?raw";

export const point: Lesson = {
    id: "point",
    figures: [{
        program, sets: "gravity",
        slider: { unit: "px/s²", low: -900, high: 1800, step: 10, value: 700 },
        reading: ({ speed = 0 }, { reading = "" }) => reading.replace("{speed}", speed.toFixed(0)),
        challenge: ({ height = 1e9, speed = 1e9 }, value) => value > 0 && height > 280 && speed < 40,
    }],
};
