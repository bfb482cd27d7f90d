import { pixels, room, type Lesson } from "../lesson.js";

const braces = ["none", "one", "both"];

export const box: Lesson = {
    id: "box",
    title: "A box and its diagonal",
    before: [`Four corners and four sides make a box that falls flat. The stick that was missing is a diagonal. (2 · 4 − 3 = 5.)`],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], bounds: room },
            figures: [{ prefab: "box", name: "box", at: [240, 140], width: 130, height: 130, braces: braces[value], mass: 8, thickness: 12, dot: 16, turn: 15, velocity: [120, -160],
                looks: { edge: { color: "#8a5a32" }, corner: { color: "#4f9d69" } } }],
        }),
        slider: { label: "diagonals", low: 0, high: 2, step: 1, value: 0, words: (value) => braces[value] ?? "" },
        restarts: true,
        task: "Throw the box without a diagonal, then with one.",
    },
    after: [
        `The second diagonal is one stick more than needed. Where all lengths fit, it changes nothing. Where they do not, as with a box that was made 60 px wide and a diagonal that was
         measured wrongly, the sticks quarrel and the box trembles for ever. This is the usual reason why a box of your own shakes.`,
        `The box also tumbles, lands on an edge and rolls over, and again nobody wrote that down.`,
    ],
    questions: [
        ["My box does weird things: it bounces up and down for ever.", `Two usual reasons. The bounce sets the <em>old</em> place on the wrong side of the wall, which gives the point more speed than it had. Or points
            are moved six times a frame and the sticks only once: then the sticks never catch up. Move and mend the same number of times.`],
    ],
    source: "Roblox developer forum: Verlet integration, and the questions of its readers.",
};
