import { pixels, type Lesson } from "../lesson.js";

const arm = (name: string, color: string, shift: number): object => ({
    name, at: [320, 130],
    particles: { top: { at: [0, 0], pinned: true, size: 12 }, knee: { at: [110, -30], mass: 1, size: 18 }, foot: { at: [200 + shift, -95], mass: 1, size: 26 } },
    constraints: [{ name: "upper", between: ["top", "knee"], rest: 114.0175425099138 }, { name: "lower", between: ["knee", "foot"], rest: 111.0180165558726 }],
    looks: { upper: { color, width: 6 }, lower: { color, width: 6 }, knee: { color }, foot: { color }, top: { color: "#8b8474" } },
});

const shiftOf = (value: number): number => (value >= 0 ? 0 : 10 ** value);

/** A number as an exponent is written. */
const raised = (value: number): string => String(value).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]!);

export const determinism: Lesson = {
    id: "determinism",
    title: "The same, to the last bit",
    before: [
        `Here are <em>two</em> double pendulums, a red one before a blue one. They start in the same place, to the last bit, and you see only one. Move the slider to let the blue one start a tiny bit to the side: a millionth of a millionth of a pixel, say.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            world: { gravity: [0, 900] },
            solver: { precision: "double" },
            figures: [arm("blue", "#3f6fb5", shiftOf(value)), arm("red", "#e4572e", 0)],
            traces: [{ of: "blue/foot", seconds: 1 }, { of: "red/foot", seconds: 1 }],
        }),
        slider: { label: "the blue one starts to the side by", low: -13, high: 0, step: 1, value: 0, words: (value) => (value >= 0 ? "nothing" : `10${raised(value)} px`) },
        restarts: true,
        repeats: 60,
        reading: (simulation) => {
            const at = simulation.positions, half = at.length / 2;
            const apart = Math.hypot((at[4] ?? 0) - (at[half + 4] ?? 0), (at[5] ?? 0) - (at[half + 5] ?? 0));
            return `${simulation.report().steps} steps; ${apart === 0 ? "not apart at all" : `${apart.toExponential(1)} px apart`}; hash ${simulation.hash()}`;
        },
        task: "With 10⁻¹³ px, when do you see two? And with 10⁻⁶? Press restart: do they ever do something else?",
        code: () => `simulation.restart();
simulation.step(600);
const first = simulation.hash();   // one number over the whole state
simulation.restart();
simulation.step(600);
console.assert(simulation.hash() === first); // here, and on every machine`,
    },
    after: [
        `A double pendulum is chaotic: a difference grows tenfold about every half second, until nothing is the same. So if two computers differed in the last bit of a single square root, they would soon show another scene. Yet a scene of Sinew ends
         with the same bits on a phone and on a server, with one thread or eight.`,
        `The price is care: sums in the same order always, no sine from the operating system, and no “fast” arithmetic. The prize: a replay is a list of what was pressed, a bug can be sent in a message, and the address of a scene is enough to show another what you saw.`,
    ],
    questions: [["Is the difference not just rounding?", "It is. Rounding is not random, though: IEEE 754 says what every +, −, ×, ÷ and square root must give, to the last bit. Only order and shortcuts differ, and those a program can choose."]],
    source: "Lorenz 1963; IEEE 754; Box2D's and Jolt's notes on determinism.",
};
