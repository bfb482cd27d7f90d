import { pixels, type Lesson } from "../lesson.js";

const lowest = -3862400; // of the potential energy, in kg px²/s²: the seat and the ropes hang straight down
const all = 1825978;      // above it at the start

export const swing: Lesson = {
    id: "swing",
    figures: [{
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 800], damping: value },
            figures: [
                { prefab: "swing", name: "swing", at: [320, 24], length: 200, width: 90, segments: 10, angle: 62, mass: 2, weight: 20, thickness: 5, looks: { rope: { color: "#c9a46a" }, seat: { color: "#7a4a22", width: 15 } } },
            ],
            traces: [{ of: "swing", shows: "energy", seconds: 30, box: [[30, 318], [610, 385]], low: -4.5e6, high: -1.6e6 }],
        }),
        slider: { unit: "1/s", low: 0, high: 1, step: 0.01, value: 0 },
        live: (simulation) => {
            const { kinetic, potential, seconds } = simulation.report();
            return { seconds, height: (potential - lowest) / all, motion: kinetic / all, left: (potential + kinetic - lowest) / all };
        },
        reading: ({ seconds = 0, left = 0 }, { reading = "" }) => reading.replace("{seconds}", seconds.toFixed(0)).replace("{left}", `${(100 * left).toFixed(1)} %`),
        challenge: ({ seconds = 0, left = 0 }) => seconds >= 10 && seconds < 10.3 && Math.abs(left - 0.5) < 0.01,
        bars: ({ height = 0, motion = 0 }) => [height, motion],
    }],
};
