import { percent, pixels, type Lesson } from "../lesson.js";

export const tearing: Lesson = {
    id: "tearing",
    figures: [{
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 800], damping: 0.4 },
            figures: [{ prefab: "curtain", name: "curtain", at: [320, 30], columns: 41, rows: 27, spacing: 11, mass: 2, breaking_strain: value, uneven: 0.8, rod: 12,
                looks: { cloth: { color: "#b03a48", fill: "#7f2734" }, rod: { color: "#d6a74f" }, knob: { color: "#b8873b" } } }],
        }),
        slider: { low: 0.05, high: 2, step: 0.01, value: 0.3, logarithmic: true, words: percent },
        restarts: true, cuts: true,
        live: (simulation) => {
            const { length } = simulation.events().filter(({ what }) => what === "torn");
            return { torn: length };
        },
        reading: ({ torn = 0 }, { reading = "" }) => reading.replace("{torn}", `${torn}`),
        challenge: ({ torn = 0 }, value) => torn >= 20 && value >= 0.5,
    }],
};
