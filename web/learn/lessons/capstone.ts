import { percent, pixels, room, stretchOf, stretchReading, type Lesson } from "../lesson.js";
import program from "../programs/capstone.js?raw";

const places = {
    head: [0, -112], left_shoulder: [-24, -76], right_shoulder: [24, -76], left_elbow: [-62, -66], right_elbow: [62, -66], left_hand: [-98, -78], right_hand: [98, -78],
    left_hip: [-15, 0], right_hip: [15, 0], left_knee: [-20, 52], right_knee: [20, 52], left_foot: [-24, 104], right_foot: [24, 104],
};
const bones = ["left_shoulder right_shoulder", "left_hip right_hip", "left_shoulder left_hip", "right_shoulder right_hip", "left_shoulder left_elbow", "left_elbow left_hand",
    "right_shoulder right_elbow", "right_elbow right_hand", "left_hip left_knee", "left_knee left_foot", "right_hip right_knee", "right_knee right_foot"];
const hidden = ["left_shoulder right_hip", "right_shoulder left_hip", "head left_shoulder", "head right_shoulder", "head left_hip", "head right_hip"];
const limits: [string, string, number][] = [["left_knee", "right_knee", 22], ["left_hand", "left_shoulder", 34], ["right_hand", "right_shoulder", 34],
    ["left_foot", "left_hip", 62], ["right_foot", "right_hip", 62], ["left_knee", "left_shoulder", 74], ["right_knee", "right_shoulder", 74]];

/** The skeleton of programs/capstone.js as a scene. */
const man = (heavy: number): object => ({
    name: "man", at: [320, 190],
    particles: Object.fromEntries(Object.entries(places).map(([name, at]) => [name, {
        at, velocity: [120 - 2 * at[1]!, -240], radius: 14, size: name === "head" ? 48 : /hand|foot/.test(name) ? 18 : 13, ...(name === "head" && heavy !== 1 ? { mass: heavy } : {}),
    }])),
    constraints: [
        ...bones.map((pair) => ({ name: pair.replace(" ", "_to_"), between: pair.split(" ") })),
        ...hidden.map((pair) => ({ between: pair.split(" "), hidden: true })),
        ...limits.map(([a, b, low]) => ({ between: [a, b], low, hidden: true })),
    ],
    looks: Object.fromEntries<object>([
        ...bones.map((pair): [string, object] => [pair.replace(" ", "_to_"), { color: /knee|foot/.test(pair) ? "#3f6fb5" : "#e4572e", width: 13 }]),
        ...["head", "left_hand", "right_hand", "left_foot", "right_foot"].map((name): [string, object] => [name, { color: "#f2b58c" }]),
    ]),
});

export const capstone: Lesson = {
    id: "capstone",
    figures: [{
        program, sets: "stiffness",
        slider: { low: 1, high: 60, step: 1, value: 12, logarithmic: true },
        reading: ({ stretch = 0 }, { reading = "" }) => reading.replace("{stretch}", percent(Math.max(stretch, 0))),
        challenge: ({ points = 0, stretch = 1 }) => points >= 14 && stretch < 0.01, rests: true,
    }, {
        scene: (value) => ({ ...pixels, world: { gravity: [0, 900], damping: 0.06, bounds: { ...room, bounce: 0.3 } }, solver: { sleep: { speed: 10 } }, figures: [man(value)] }),
        slider: { unit: "kg", low: 1, high: 100, step: 1, value: 1, logarithmic: true },
        restarts: true,
        live: stretchOf,
        reading: stretchReading,
    }],
    files: ["ragdoll", "package"],
};
