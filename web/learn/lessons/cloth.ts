import { stretchOf, stretchReading, type Lesson } from "../lesson.js";

export const cloth: Lesson = {
    id: "cloth",
    figures: [{
        scene: (value) => ({
            sinew: 1,
            dimension: 3,
            view: { size: [640, 400], camera: { eye: [-1.3, 1.5, 3.5], target: [0, 1.12, 0.1], field_of_view: 34 } },
            world: { gravity: [0, -9.81, 0], damping: 0.2, forces: [{ force: "drag", strength: 0.0006 }] },
            figures: [{ prefab: "cloth", name: "cloth", at: [0, 1.95, -0.4], columns: value, rows: value, spacing: Number((1.4 / (value - 1)).toPrecision(6)), plane: "horizontal",
                pins: "corners", mass: 0.4, drawn: "fill", thickness: 0.012, looks: { cloth: { color: "#f2b134", fill: "#d9344a" } } }],
        }),
        slider: { low: 3, high: 36, step: 1, value: 12 },
        restarts: true, cuts: true,
        live: (simulation) => ({ points: simulation.particleCount, rules: simulation.constraintCount, ...stretchOf(simulation) }),
        reading: ({ points = 0, rules = 0, ...live }, text) =>
            stretchReading(live, text).replace("{count}", `${points}`).replace("{rules}", `${rules}`),
    }],
};
