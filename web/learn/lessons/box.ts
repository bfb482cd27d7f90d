import { pixels, room, type Lesson } from "../lesson.js";

const braces = ["none", "one", "both"];

export const box: Lesson = {
    id: "box",
    figures: [{
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], bounds: room },
            figures: [{ prefab: "box", name: "box", at: [240, 140], width: 130, height: 130, braces: braces[value], mass: 8, thickness: 12, dot: 16, turn: 15, velocity: [120, -160],
                looks: { edge: { color: "#8a5a32" }, corner: { color: "#4f9d69" } } }],
        }),
        slider: { low: 0, high: 2, step: 1, value: 0, words: (value, choices) => choices[value] ?? "" },
        restarts: true,
    }],
};
