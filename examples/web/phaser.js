// A plugin for Phaser 3: each scene of the game has `this.sinew`, with a simulation that steps with the scene and ends with it.
// The scene below uses it: rectangles of Phaser hang from ropes.
import Phaser from "phaser";
import { load } from "sinew";
import { Clock } from "./clock.js";

const engine = await load();

class SinewPlugin extends Phaser.Plugins.ScenePlugin {
    /** @type {import("sinew").Simulation | undefined} */
    simulation;
    clock = new Clock();
    /** @type {{ object: Phaser.GameObjects.Rectangle, particle: import("sinew").ParticleId, from: import("sinew").ParticleId }[]} */
    followers = [];
    /** @type {Phaser.GameObjects.Graphics | undefined} */
    lines;

    boot() {
        const events = this.scene?.events;
        events?.on("update", (/** @type {number} */ _, /** @type {number} */ milliseconds) => this.update(milliseconds / 1000));
        events?.on("shutdown", () => this.close());
        events?.once("destroy", () => this.close());
    }
    /**
     * Opens a world; sprites follow its particles after `attach`.
     * @param {object} description
     */
    open(description) {
        this.close();
        this.simulation = engine.open(description);
        this.clock = new Clock();
        this.followers = [];
        this.lines = this.scene?.add.graphics();
        return this.simulation;
    }
    /**
     * A game object goes where a particle is, turned as the line from another one.
     * @param {Phaser.GameObjects.Rectangle} object
     * @param {string} particle
     */
    attach(object, particle, from = particle) {
        const { simulation } = this;
        if (simulation) this.followers.push({ object, particle: simulation.particle(particle), from: simulation.particle(from) });
    }
    /** @param {number} seconds */
    update(seconds) {
        if (!this.simulation) return;
        this.clock.advance(this.simulation, seconds);
        for (const { object, particle, from } of this.followers) {
            const [x, y] = this.simulation.stateOf(particle).position, [u, v] = this.simulation.stateOf(from).position;
            object.setPosition(x, y);
            if (from !== particle) object.setRotation(Math.atan2(y - v, x - u) - Math.PI / 2);
        }
        this.draw();
    }
    draw() {
        const { lines, simulation } = this;
        if (!lines || !simulation) return;
        const { positions, ends } = simulation;
        lines.clear().lineStyle(5, 0x8a5a32);
        for (let i = 0; i < ends.length; i += 2) {
            const [a, b] = [ends[i], ends[i + 1]];
            lines.lineBetween(positions[2 * a], positions[2 * a + 1], positions[2 * b], positions[2 * b + 1]);
        }
    }
    close() {
        this.simulation?.dispose();
        this.simulation = undefined;
    }
}

class Yard extends Phaser.Scene {
    /** By the plugin's mapping. @type {SinewPlugin} */
    // @ts-ignore: Phaser sets it
    sinew;

    create() {
        const ropes = [180, 340, 500, 660];
        const simulation = this.sinew.open({
            sinew: 1,
            units: { length: "px", up: "-y" },
            world: { gravity: [0, 981], damping: 0.2, bounds: { box: [[0, -500], [840, 600]], friction: 0.5 } },
            figures: ropes.map((x, i) => ({ prefab: "rope", name: `rope_${i}`, at: [x, 60], length: 220 + 40 * i, segments: 14, weight: 5, angle: 40 })),
        });
        for (const [i, color] of [0xd2463c, 0x2f7d6b, 0xd98e2b, 0x4a5fa8].entries())
            this.sinew.attach(this.add.rectangle(0, 0, 56, 56, color).setOrigin(0.5, 0.2), `rope_${i}/end`, `rope_${i}/particle_13`);
        this.input.on("pointerdown", (/** @type {Phaser.Input.Pointer} */ { worldX, worldY }) => simulation.grab([worldX, worldY], 60));
        this.input.on("pointermove", (/** @type {Phaser.Input.Pointer} */ { worldX, worldY }) => simulation.drag([worldX, worldY]));
        this.input.on("pointerup", () => simulation.letGo());
    }
}

new Phaser.Game({
    width: 840,
    height: 600,
    backgroundColor: "#f5f3ee",
    banner: false,
    audio: { noAudio: true },
    plugins: { scene: [{ key: "Sinew", plugin: SinewPlugin, mapping: "sinew" }] },
    scene: Yard,
});
