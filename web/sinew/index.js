// The package's entry: see index.d.ts for what there is, and README.md for how to begin.
import { Engine, abi } from "./engine.js";
import { SceneErrors, SinewError, status } from "./errors.js";
import { Canvas2DPainter } from "./painters/canvas2d.js";
import { WebGL2Painter } from "./painters/webgl2.js";
import { PictureCopy, Shape } from "./picture.js";

const isNode = typeof process !== "undefined" && Boolean(process.versions?.node);

/** The module of a source, compiled. */
async function compiled(source) {
    const given = await source;
    if (given instanceof WebAssembly.Module) return given;
    if (given instanceof ArrayBuffer || ArrayBuffer.isView(given)) return WebAssembly.compile(given);
    if (typeof Response !== "undefined" && given instanceof Response) return fromResponse(given);
    const url = new URL(given, globalThis.location?.href ?? import.meta.url);
    if (isNode && url.protocol === "file:") {
        const { readFile } = await import("node:fs/promises");
        return WebAssembly.compile(await readFile(url));
    }
    return fromResponse(await fetch(url));
}

/** Servers that name another type than application/wasm cannot stream. */
async function fromResponse(response) {
    if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
    const streams = response.headers.get("content-type")?.startsWith("application/wasm");
    return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

export async function load(source = new URL("./sinew.wasm", import.meta.url)) {
    return new Engine(await WebAssembly.instantiate(await compiled(source), {}));
}

export async function loadFloat(engine, source = new URL("./sinew-float.wasm", import.meta.url)) {
    engine.float ??= await load(source);
    return engine;
}

export async function catalogue() {
    return (await import("./catalogue.js")).scenes;
}

export { abi, Canvas2DPainter, PictureCopy, SceneErrors, Shape, SinewError, loadFloat, status, WebGL2Painter };
export default { load, loadFloat, abi, catalogue, Canvas2DPainter };
