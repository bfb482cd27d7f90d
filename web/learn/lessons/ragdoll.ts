import type { Lesson } from "../lesson.js";

const muscle = (a: string, b: string, c: string, rest: number, strength: number): object =>
    ({ kind: "angle", between: [`bob/${a}`, `bob/${b}`, `bob/${c}`], rest, compliance: 0.0002, damping_time: 0.12, max_force: strength });

export const ragdoll: Lesson = {
    id: "ragdoll",
    figures: [{
        scene: (value) => ({
            sinew: 1,
            view: { size: [640, 400], center: [0, 0.25], height: 3 },
            world: { gravity: [0, -9.81], damping: 0.2 },
            figures: [{ prefab: "ragdoll", name: "bob", height: 1.6, mass: 60, pose: "star", at: [0, 0.5] }],
            pins: [{ particle: "bob/left_hand", compliance: 1e-5 }, { particle: "bob/right_hand", compliance: 1e-5 }],
            constraints: [
                muscle("right_shoulder", "left_shoulder", "left_elbow", 8, value), muscle("left_shoulder", "right_shoulder", "right_elbow", -8, value),
                muscle("left_shoulder", "left_elbow", "left_hand", 10, value), muscle("right_shoulder", "right_elbow", "right_hand", -10, value),
                muscle("left_shoulder", "left_hip", "left_knee", -4, value), muscle("right_shoulder", "right_hip", "right_knee", 4, value),
            ],
        }),
        slider: { unit: "N m", low: 1, high: 1000, step: 1, value: 30, logarithmic: true },
        live: (simulation) => {
            const height = (name: string): number => simulation.stateOf(`bob/${name}`).position[1]!;
            return { sag: 100 * ((height("left_hand") + height("right_hand")) / 2 - (height("left_shoulder") + height("right_shoulder")) / 2) };
        },
        reading: ({ sag = 0 }, { reading = "" }) => reading.replace("{sag}", sag.toFixed(0)),
        challenge: ({ sag = 100 }) => sag < 10,
        rests: true, isFewestBest: true,
    }],
    files: ["cloth"],
};
