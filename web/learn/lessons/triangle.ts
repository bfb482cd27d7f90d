import { filled, pixels, room, type Lesson } from "../lesson.js";

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
        live: ({ particleCount: corners, constraintCount: sticks }) => ({ corners, sticks, ways: 2 * corners, needed: 2 * corners - 3, missing: 2 * corners - 3 - sticks }),
        reading: (live, { reading = "" }) => filled(reading, Object.fromEntries(Object.entries(live).map(([name, count]) => [name, String(count)]))),
        challenge: ({ corners = 0, missing = 1 }) => corners >= 6 && missing === 0, rests: true,
    }],
};
