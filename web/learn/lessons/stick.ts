import { pixels, room, type Lesson } from "../lesson.js";

export const stick: Lesson = {
    id: "stick",
    title: "Two points and a stick",
    before: [
        `A stick is a promise: <em>these two points are so far from each other</em>. After each step the points have broken it a little. Measure by how much, and move
         both back along the line between them, half of the error each.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], bounds: room },
            figures: [{
                name: "stick",
                particles: { first: { at: [150, 210], velocity: [260, -560], radius: 12, size: 24 }, second: { at: [150, 210 - value], velocity: [-60, -340], radius: 12, size: 24 } },
                constraints: [{ name: "stick", between: ["first", "second"], rest: value }],
                looks: { stick: { color: "#3f6fb5", width: 11 }, first: { color: "#e4572e" }, second: { color: "#e9a820" } },
            }],
        }),
        slider: { label: "length", unit: "px", low: 40, high: 190, step: 1, value: 130 },
        restarts: true,
        task: "Take one end and swing the other around it. Throw it, so that it tumbles.",
        code: (value) => `const between = b.minus(a);
const length = between.length();
const error = length - ${value};               // px
const push = between.times(error / length / 2);
a = a.plus(push);                      // half of the error
b = b.minus(push);                     // and the other half`,
    },
    after: [
        `Nobody told the stick how to turn. There is no angle in it and no spin: two points fall, one rule holds them apart, and tumbling comes out of it.`,
        `Sinew says the same in a scene file: a constraint <code>between</code> two particles, with its <code>rest</code> length.`,
    ],
    questions: [
        ["What is theta? And adj, opp, hyp and mid?", `They are only for drawing. <em>adj</em> and <em>opp</em> are how far the stick goes across and down, <em>hyp</em> is its length by Pythagoras,
            <em>mid</em> the point halfway: where to put the picture of the stick. Theta (θ) is just the Greek letter that people use for an angle, as they use x for a number they do not know yet. In the tutorials it is the direction from one
            end of a stick to the other, and it is needed for one thing only: to <em>draw</em> a picture of the stick, which has to be turned. <code>atan2(dy, dx)</code> answers:
            “if I go dx to the right and dy down, which way do I look?” The physics never asks.`],
        ["Mine stretches without end. I wrote (error − length) / 2.", `Divide: <code>error / length / 2</code>. The line from a to b is as long as the stick. You want a piece of it, half of the error long, so you
            need the <em>share</em> of the line that this is. A minus in place of the stroke moves the points by whole stick lengths, and each step makes it worse.`],
        ["How do you understand this? My head is too small.", `Nobody understands it all at once, and nobody has to. Cover the figure and do it with a pencil: two dots, 10 cm apart, that should be 8 cm apart.
            The error is 2. Move each dot 1 cm towards the other. You have just done every line of the code. All the rest of this course is doing it many times.`],
    ],
    source: "Flash tutorial on Verlet constraints; Jakobsen 2001.",
};
