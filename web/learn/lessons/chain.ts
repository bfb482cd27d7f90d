import { pixels, type Lesson } from "../lesson.js";

export const chain: Lesson = {
    id: "chain",
    title: "A chain, and a limit",
    before: [
        `A chain is sticks in a row. The Godot tutorial mends them once, from the top down, and the lower of two loops takes all of the error: cheap, and it hangs beautifully. But its author
         saw two faults: a chain that is dragged about gains speed from nowhere, and it can whip right through itself.`,
        `The first is gone when loops share the error by their masses. The second needs a new promise: <em>the angle between two links is at most so large</em>. A limit, not a value.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], damping: 0.3 },
            figures: [{ prefab: "chain", name: "chain", at: [320, 20], links: 13, loop: 24, gap: 2, thickness: 24, mass: 6, angle: 55, bend_limit: value,
                looks: { link: { color: "#b8602f" } } }],
        }),
        slider: { label: "largest angle between links", unit: "°", low: 5, high: 180, step: 1, value: 60 },
        task: "Make a knot of the chain with 180°, then try the same with 20°.",
    },
    after: [
        `The constraint now measures an angle in place of a distance, and acts only when the angle is too large. Measure something, say between which limits it may be, and how its
         points move it: that is all that a rule has to say. A rope is a distance of <em>at most</em> L. An elbow is an angle between 0 and 150°.`,
    ],
    questions: [["Why does my chain fly off when I drag it?", `Its loops are put where the mouse is, and Verlet reads that as speed. If in the same frame the loop is also moved by its own speed, it is displaced twice, and each frame adds.
        A held point must forget where it was: set the place before to the place now.`]],
    source: "Godot tutorial on Verlet chains, and its author's wishes.",
};
