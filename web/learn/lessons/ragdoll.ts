import type { Lesson } from "../lesson.js";

const muscle = (a: string, b: string, c: string, rest: number, strength: number): object =>
    ({ kind: "angle", between: [`bob/${a}`, `bob/${b}`, `bob/${c}`], rest, compliance: 0.0002, damping_time: 0.12, max_force: strength });

export const ragdoll: Lesson = {
    id: "ragdoll",
    title: "A ragdoll",
    before: [
        `A man is fourteen points: head and neck, and two each of shoulders, elbows, hands, hips, knees and feet. Bones are sticks between them. Elbows and knees are angles with limits, so that they bend one way
         only. A hand that is pinned hangs him up.`,
        `Muscles are angles that want a value, but are only so strong: above their largest torque they give way.`,
    ],
    figure: {
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
        slider: { label: "largest torque of a muscle", unit: "N m", low: 1, high: 1000, step: 1, value: 30, logarithmic: true },
        task: "From limp to gymnast: how strong must he be for the cross? Pull him down by a foot.",
        code: (value) => `{
  "figures": [{"prefab": "ragdoll", "name": "bob", "height": 1.6, "mass": 60, "pose": "star"}],
  "pins": [{"particle": "bob/left_hand"}, {"particle": "bob/right_hand"}],
  "constraints": [{
    "kind": "angle",                  // of a shoulder; there are five more like it
    "between": ["bob/right_shoulder", "bob/left_shoulder", "bob/left_elbow"],
    "rest": 8, "compliance": 0.0002,  // degrees; how soft
    "max_force": ${value}
  }]
}`,
    },
    after: [
        `Old ragdolls had no angles: hidden sticks (a beam from hip to the other shoulder, a rope from knee to knee) kept the limbs apart, and Thomas Jakobsen's agents of 2000 never crossed their knees
         because that distance was <em>at least</em> so much. The Roblox tutorial's man has six such beams. They still work; open <code>ragdoll</code> in the playground and switch it to classic.`,
    ],
    questions: [
        ["How do you connect points so that they look like a human?", `Draw a matchstick man on paper and put a dot on every joint: those are the points, and the matches are the sticks. Then look for what would still fold: a trunk
            of four sticks is a box without a diagonal, so it gets one. Last come the limits, or his knees bend backwards. The drawing on top (shirt, head, shoes) hangs on the points and changes nothing.`],
        ["Where is the code for his collisions?", `There is none for <em>him</em>. Each point is kept out of the wall by itself, the sticks pull the rest along, and so he tumbles, arm over leg. Between two points a stick can still dip
            into a corner; an engine with shapes, as Sinew has for <code>contact</code>, tests the whole stick.`],
    ],
    source: "Jakobsen, Advanced Character Physics, 2001; Roblox developer forum: ragdolls.",
};
