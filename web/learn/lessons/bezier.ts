import { pixels, type Lesson } from "../lesson.js";

export const bezier: Lesson = {
    id: "bezier",
    title: "Limbs from three points",
    before: [
        `Three points are an arm: shoulder, elbow, hand. Drawn as two sticks it looks like a robot's. Drawn as a <b>Bézier curve</b> it is a hose, a tentacle, a cartoon's arm. The physics
         is the same; only the pen moves otherwise.`,
        `The curve begins at the shoulder and ends at the hand. It leaves towards the elbow, and arrives from it, but does not go through it.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], damping: 0.6 },
            figures: [{
                name: "arm",
                particles: { shoulder: { at: [250, 70], pinned: true, size: 20 }, elbow: { at: [390, 120], mass: 1, size: 20 }, hand: { at: [390 + value * 0.6, 120 + value * 0.8], mass: 2, size: 34 } },
                constraints: [{ name: "upper", between: ["shoulder", "elbow"], rest: 149 }, { name: "lower", between: ["elbow", "hand"], rest: value }],
                pieces: [{ mark: "curve", part: "sleeve", through: ["shoulder", "elbow", "hand"], width: 44 }],
                looks: { sleeve: { color: "#3f6fb5" }, upper: { color: "#2b2d4270", width: 3 }, lower: { color: "#2b2d4270", width: 3 }, shoulder: { color: "#2b2d42" }, elbow: { color: "#e9a820" }, hand: { color: "#f2b58c" } },
            }],
        }),
        slider: { label: "length of the forearm", unit: "px", low: 40, high: 190, step: 1, value: 150 },
        restarts: true,
        task: "Move the hand around the elbow. Where does the curve go when the arm is straight? When it is folded?",
        code: () => `function curve(shoulder, elbow, hand, t) {   // t from 0 to 1
    const upper = mix(shoulder, elbow, t);    // a point on the upper arm
    const lower = mix(elbow, hand, t);        // one as far along the forearm
    return mix(upper, lower, t);              // and one between the two
}`,
    },
    after: [
        `<code>mix(a, b, t)</code> is the point that lies a share t of the way from a to b. Mixing three times gives a smooth curve: Paul de Casteljau found it at Citroën in 1959, where they drew cars with it.`,
        `Eight samples of t are enough to draw a sleeve. The direction of the curve at t = 1 tells how the hand is turned.`,
    ],
    source: "GameMaker tutorial: Verlet limbs on Bézier curves.",
};
