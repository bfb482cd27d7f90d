// The package's entry: see index.d.ts for what there is, and README.md for how to begin.
import { loaders } from "./core.js";
import { abi } from "./engine.js";
import { Canvas2DPainter } from "./painters/canvas2d.js";
import { startThreads } from "./threads.js";

const modules = {
    double: [new URL("./sinew.wasm", import.meta.url), new URL("./sinew-threads.wasm", import.meta.url)],
    float: [new URL("./sinew-float.wasm", import.meta.url), new URL("./sinew-float-threads.wasm", import.meta.url)],
    export: [new URL("./sinew-export.wasm", import.meta.url)],
    import: [new URL("./sinew-import.wasm", import.meta.url)],
};

export const { load, loadFloat, loadExporter, loadImporter } = loaders((name, hasThreads) => modules[name][hasThreads ? 1 : 0], startThreads);

export async function catalogue() {
    return (await import("./catalogue.js")).scenes;
}

export * from "./exports.js";
export default { load, loadFloat, loadExporter, loadImporter, abi, catalogue, Canvas2DPainter };
