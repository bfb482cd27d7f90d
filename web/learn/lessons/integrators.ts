import { pixels, type Lesson } from "../lesson.js";

const methods: [name: string, x: number, y: number, color: string, label: string][] = [
    ["explicit_euler", 107, 92, "#d1495b", "explicit Euler"],
    ["symplectic_euler", 320, 92, "#c77d0a", "symplectic Euler"],
    ["verlet", 533, 92, "#2a7f62", "Verlet"],
    ["velocity_verlet", 107, 292, "#2b6cb0", "velocity Verlet"],
    ["rk4", 320, 292, "#7d5ba6", "Runge-Kutta 4"],
];

export const integrators: Lesson = {
    id: "integrators",
    title: "Five ways to take a step",
    before: [
        `Nothing forces you to step like that. Here are five planets on the same orbit, each moved by another rule, with rather few steps a round.
         Below each is its energy, which in nature would be a level line.`,
    ],
    figure: {
        scene: (value) => ({
            ...pixels,
            solver: { mode: "classic", rate: value },
            world: { forces: methods.map(([figure, x, y]) => ({ force: "attractor", figure, center: [x, y], strength: 1100000, softness: 2 })) },
            figures: methods.map(([name, x, y, color]) => ({
                name, at: [x, y], integrator: name,
                particles: { sun: { at: [0, 0], pinned: true, size: 16 }, planet: { at: [57, 0], velocity: [0, 130], size: 11 } },
                looks: { sun: { color: "#f2b134" }, planet: { color } },
            })),
            traces: methods.flatMap(([name, x, y, , label]) => [
                { of: `${name}/planet`, seconds: 6 },
                { of: `${name}/planet`, shows: "energy", label, box: [[x - 92, y + 74], [x + 92, y + 100]], low: -26000, high: 4000 },
            ]).concat(methods.map(([name]) => ({ of: `${name}/planet`, shows: "energy", label: "all five", box: [[441, 222], [625, 392]], low: -26000, high: 4000 }))),
        }),
        slider: { label: "steps a second", low: 8, high: 120, step: 1, value: 20 },
        restarts: true,
        repeats: 24,
        task: "Fewer steps make each rule show its character. How few can Verlet live with?",
        code: () => `// explicit Euler       x += v*dt;              v += a(x)*dt;
// symplectic Euler     v += a(x)*dt;           x += v*dt;
// Verlet               [x, old] = [2*x - old + a(x)*dt*dt, x];
// velocity Verlet      v += a(x)*dt/2;  x += v*dt;  v += a(x)*dt/2;
// Runge-Kutta 4        asks for a(x) at four places and takes their mean`,
    },
    after: [
        `<b>Explicit Euler</b> is what everybody writes first, and the only bad one: it gains energy in each round and leaves. Swap its two lines and
         you have <b>symplectic Euler</b>, which stays for ever. <b>Both Verlets</b> swing about the right energy and never drift. <b>Runge-Kutta</b> is the most exact
         over a few rounds, at four times the work, but loses a little each time, and a little for ever is a lot.`,
        `Symplectic Euler and Verlet trace almost the same orbits: one stores the velocity, the other the place before.`,
    ],
    questions: [["Which one should I use in a game?", `Verlet, if things are tied together, because then you will want to move points by hand. Symplectic Euler otherwise. Both with steps of
        the same length.`]],
    source: "Hairer, Lubich and Wanner, Geometric Numerical Integration, 2002.",
};
