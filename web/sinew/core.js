// Loading, whatever the modules are: files beside the package (index.js) or bytes in it (inline.js).
import { Engine } from "./engine.js";
import { Exporter } from "./export.js";
import { Importer } from "./import.js";
import { isNode, nodeModule } from "./platform.js";

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
    if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`, { cause: response });
    const streams = response.headers.get("content-type")?.startsWith("application/wasm");
    return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** Threads share memory; a page may do so if it is cross-origin isolated, Node always. */
const mayShareMemory = () => typeof SharedArrayBuffer !== "undefined" && (isNode || globalThis.crossOriginIsolated);

/**
 * Functions that load engines. `sourceOf(name, hasThreads)` gives the module "double", "float", "export" or "import", and
 * `startThreads` an engine on shared memory; without it there is one thread.
 */
export function loaders(sourceOf, startThreads) {
    async function loadOf(name, source, { threads = 1 } = {}) {
        const count = startThreads && mayShareMemory() ? threads : 1;
        const module = await compiled(source ?? sourceOf(name, count > 1));
        const hasMemory = !WebAssembly.Module.imports(module).some(({ kind }) => kind === "memory");
        if (!hasMemory && !startThreads) throw new Error("a module of threads needs the package's files: import it from \"sinew\"");
        const engine = hasMemory ? new Engine(await WebAssembly.instantiate(module, {})) : await startThreads(module, count);
        return Object.assign(engine, { module });
    }
    return {
        load: (source, options) => loadOf("double", source, options),
        loadFloat: async (engine, source) => {
            engine.float ??= await loadOf("float", source, { threads: engine.threads });
            return engine;
        },
        loadExporter: async (source) => new Exporter(await loadOf("export", source)),
        loadImporter: async (source) => new Importer(await compiled(source ?? sourceOf("import", false))),
    };
}
