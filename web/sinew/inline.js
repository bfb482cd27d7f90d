// The entry of sinew-inline.js, one file with its module in it (tools/make_inline.mjs): for pages without a server, for workers
// that are made of a text, and for bundlers that leave addresses of files as they are.
import { loaders } from "./core.js";
import { abi } from "./engine.js";
import { Canvas2DPainter } from "./painters/canvas2d.js";
import packed from "sinew-module";

/** The module's bytes, of a gzip file in base64. */
async function unpacked() {
    const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

function sourceOf(name) {
    if (name === "double") return unpacked();
    throw new Error(`sinew-inline.js has the module of worlds of double alone: name the file of "${name}", or import it from "sinew"`);
}

export const { load, loadFloat, loadExporter, loadImporter } = loaders(sourceOf);
export * from "./exports.js";
export default { load, loadFloat, loadExporter, loadImporter, abi, Canvas2DPainter };
