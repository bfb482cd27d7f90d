import type { Lesson } from "../lesson.js";
import program from "../programs/compliance.js?raw";

export const compliance: Lesson = {
    id: "compliance",
    figures: [{
        program, sets: "compliance",
        slider: { unit: "s²/kg", low: 0, high: 0.12, step: 0.001, value: 0.05 },
        reading: ({ hangs = 0, promised = 0 }, { reading = "" }) => reading.replace("{promised}", promised.toFixed(1)).replace("{hangs}", hangs.toFixed(1)),
        rests: true,
        challenge: ({ hangs = 0 }) => Math.abs(hangs - 200) < 1,
    }],
};
