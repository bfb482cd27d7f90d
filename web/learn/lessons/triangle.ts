import { pixels, room, type Lesson } from "../lesson.js";

export const triangle: Lesson = {
    id: "triangle",
    title: "Why triangles are stiff",
    before: [
        `Three points and three sticks are a triangle, and a triangle cannot change its shape: there is only one triangle with sides of these lengths. More corners, and it can.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], bounds: room },
            figures: [{ prefab: "polygon", name: "form", at: [230, 130], sides: value, radius: 100, braced: "none", mass: 4, thickness: 12, velocity: [140, -120],
                looks: { all: { color: "#1f8a8a", fill: "#8fcfc6" } } }],
        }),
        slider: { label: "corners", low: 3, high: 12, step: 1, value: 3 },
        restarts: true,
        task: "Give it a fourth corner and watch it fold. Pick the heap up by a corner.",
    },
    after: [
        `Count: each corner can move in two directions, so n corners have 2n ways to move. Each stick takes one away. Moving the whole thing about takes two and turning it one, so
         <b>2n − 3</b> sticks make it stiff. For a triangle that is 3, and it has 3. A square has 4, and needs 5.`,
        `Bridges, cranes and roofs are triangles for the same reason. With twelve corners and no braces you get a bag, or a chain that is closed.`,
    ],
    source: "Maxwell counted sticks like this in 1864; Flash tutorial on Verlet constraints: triangle.",
};
