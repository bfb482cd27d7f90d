import { percent, type Lesson } from "../lesson.js";
import program from "../programs/stick.js?raw";

export const stick: Lesson = {
    id: "stick",
    figures: [{
        program, sets: "length",
        slider: { unit: "px", low: 40, high: 190, step: 1, value: 130 },
        reading: ({ error = 0, stretch = 0 }, { reading = "" }) => reading.replace("{error}", error.toFixed(2)).replace("{stretch}", percent(Math.abs(stretch))),
        challenge: ({ stretch = 0 }) => stretch > 0.5,
    }],
};
