import type { Lesson } from "../lesson.js";
import program from "../programs/integrators.js?raw";

export const integrators: Lesson = {
    id: "integrators",
    figures: [{
        program, sets: "rate", repeats: 40,
        slider: { low: 8, high: 120, step: 1, value: 20 },
        reading: (live, { reading = "", choices = [] }) => {
            const worst = Object.values(live).map(Math.abs);
            return reading.replace("{errors}", worst.map((error, i) => `${choices[i]} ${(100 * error).toFixed(error < 0.1 ? 1 : 0)} %`).join(", "));
        },
        challenge: ({ rungeKutta4 = 0, verlet = 0 }) => rungeKutta4 < verlet - 0.01,
    }],
};
