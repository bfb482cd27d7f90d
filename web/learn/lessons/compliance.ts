import { pixels, type Lesson } from "../lesson.js";

const weight = 2 * 980; // kg px/s²

export const compliance: Lesson = {
    id: "compliance",
    title: "Soft, and how soft",
    before: [
        `To make a stick soft, the tutorials remove only a part of the error in each pass. It works, but <em>how</em> soft it gets depends on the number of passes and of frames: the same scene is stiffer
         on a faster computer. A spring in the shop has one number, and it is not “0.3 per pass”.`,
        `That number is the <b>compliance</b>: how far it gives for each unit of force. The stiffness upside down. Zero is rigid.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 980], damping: 0.7 },
            figures: [{
                name: "springs",
                particles: {
                    left_top: { at: [220, 20], pinned: true }, left: { at: [220, 140], mass: 2, radius: 24, size: 48 },
                    right_top: { at: [420, 20], pinned: true }, right: { at: [420, 140], mass: 2, radius: 24, size: 48 },
                },
                constraints: [{ name: "spring", between: ["left_top", "left"], rest: 120, compliance: value }, { name: "rod", between: ["right_top", "right"], rest: 120 }],
                looks: { spring: { color: "#1f8a8a", width: 6 }, rod: { color: "#8b8474", width: 6 }, left: { color: "#e4572e" }, right: { color: "#3d4352" } },
            }],
        }),
        slider: { label: "compliance of the left one", unit: "s²/kg", low: 0, high: 0.12, step: 0.001, value: 0.05 },
        reading: (simulation, value) => `should hang ${(weight * value).toFixed(1)} px lower: m · g · compliance; it is ${((simulation.positions[3] ?? 0) - 140).toFixed(1)} px lower now`,
        code: (value) => `const compliance = ${value};             // how far for how much force
const soft = compliance / (dt * dt);
const error = between.length() - 120;   // px
const more = (-error - soft * force) / (1 / massA + 1 / massB + soft);
force += more;                          // what the spring has pulled so far
const push = between.times(more / between.length());
a = a.minus(push.times(1 / massA));
b = b.plus(push.times(1 / massB));      // before each substep: force = 0`,
        task: "Wait until it is at rest, and compare with the formula. Then bounce it.",
    },
    after: [
        `A weight of 2 kg pulls with m·g = 1960 kg px/s². Times the compliance, that is how far it hangs, with any number of substeps, on any machine. The method is called <b>XPBD</b>: position based
         dynamics with a memory of the force, so that a constraint stops pulling when it pulls as hard as its spring would.`,
    ],
    source: "Macklin, Müller and Chentanez: XPBD, 2016.",
};
