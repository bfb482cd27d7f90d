import { pixels, type Lesson, type Live } from "../lesson.js";
import type { Simulation } from "../../sinew/index.js";

const arm = (name: string, color: string, shift: number): object => ({
    name, at: [320, 130],
    particles: { top: { at: [0, 0], pinned: true, size: 12 }, knee: { at: [110, -30], mass: 1, size: 18 }, foot: { at: [200 + shift, -95], mass: 1, size: 26 } },
    constraints: [{ name: "upper", between: ["top", "knee"], rest: 114.0175425099138 }, { name: "lower", between: ["knee", "foot"], rest: 111.0180165558726 }],
    looks: { upper: { color, width: 6 }, lower: { color, width: 6 }, knee: { color }, foot: { color }, top: { color: "#8b8474" } },
});

const shiftOf = (value: number): number => (value >= 0 ? 0 : 10 ** value);

/** A number as an exponent is written. */
const raised = (value: number): string => String(value).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]!);

function live(simulation: Simulation): Live {
    const at = simulation.positions, half = at.length / 2;
    return { apart: Math.hypot((at[4] ?? 0) - (at[half + 4] ?? 0), (at[5] ?? 0) - (at[half + 5] ?? 0)), steps: simulation.report().steps };
}

export const determinism: Lesson = {
    id: "determinism",
    figures: [{
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 900] },
            solver: { precision: "double" },
            figures: [arm("blue", "#3f6fb5", shiftOf(value)), arm("red", "#e4572e", 0)],
            traces: [{ of: "blue/foot", seconds: 1 }, { of: "red/foot", seconds: 1 }],
        }),
        slider: { low: -13, high: 0, step: 1, value: 0, words: (value, choices) => (value >= 0 ? (choices[0] ?? "") : `10${raised(value)} px`) },
        restarts: true,
        repeats: 60,
        live,
        reading: ({ apart = 0, steps = 0 }, { reading = "", choices = [] }) =>
            reading.replace("{steps}", `${steps}`).replace("{apart}", apart === 0 ? (choices[1] ?? "") : `${apart.toExponential(1)} px`),
    }],
};
