// Ragdolls on stairs in PixiJS: every limb is a line of a Graphics. The mouse throws them about.
import { Application, Graphics } from "pixi.js";
import { load } from "sinew";
import { Clock } from "./clock.js";

const [width, height] = [900, 600];
const stairs = Array.from({ length: 6 }, (_, i) => ({ at: [75 + 150 * i, 330 + 50 * i], size: [150, 560] }));

const engine = await load();
const simulation = engine.open({
    sinew: 1,
    units: { length: "px", up: "-y" }, // a metre is 100 px
    world: { gravity: [0, 981], bounds: { box: [[0, -2000], [width, height]], friction: 0.5 } },
    colliders: stairs.map(({ at, size }) => ({ shape: "box", at: [at[0], at[1] + size[1] / 2], size, friction: 0.4 })),
    figures: [0, 1, 2, 3].map((i) => ({ prefab: "ragdoll", name: `man_${i}`, at: [110 + 130 * i, 120 - 40 * i], turn: 20 * i, contact: { figures: true } })),
});

const app = new Application();
await app.init({ width, height, background: 0xf5f3ee, antialias: true });
document.body.append(app.canvas);
const ground = new Graphics(), men = new Graphics();
for (const { at, size } of stairs) ground.rect(at[0] - size[0] / 2, at[1], size[0], size[1]).fill(0x5a6478);
app.stage.addChild(ground, men);

const colors = [0xd2463c, 0x2f7d6b, 0xd98e2b, 0x4a5fa8];
function draw() {
    const { positions, ends, radii, figureIndices } = simulation;
    men.clear();
    for (let i = 0; i < ends.length; i += 2) {
        const [a, b] = [ends[i], ends[i + 1]];
        men.moveTo(positions[2 * a], positions[2 * a + 1]).lineTo(positions[2 * b], positions[2 * b + 1]);
        men.stroke({ width: 2 * Math.max(3, Math.min(radii[a], radii[b])), color: colors[figureIndices[a] % 4], cap: "round" });
    }
    for (let row = 0; row < radii.length; ++row)
        men.circle(positions[2 * row], positions[2 * row + 1], Math.max(3, radii[row])).fill(colors[figureIndices[row] % 4]);
}

/** @type {(event: PointerEvent) => [number, number]} */
const place = ({ offsetX, offsetY }) => [offsetX, offsetY];
app.canvas.addEventListener("pointerdown", (event) => simulation.grab(place(event), 40));
app.canvas.addEventListener("pointermove", (event) => simulation.drag(place(event)));
addEventListener("pointerup", () => simulation.letGo());

const clock = new Clock();
app.ticker.add(({ elapsedMS }) => {
    clock.advance(simulation, elapsedMS / 1000);
    draw();
});
