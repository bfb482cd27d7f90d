import { Canvas2DPainter, load } from "../sinew/index.js";
import { byItself, Link, Peer, scene } from "./game.js";

const of = (id) => document.getElementById(id);
const keys = [{ left: "KeyA", right: "KeyD", up: "KeyW" }, { left: "ArrowLeft", right: "ArrowRight", up: "ArrowUp" }];
const pressed = new Set(), touched = [false, false]; // players who have used their keys

addEventListener("keydown", (event) => {
    const player = keys.findIndex((names) => Object.values(names).includes(event.code));
    if (player < 0 || event.target instanceof HTMLInputElement) return;
    touched[player] = true;
    pressed.add(event.code);
    event.preventDefault();
});
addEventListener("keyup", (event) => pressed.delete(event.code));
addEventListener("blur", () => pressed.clear());

function inputOf(player, step) {
    if (!touched[player]) return byItself(player, step);
    const { left, right, up } = keys[player];
    return { walk: Number(pressed.has(right)) - Number(pressed.has(left)), jumps: pressed.has(up) };
}

const engine = await load();
const panes = ["one", "two"].map((name) => ({ canvas: of(name), painter: new Canvas2DPainter(of(name).getContext("2d")), state: of(`state-${name}`) }));
let peers = [], link, tick = 0, compared = 0;

/** Both players begin from the bytes of one world. */
function begin() {
    for (const peer of peers) peer.dispose();
    const world = engine.open(scene), bytes = world.save();
    world.dispose();
    peers = [new Peer(engine, bytes, 0), new Peer(engine, bytes, 1)];
    link = new Link(7);
    tick = compared = 0;
    setLink();
}

function setLink() {
    link.slowest = Number(of("slowest").value), link.loss = Number(of("loss").value) / 100;
    of("slowest-told").textContent = `${link.slowest} frames`;
    of("loss-told").textContent = `${of("loss").value} %`;
}

function advance() {
    for (const peer of peers) {
        peer.receive(tick);
        peer.step(inputOf(peer.own, peer.now));
    }
    const [one, two] = peers;
    link.carry(one, two, tick);
    link.carry(two, one, tick);
    ++tick;
}

/** Compares both worlds once a second, before the latest step that both have all inputs of. */
function compare() {
    const step = Math.min(...peers.map(({ confirmed }) => confirmed));
    if (step < compared + 60) return;
    const [one, two] = peers.map((peer) => peer.hashBefore(step));
    if (!one || !two) return;
    compared = step;
    of("verdict").textContent = one === two ? `After ${step} steps both have the hash ${one}.` : `After ${step} steps the worlds differ: ${one}, ${two}.`;
}

function paint() {
    peers.forEach((peer, player) => {
        const { canvas, painter, state } = panes[player];
        painter.paint(peer.simulation.draw(canvas.width, canvas.height));
        state.textContent = `Step ${peer.now}, ${peer.repeated} taken again.`;
    });
}

let last = performance.now(), owed = 0;
function frame(now) {
    owed = Math.min(owed + (now - last) * 60 / 1000, 6); // steps
    last = now;
    for (; owed >= 1; --owed) advance();
    compare();
    paint();
    requestAnimationFrame(frame);
}

for (const name of ["slowest", "loss"]) of(name).addEventListener("input", setLink);
of("again").addEventListener("click", begin);
begin();
requestAnimationFrame(frame);
Object.defineProperty(globalThis, "rollback", { get: () => ({ peers, compared }) }); // for the browser's console
