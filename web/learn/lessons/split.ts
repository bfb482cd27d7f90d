import { pixels, type Lesson } from "../lesson.js";

export const split: Lesson = {
    id: "split",
    title: "Who takes the error?",
    before: [
        `Half each is fair, but not a law. If the first point is heavy, or nailed to the wall, the other must take more. One number tells how the error is split:
         0 leaves the first point alone, 1 makes it take everything.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { damping: 0.9 },
            solver: { mode: "classic", rules: { hold: "corrected" } },
            figures: [{
                name: "stick",
                particles: { first: { at: [120, 200], size: 34 }, second: { at: [520, 200], size: 34 } },
                constraints: [{ name: "stick", between: ["first", "second"], rest: 130, split: value, relaxation: 0.04 }],
                looks: { stick: { color: "#3f6fb5", width: 9 }, first: { color: "#e4572e" }, second: { color: "#e9a820" } },
            }],
        }),
        slider: { label: "share of the first (red) point", low: 0, high: 1, step: 0.05, value: 0.25, words: (value) => `${Math.round(value * 100)} %` },
        restarts: true,
        repeats: 4,
        task: "The stick is too long at first and shrinks. Where does it end up? Then drag one end.",
        code: (value) => `const first = ${value}, second = ${Number((1 - value).toFixed(2))};
a = a.plus(between.times(error / length * first));
b = b.minus(between.times(error / length * second));`,
    },
    after: [
        `In nature the split is not for us to choose: it follows from the masses. Each point moves in proportion to its <b>inverse mass</b>, 1/m, so that the centre of gravity
         stays where it is. A nailed point has inverse mass 0, as if it were infinitely heavy, and needs no special case.`,
        `The Flash tutorial, from which this figure is, lets you choose, which is handy for puppets: a hand that follows the mouse should not be pulled back by the arm.`,
    ],
    source: "Flash tutorial on Verlet constraints: error distribution.",
};
