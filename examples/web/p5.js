// A curtain of soft strings in p5: the mouse strokes them, a click cuts.
import p5 from "p5";
import { load } from "sinew";
import { Clock } from "./clock.js";

const engine = await load();
const strings = 40;
const simulation = engine.open({
    sinew: 1,
    units: { length: "px", up: "-y" },
    world: { gravity: [0, 700], damping: 0.8 },
    colliders: [{ name: "hand", shape: "sphere", radius: 45, at: [-200, 300] }],
    figures: Array.from({ length: strings }, (_, i) => ({ prefab: "rope", name: `string_${i}`, at: [60 + i * 18, 30], length: 430, segments: 30, weight: 0.5 })),
});
const rows = Array.from({ length: strings }, (_, i) => simulation.rowsOf(`string_${i}`).slice());

new p5((p) => {
    const clock = new Clock();
    let before = /** @type {[number, number]} */ ([-200, 330]);

    p.setup = () => {
        p.createCanvas(820, 560);
        p.colorMode(p.HSB, 360, 100, 100);
        p.noFill();
        p.strokeWeight(5);
    };

    p.draw = () => {
        const isOver = p.mouseX > 0 && p.mouseY > 0;
        const sweep = 410 + 420 * Math.sin(p.millis() / 2000);
        const target = isOver ? [p.mouseX, p.mouseY] : [sweep, 330]; // moves by itself until there is a mouse
        const hand = /** @type {[number, number]} */ ([p.lerp(before[0], target[0], 0.15), p.lerp(before[1], target[1], 0.15)]);
        if (p.mouseIsPressed) simulation.cut(before, hand);
        simulation.moveCollider("hand", hand);
        before = hand;
        clock.advance(simulation, p.deltaTime / 1000);

        p.background(40, 3, 96);
        const { positions } = simulation;
        for (const [i, string] of rows.entries()) {
            p.stroke((i * 300) / strings, 65, 78);
            p.beginShape();
            for (const row of string) p.vertex(positions[2 * row], positions[2 * row + 1]);
            p.endShape();
        }
        p.stroke(0, 0, 40);
        p.circle(hand[0], hand[1], 80);
    };
});
