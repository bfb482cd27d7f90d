// Two players in one world, over a link that is late and loses packets. Each guesses what the other does and plays again from the
// step where the guess was wrong. No page and no clock: main.js has these. The same in C++: examples/rollback.cpp.

const crates = Array.from({ length: 8 }, (_, i) => ({
    prefab: "box", name: `crate_${i}`, at: [(i >> 2) - 0.5, 0.3 + 0.6 * (i % 4)], mass: 2, contact: { figures: true },
    looks: { all: { color: "#c9a46a" } },
}));
const ball = (name, x, color) => ({ prefab: "ball", name, at: [x, 0.4], radius: 0.35, mass: 15, contact: { figures: true }, looks: { ball: { color } } });

export const scene = {
    sinew: 1,
    view: { size: [480, 300], center: [0, 2.3], height: 5.2 },
    world: {
        gravity: [0, -9.81],
        bounds: { planes: [{ normal: [0, 1], friction: 0.6 }, { normal: [1, 0], through: [-4, 0], friction: 0.6 }, { normal: [-1, 0], through: [4, 0], friction: 0.6 }] },
    },
    figures: [
        ...crates,
        { prefab: "ragdoll", name: "rider", at: [0, 3.6], mass: 20, pose: "star", contact: { figures: true } },
        ball("one", -3, "#c43d33"), ball("two", 3, "#3366bb"),
    ],
};
const heroes = ["one/ball", "two/ball"];

/** Steps that a player may be ahead of the other's inputs; then the game waits. */
export const window = 20;

/** An input: walk is -1, 0 or 1. */
export const idle = { walk: 0, jumps: false };
const isSame = (a, b) => a.walk === b.walk && a.jumps === b.jumps;

/** One step of a world by the inputs of both players. */
export function play(simulation, inputs) {
    inputs.forEach(({ walk, jumps }, player) => {
        const hero = heroes[player], stands = simulation.stateOf(hero).position[1] < 0.5;
        simulation.applyForce(hero, [250 * walk, 0]);
        if (jumps && stands) simulation.applyImpulse(hero, [0, 75]);
    });
    simulation.step();
}

export class Peer {
    now = 0;            // steps taken
    repeated = 0;       // steps taken again
    mine = [];          // inputs by step
    theirs = [];        // known inputs of the other, by step
    #taken = [];        // inputs of the other with which the steps were taken
    #moments = [];      // the world before each of the last steps
    #mail = [];         // packets under way to this player

    /** `bytes`: a saved world, from which both players begin. */
    constructor(engine, bytes, own) {
        this.own = own;
        this.simulation = engine.load(bytes);
    }

    dispose() {
        for (const simulation of [this.simulation, ...this.#moments]) simulation.dispose();
    }

    /** Number of steps of which all inputs are known. */
    get confirmed() {
        return Math.min(this.now, this.theirs.length);
    }
    /** Hash of the world before a step, one of the last. */
    hashBefore(step) {
        return step === this.now ? this.simulation.hash() : this.#moments[this.#moments.length - (this.now - step)]?.hash();
    }

    /** Takes a step, unless the other is too far behind; false then. */
    step(input) {
        if (this.now >= this.theirs.length + window) return false;
        this.mine.push(input);
        this.#keep();
        this.#play(this.now++);
        return true;
    }

    /** All inputs so far, of which those of the last 40 steps would do. Arrives at a tick. */
    send(other, arrives) {
        other.#mail.push({ arrives, inputs: this.mine.slice() });
    }

    receive(tick) {
        for (const { arrives, inputs } of this.#mail) if (arrives <= tick && inputs.length > this.theirs.length) this.theirs = inputs;
        this.#mail = this.#mail.filter(({ arrives }) => arrives > tick);
        const wrong = this.#taken.findIndex((input, step) => step < this.theirs.length && !isSame(input, this.theirs[step]));
        if (wrong >= 0) this.#playAgain(wrong);
    }

    #keep() {
        this.#moments.push(this.simulation.copy());
        if (this.#moments.length > window + 1) this.#moments.shift().dispose();
    }

    #play(step) {
        this.#taken[step] = this.theirs[step] ?? this.#taken[step - 1] ?? idle; // a guess: as before
        play(this.simulation, this.own === 0 ? [this.mine[step], this.#taken[step]] : [this.#taken[step], this.mine[step]]);
    }

    #playAgain(first) {
        this.#taken.length = first + 1;
        for (const later of this.#moments.splice(this.#moments.length - (this.now - first) + 1)) later.dispose();
        this.simulation.dispose();
        this.simulation = this.#moments.at(-1).copy();
        this.repeated += this.now - first;
        for (let step = first; step < this.now; ++step) {
            if (step > first) this.#keep();
            this.#play(step);
        }
    }
}

/** A link that loses a share of the packets and delays the others, by a seed (mulberry32). */
export class Link {
    loss = 1 / 3;
    slowest = 12; // ticks
    #state;

    constructor(seed) {
        this.#state = seed;
    }
    #random() {
        this.#state = (this.#state + 0x6d2b79f5) | 0;
        let mixed = Math.imul(this.#state ^ (this.#state >>> 15), 1 | this.#state);
        mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
        return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
    }
    carry(from, to, tick) {
        const isLost = this.#random() < this.loss, delay = 1 + Math.floor(this.#random() * this.slowest);
        if (!isLost) from.send(to, tick + delay);
    }
}

/** What a player does who is nobody: towards the other, now and then back, and a jump every 50 steps. */
export function byItself(player, step) {
    const turn = Math.imul(Math.floor(step / 15) + 7 * player, 0x9e3779b1) >>> 30; // 0 to 3
    return { walk: (player === 0 ? 1 : -1) * [1, 1, 0, -1][turn], jumps: step % 50 === 10 * player };
}
