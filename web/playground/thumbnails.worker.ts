import { Canvas2DPainter, load, type CatalogueScene, type OpenOptions, type Player, type Simulation } from "../sinew/index.js";
import { context2d } from "../common/context.js";
import { Assets, type Loaded } from "../common/engine.js";

export type Order =
    | { order: "begin"; scenes: CatalogueScene[]; module: WebAssembly.Module }
    | { order: "open"; name: string; canvas: OffscreenCanvas }
    | { order: "see"; name: string; visible: boolean }
    | { order: "prefer"; name: string }
    | { order: "run"; on: boolean; theme: string; still: boolean };

/** One live picture. */
interface Thumbnail {
    name: string;
    canvas: OffscreenCanvas;
    painter: Canvas2DPainter;
    simulation: Simulation | null;
    /** Both modes beside each other, while the pointer is on the picture. */
    both: Player | null;
    theme: string;
    visible: boolean;
    scene: CatalogueScene | null;
    /** Simulated seconds since the start. */
    time: number;
    drawnAt: number;
    /** Milliseconds that a frame took lately. */
    cost: number;
}

const begins = 1.2; // seconds: the first picture of a scene, when something has happened already
const slice = 8; // milliseconds of work before the page gets its turn
const tick = 33; // milliseconds between slices

const thumbnails = new Map<string, Thumbnail>();
interface Begun extends Loaded {
    scenes: CatalogueScene[];
}
let begin: (begun: Promise<Begun>) => void = () => {};
const loading = new Promise<Begun>((resolve) => (begin = resolve));

/** The catalogue and the module come from the page, which has them already. */
async function begun(scenes: CatalogueScene[], module: WebAssembly.Module): Promise<Begun> {
    return { engine: await load(module), scenes, assets: new Assets() };
}
let isRunning = false, isStill = false, isQueued = false, theme = "light", preferred = "";

self.addEventListener("message", ({ data }: MessageEvent<Order>) => {
    if (data.order === "begin") begin(begun(data.scenes, data.module));
    if (data.order === "open") open(data);
    if (data.order === "see") {
        const known = thumbnails.get(data.name);
        if (known) known.visible = data.visible;
    }
    if (data.order === "prefer") prefer(data.name);
    if (data.order === "run") [isRunning, isStill, theme] = [data.on, data.still, data.theme];
    queue();
});

function open({ name, canvas }: Order & { order: "open" }): void {
    const painter = new Canvas2DPainter(context2d(canvas), { font: "system-ui, sans-serif" });
    thumbnails.set(name, { name, canvas, painter, scene: null, simulation: null, both: null, theme: "", visible: true, time: 0, drawnAt: 0, cost: 1 });
}

/** The picture under the pointer shows classic mode beside physical mode, from the start. */
function prefer(name: string): void {
    const before = thumbnails.get(preferred);
    before?.both?.dispose();
    if (before) before.both = null;
    preferred = name;
}

function queue(): void {
    if (isQueued || !isRunning) return;
    isQueued = true;
    setTimeout(work, tick);
}

async function work(): Promise<void> {
    const until = performance.now() + slice;
    let goesOn = true;
    while (goesOn && performance.now() < until) goesOn = await advanceOne();
    isQueued = false;
    if (![...thumbnails.values()].some((one) => one.visible && due(one) > 0)) {
        if (!isStill && isRunning) setTimeout(queue, 2 * tick);
        return;
    }
    queue();
}

/** How much a thumbnail waits for a frame: milliseconds since its last one, in units of what it should have. */
function due(one: Thumbnail): number {
    if (one.theme !== theme || !one.simulation) return 1e9 - one.cost;
    if (isStill) return 0;
    const period = thumbnails.get(preferred) === one ? 16 : Math.max(33, one.cost * 12);
    return Math.max((performance.now() - one.drawnAt) / period - 1, 0);
}

async function advanceOne(): Promise<boolean> {
    let most: [string, Thumbnail] | null = null;
    for (const entry of thumbnails) if (entry[1].visible && due(entry[1]) > (most ? due(most[1]) : 0)) most = entry;
    if (!most) return false;
    const [name, one] = most;
    const begun = performance.now();
    if (!one.simulation || one.theme !== theme) await start(one);
    else await advance(one, Math.min((begun - one.drawnAt) / 1000, 0.12));
    one.drawnAt = performance.now();
    one.cost = one.cost * 0.8 + (one.drawnAt - begun) * 0.2;
    self.postMessage({ drawn: name, modes: one.both ? 2 : 1 });
    return true;
}

async function start(one: Thumbnail): Promise<void> {
    const { engine, scenes, assets } = await loading;
    one.scene ??= scenes.find(({ name }) => name === one.name) ?? null;
    if (!one.scene) return;
    await assets.prepare(one.scene.text);
    await assets.giveTo(one.painter, one.scene.text);
    one.simulation?.dispose();
    one.simulation = engine.open(one.scene.text, optionsOf(one.scene.text, assets));
    one.theme = theme;
    one.time = Math.max(one.time, begins);
    one.simulation.runUntil(one.time);
    paint(one);
}

const optionsOf = (text: string, assets: Assets): OpenOptions => ({ ...assets.optionsOf(text), overrides: theme === "dark" ? ["view.theme=dark"] : [] });

async function startBoth(one: Thumbnail, scene: CatalogueScene): Promise<void> {
    const { engine, assets } = await loading;
    if (preferred !== one.name || one.both) return;
    one.both = engine.play(scene.text, optionsOf(scene.text, assets));
    one.both.resize(one.canvas.width, one.canvas.height);
    one.both.do("split");
}

function advanceBoth(player: Player, one: Thumbnail, scene: CatalogueScene, seconds: number): void {
    player.advance(seconds);
    if (player.simulation.report().seconds > scene.seconds) player.do("restart");
    one.painter.paint(player.draw());
}

async function advance(one: Thumbnail, seconds: number): Promise<void> {
    if (one.scene && one.name === preferred && !isStill) {
        if (!one.both) await startBoth(one, one.scene);
        if (one.both) return advanceBoth(one.both, one, one.scene, seconds);
    }
    advanceOwn(one, seconds);
}

function advanceOwn(one: Thumbnail, seconds: number): void {
    const { simulation, scene } = one;
    if (!simulation || !scene) return;
    one.time += seconds;
    if (one.time > scene.seconds) {
        simulation.restart();
        one.time = 0;
    }
    simulation.runUntil(one.time);
    paint(one);
}

function paint(one: Thumbnail): void {
    if (one.simulation) one.painter.paint(one.simulation.draw(one.canvas.width, one.canvas.height));
}
