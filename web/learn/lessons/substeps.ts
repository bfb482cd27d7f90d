import { pixels, stretch, type Lesson } from "../lesson.js";

export const substeps: Lesson = {
    id: "substeps",
    title: "Why substeps?",
    before: [
        `You can afford, say, 16 passes a frame. You may go over the sticks 16 times after <em>one</em> step of 1/60 s. Or you take 16 steps of 1/960 s, and go over the sticks
         <em>once</em> after each. It is the same work. It is not the same rope.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 900], damping: 0.1 },
            solver: { direct: "off", substeps: value },
            figures: [{ prefab: "rope", name: "rope", at: [320, 24], length: 240, segments: 24, angle: 60, links: "exact", mass: 2, weight: 20, thickness: 7,
                looks: { rope: { color: "#8a5a32" }, weight: { color: "#3d4352", width: 62 } } }],
        }),
        slider: { label: "substeps", low: 1, high: 120, step: 1, value: 4, logarithmic: true },
        reading: stretch,
        task: "The same rope as before, with a weight ten times as heavy. Compare the same numbers.",
    },
    after: [
        `In a step of half the length a point falls a <em>quarter</em> as far (dt²!), so there is a quarter of the error to mend. Twice the substeps leave a quarter of the error, where twice the
         passes leave about half of it. Small steps win, and they also lose less energy.`,
        `Sinew takes 16 substeps in physical mode, unless the figure can be solved exactly: that is another lesson.`,
    ],
    source: "Macklin, Storey, Lu, Terdiman, Chentanez, Jeschke and Müller: Small Steps in Physics Simulation, 2019.",
};
