import { pixels, type Lesson } from "../lesson.js";

export const chain: Lesson = {
    id: "chain",
    figures: [{
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], damping: 0.3 },
            figures: [{ prefab: "chain", name: "chain", at: [320, 20], links: 13, loop: 24, gap: 2, thickness: 24, mass: 6, angle: 55, bend_limit: value,
                looks: { link: { color: "#b8602f" } } }],
        }),
        slider: { unit: "°", low: 5, high: 180, step: 1, value: 60 },
    }],
};
