import { stretch, type Lesson } from "../lesson.js";

export const cloth: Lesson = {
    id: "cloth",
    title: "Cloth",
    before: [`A cloth is a rope in two directions: a grid of points, threads along and across. Diagonals keep the cells from folding flat, as in the box.`],
    figure: {
        scene: (value) => ({
            sinew: 1,
            dimension: 3,
            view: { size: [640, 400], camera: { eye: [-1.3, 1.5, 3.5], target: [0, 1.12, 0.1], field_of_view: 34 } },
            world: { gravity: [0, -9.81, 0], damping: 0.2, forces: [{ force: "drag", strength: 0.0006 }] },
            figures: [{ prefab: "cloth", name: "cloth", at: [0, 1.95, -0.4], columns: value, rows: value, spacing: Number((1.4 / (value - 1)).toPrecision(6)), plane: "horizontal",
                pins: "corners", mass: 0.4, drawn: "fill", thickness: 0.012, looks: { cloth: { color: "#f2b134", fill: "#d9344a" } } }],
        }),
        slider: { label: "threads", low: 3, high: 36, step: 1, value: 12 },
        restarts: true,
        reading: (simulation) => `${simulation.particleCount} points, ${simulation.constraintCount} constraints; ${stretch(simulation)}`,
        task: "Drag a corner; drag beside the cloth to walk around it; the right mouse button cuts. How many threads until it looks like cloth?",
    },
    after: [
        `With twice as many threads there are four times as many points, and news has twice as far to go. This is where simple solvers give up: a fine cloth sags like chewing gum.
         Sinew ties each point with a <b>tether</b> to the corners it hangs on, not longer than the way along the threads. That costs little and holds at once.`,
    ],
    source: "Provot 1995; Kim, Chentanez and Müller-Fischer: Long Range Attachments, 2012.",
};
