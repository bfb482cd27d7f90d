// A rope in plain JavaScript with the shape of the package, for laying out the page before the module exists.
const files = import.meta.glob("../scenes/*.json", { query: "?raw", import: "default", eager: true });
export const abi = 1;
export const Shape = { polyline: 0, loop: 1, disc: 2, polygon: 3, image: 4, text: 5, pane: 6 };
const params = [
  { path: "world.gravity", name: "gravity", value: [0, 0.27], type: "point", unit: "px/frame^2", help: "Acceleration of gravity" },
  { path: "world.damping", name: "damping", value: 0.003, type: "number", unit: "", low: 0, high: 1e6, help: "Damping" },
  { path: "solver.substeps", name: "substeps", value: 0, type: "integer", unit: "a step", low: 0, high: 1000, help: "Substeps of a step" },
  { path: "solver.direct", name: "direct", value: "auto", type: "text", unit: "", choices: ["auto", "on", "off"], help: "Direct solution" },
  { path: "figures.rope.length", name: "length", value: 300, type: "number", unit: "px", low: 1e-4, high: 1e8, help: "Length along the rope" },
  { path: "figures.rope.mass", name: "mass", value: 4, type: "number", unit: "kg", low: 1e-6, high: 1e9, help: "Mass of the rope" }];
export async function catalogue() {
  return Object.entries(files).map(([p, text]) => { const o = JSON.parse(text); const name = p.match(/(\w+)\.json/)[1];
    return { name, title: name[0].toUpperCase() + name.slice(1).replaceAll("_", " "), about: o.about, source: o.source, category: o.category, dimension: o.dimension || 2,
      seconds: o.seconds || 8, models: {}, size: o.view?.size || [640, 480], parameters: params, modes: ["physical", "classic"], text, images: {} }; });
}
export class SceneErrors extends Error { constructor(errors) { super("scene"); this.errors = errors; } }
function check(scene) { if (typeof scene !== "string") return []; try { JSON.parse(scene); return []; } catch (e) { return [{ line: 2, column: 3, length: 4, path: "", message: String(e.message), help: "", source: "scene.json", isOverride: false, text: "" }]; } }
class Rope {
  constructor(scene, o) { const e = check(scene); if (e.length) throw new SceneErrors(e); this.text = typeof scene === "string" ? scene : JSON.stringify(scene, null, 2); this.size = JSON.parse(this.text).view?.size || [640, 480]; this.seed = this.text.length; this.restart(); }
  restart() { this.n = 20; this.t = 0; this.x = []; this.p = []; const a = this.seed % 7 / 3; for (let i = 0; i < this.n; i++) { this.x.push([320 + i * 14 * Math.cos(a), 40 + i * 14 * Math.sin(a)]); } this.p = this.x.map(v => [...v]); }
  step(c = 1) { while (c--) { this.t++; for (let i = 1; i < this.n; i++) { const [x, y] = this.x[i], [a, b] = this.p[i]; this.p[i] = [x, y]; this.x[i] = [x + (x - a) * .998, y + (y - b) * .998 + .27]; }
    for (let k = 0; k < 30; k++) for (let i = 1; i < this.n; i++) { const a = this.x[i - 1], b = this.x[i], d = [b[0] - a[0], b[1] - a[1]], l = Math.hypot(...d), s = (l - 14) / l * (i === 1 ? 1 : .5); b[0] -= d[0] * s; b[1] -= d[1] * s; if (i > 1) { a[0] += d[0] * s; a[1] += d[1] * s; } }
    if (this.held) this.x[this.held.i] = [...this.held.at]; } }
  dispose() {} copy() { return this; } get particleCount() { return this.n; } get constraintCount() { return 19; }
  hash() { return "0123456789abcdef"; } events() { return []; } report() { return { seconds: this.t / 60, steps: this.t, kinetic: 5 + 4 * Math.sin(this.t / 20), potential: 9 - 4 * Math.sin(this.t / 20), stored: 1, energyLost: 0, stretchMax: .0012 * (1 + Math.sin(this.t / 9)), stretchMean: .0003, maxSpeed: 4 }; }
  draw(w = 640, h = 480) { const s = Math.min(w / 640, h / 480); return { width: w, height: h, s, dark: this.theme === "dark", x: this.x.map(v => v.map(c => c * s)) }; }
  runUntil(s) { while (this.t < s * 60) this.step(); }
  parameters() { return params; } sceneText() { return this.text; } figures() { return []; }
  get rate() { return 60; } get seconds() { return 8; } get positions() { return new Float64Array(this.x.flat()); } get dimension() { return 2; } 
}
export class Canvas2DPainter { constructor(c) { this.c = c; } setImage() {} dispose() {}
  paint(p) { const c = this.c; c.setTransform(1, 0, 0, 1, 0, 0); c.fillStyle = p.dark ? "#1b1e27" : "#faf6ec"; c.fillRect(0, 0, p.width, p.height); c.lineWidth = 9 * p.s; c.lineJoin = c.lineCap = "round"; c.strokeStyle = "#d9481f"; c.beginPath(); for (const [x, y] of p.x) c.lineTo(x, y); c.stroke(); c.beginPath(); c.fillStyle = "#3f6fb5"; c.arc(...p.x.at(-1), 24 * p.s, 0, 7); c.fill(); } }
class Player {
  constructor(scene, o) { this.simulation = new Rope(scene, o); this.s = { step: 0, firstStep: 0, endStep: 0, timeScale: 1, share: 0, isPaused: false, panes: 1, isEdited: false, isHolding: false, overlays: [], tool: "grab", theme: "light", hovered: "", selected: "", message: "", undo: "", redo: "" }; this.w = 640; this.h = 480; this.acc = 0; this.m = [0, 0]; }
  pane() { return this.simulation; } dispose() { this.isClosed = true; } open(s, o) { this.simulation = new Rope(s, o); this.s.step = this.s.endStep = 0; } become(s, o) { this.open(s, o); this.s.undo = "text"; }
  resize(w, h) { this.w = w; this.h = h; } advance(t) { if (this.s.isPaused) return; this.acc += t * 60 * this.s.timeScale; while (this.acc >= 1) { this.acc--; this.simulation.step(); this.s.step++; this.s.endStep = this.s.step; } }
  draw() { this.simulation.theme = this.s.theme; return this.simulation.draw(this.w, this.h); }
  pt() { const s = Math.min(this.w / 640, this.h / 480); return this.m.map(v => v / s); }
  pointerMove(x, y) { this.m = [x, y]; if (this.simulation.held) this.simulation.held.at = this.pt(); }
  pointerDown() { const p = this.pt(); let b = 0, d = 1e9; this.simulation.x.forEach((v, i) => { const e = Math.hypot(v[0] - p[0], v[1] - p[1]); if (e < d) d = e, b = i; }); if (d < 60) { this.simulation.held = { i: b, at: p }; this.s.isHolding = true; } }
  pointerUp() { this.simulation.held = null; this.s.isHolding = false; } pointerLeave() {} wheel() {} pinch() {} key() {} pan() {} orbit() {} zoom() {}
  touch(f, ph, x, y) { this.pointerMove(x, y); if (ph === "down") this.pointerDown(); if (ph === "up") this.pointerUp(); }
  do(a) { if (a === "pause") this.s.isPaused = !this.s.isPaused; if (a === "restart") this.restart(); if (a === "step") this.step(); if (a === "split") this.s.panes = 3 - this.s.panes; } pause(on = true) { this.s.isPaused = on; } step() { this.simulation.step(); this.s.isPaused = true; } stepBack() {} restart() { this.simulation.restart(); this.s.step = this.s.endStep = 0; } undo() {} redo() {} goTo() {} setTimeScale(s) { this.s.timeScale = s; } setTool(t) { this.s.tool = t; } setPrefab() {} setOverlays(o) { this.s.overlays = o; } setTheme(t) { this.s.theme = t; }
  parameters() { return params; } set(path, v) { params.find(p => p.path === path).value = v; this.s.isEdited = true; } sceneText() { return this.simulation.text; } hash() { return "0123456789abcdef"; } state() { return { ...this.s }; } events() { return []; }
}
const tools = "grab a,pin n,cut x,rope d,polygon f,cloth l,spawn i,remove delete,measure m".split(",").map(t => { const [name, key] = t.split(" "); return { name, key, about: "what the tool does" }; });
export async function load() { return { version: "0.9.0", abi: 1, simd: "simd128", open: (s, o) => new Rope(s, o), play: (s, o) => new Player(s, o), check, schema: () => ({}), prefabs: () => [{ name: "box", about: "A crate", parameters: [] }], overlays: () => ["strain", "tension", "pins", "names", "forces", "contacts"].map(name => ({ name, about: name })), tools: () => tools, actions: () => [{ name: "pause", key: "p", about: "pause, and go on" }], bytes: 1e6 }; }
export default { load, abi, catalogue, Canvas2DPainter };
