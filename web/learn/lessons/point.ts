import { pixels, room, type Lesson } from "../lesson.js";

export const point: Lesson = {
    id: "point",
    title: "A point falls",
    before: [
        `Everything here is made of points, so begin with one. A point needs to remember only two things: <b>where it is</b> and
         <b>where it was</b> a moment ago. The difference of the two is how fast it goes. There is no velocity to store.`,
        `To take a step, let the point go on as it went, and add what gravity does in that time:`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, value], bounds: { ...room, bounce: 0.85 } },
            figures: [{ name: "ball", particles: { ball: { at: [70, 330], velocity: [240, -560], radius: 15, size: 30 } }, looks: { ball: { color: "#e4572e" } } }],
            traces: [{ of: "ball/ball", seconds: 1.6 }],
        }),
        slider: { label: "gravity", unit: "px/s²", low: -900, high: 1800, step: 10, value: 700 },
        task: "Throw the ball. Then turn gravity off with the slider, and then upside down.",
        code: (value) => `const speed = here.minus(before);      // as it went
const gravity = [0, ${value}];             // px/s²
before = here;
here = here.plus(speed).plus(gravity.times(dt * dt));
if (here.y > floor) here.y = floor;    // walls put it back`,
    },
    after: [
        `This is <b>Verlet integration</b>. Loup Verlet used it in 1967 to follow atoms of argon; an astronomer, Størmer, had used it
         sixty years before for northern lights. Its charm: you may <em>move</em> a point, for whatever reason, and the speed mends
         itself, because speed is only the difference. Push the ball out of a wall, and it has bounced. Drag it, let go, and it is thrown.`,
        `That is the trick of all figures that follow. First points move as if they were alone. Then rules move them to where they are allowed to be.`,
    ],
    questions: [
        ["Why dt·dt, and not half of it?", `School says that in a time t gravity moves you by ½·g·t². That is from rest, in <em>one</em> step. Here each step inherits the
            speed of the one before, and over many steps the two halves, one from each neighbour, make a whole. Try both in a notebook: with ½ the ball falls half as fast.`],
        ["Does it depend on the frame rate?", `It does, if you let dt change from step to step: the difference of places is a speed <em>per step</em>. So Sinew always takes steps of the same
            length, sixty a second, and draws in between.`],
    ],
    source: "Verlet 1967; Jakobsen 2001; the idea of placing points comes from all five tutorials that Sinew grew from.",
};
