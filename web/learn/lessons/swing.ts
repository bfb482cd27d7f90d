import { pixels, type Lesson } from "../lesson.js";

export const swing: Lesson = {
    id: "swing",
    title: "A swing that keeps swinging",
    before: [
        `Push a swing without friction, and it should swing for ever, as high each time. Most engines lose a little in each step, and nobody notices, since swings stop anyway. But then the number of steps decides <em>when</em>.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            view: { size: [640, 400], center: [320, 200], height: 400 },
            world: { gravity: [0, 800], damping: value },
            figures: [
                { prefab: "swing", name: "swing", at: [320, 24], length: 200, width: 90, segments: 10, angle: 62, mass: 2, weight: 20, thickness: 5, looks: { rope: { color: "#c9a46a" }, seat: { color: "#7a4a22", width: 15 } } },
            ],
            traces: [{ of: "swing", shows: "energy", label: "energy", seconds: 30, box: [[30, 318], [610, 385]], low: -4.5e6, high: -1.6e6 }],
        }),
        slider: { label: "friction of the air", unit: "1/s", low: 0, high: 1, step: 0.01, value: 0 },
        task: "Leave it alone for a minute with no friction. Then add some: the energy sinks as fast as you say.",
    },
    after: [
        `Verlet's step keeps energy well; the <em>mending</em> loses it. When the seat is pulled back onto its circle, the place changes but the time at which it happens does not, and each such correction is late by half a step. Sinew
         solves for speeds as well as for places, so what was mended also moves along the circle.`,
        `Friction is then a number of yours, in 1/s: with 0.5 the speed falls to 61 % in a second, on every machine.`,
    ],
    source: "Hairer, Lubich and Wanner 2002 (SHAKE and RATTLE: Ryckaert 1977, Andersen 1983).",
};
