// The package's entry: see index.d.ts for what there is, and README.md for how to begin.
import { Engine, abi } from "./engine.js";
import { Exporter } from "./export.js";
import { Importer } from "./import.js";
import { SceneErrors, SinewError, status } from "./errors.js";
import { Canvas2DPainter } from "./painters/canvas2d.js";
import { WebGL2Painter } from "./painters/webgl2.js";
import { PictureCopy, Shape } from "./picture.js";
import { isNode, nodeModule } from "./platform.js";
import { startThreads } from "./threads.js";

/** The module of a source, compiled. */
async function compiled(source) {
    const given = await source;
    if (given instanceof WebAssembly.Module) return given;
    if (given instanceof ArrayBuffer || ArrayBuffer.isView(given)) return WebAssembly.compile(given);
    if (typeof Response !== "undefined" && given instanceof Response) return fromResponse(given);
    const url = new URL(given, globalThis.location?.href ?? import.meta.url);
    if (isNode && url.protocol === "file:") {
        const { readFile } = await nodeModule("fs/promises");
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

const modules = {
    double: [new URL("./sinew.wasm", import.meta.url), new URL("./sinew-threads.wasm", import.meta.url)],
    float: [new URL("./sinew-float.wasm", import.meta.url), new URL("./sinew-float-threads.wasm", import.meta.url)],
    export: [new URL("./sinew-export.wasm", import.meta.url)],
    import: [new URL("./sinew-import.wasm", import.meta.url)],
};

/** Threads share memory; a page may do so if it is cross-origin isolated, Node always. */
const mayShareMemory = () => typeof SharedArrayBuffer !== "undefined" && (isNode || globalThis.crossOriginIsolated);

async function loadOf(precision, source, { threads = 1 } = {}) {
    const count = mayShareMemory() ? threads : 1;
    const module = await compiled(source ?? modules[precision][count > 1 ? 1 : 0]);
    const hasMemory = !WebAssembly.Module.imports(module).some(({ kind }) => kind === "memory");
    const engine = hasMemory ? new Engine(await WebAssembly.instantiate(module, {})) : await startThreads(module, count);
    return Object.assign(engine, { module });
}

export async function load(source, options) {
    return loadOf("double", source, options);
}

export async function loadFloat(engine, source) {
    engine.float ??= await loadOf("float", source, { threads: engine.threads });
    return engine;
}

export async function loadExporter(source) {
    return new Exporter(await loadOf("export", source));
}

export async function loadImporter(source) {
    return new Importer(await compiled(source ?? modules.import[0]));
}

export async function catalogue() {
    return (await import("./catalogue.js")).scenes;
}

export { abi, Canvas2DPainter, Exporter, Importer, PictureCopy, SceneErrors, Shape, SinewError, status, WebGL2Painter };
export default { load, loadFloat, loadExporter, loadImporter, abi, catalogue, Canvas2DPainter };
