import { pixels, room, type Lesson } from "../lesson.js";

export const triangle: Lesson = {
    id: "triangle",
    figures: [{
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 700], bounds: room },
            figures: [{ prefab: "polygon", name: "form", at: [230, 130], sides: value, radius: 100, braced: "none", mass: 4, thickness: 12, velocity: [140, -120],
                looks: { all: { color: "#1f8a8a", fill: "#8fcfc6" } } }],
        }),
        slider: { low: 3, high: 12, step: 1, value: 3 },
        restarts: true,
        live: (_, value) => ({ corners: value, ways: 2 * value, needed: 2 * value - 3, missing: value - 3 }),
        reading: ({ corners = 3, ways = 6, needed = 3, missing = 0 }, { reading = "" }) => reading.replace("{ways}", `${ways}`).replace("{corners}", `${corners}`).replace("{needed}", `${needed}`).replace("{missing}", `${missing}`),
    }],
};
