import { loadExporter, type Exporter } from "../sinew/index.js";
import { announce } from "../common/dom.js";
import type { Assets } from "../common/engine.js";
import { loadOwn } from "../common/fresh.js";
import { offer } from "./files.js";

/** Files of other programs that the menu offers. */
export const exportKinds = [
    { name: "model (glTF)", ending: "glb" },
    { name: "mesh (OBJ)", ending: "obj" },
    { name: "points (PLY)", ending: "ply" },
    { name: "point cache (PC2)", ending: "pc2" },
    { name: "point cache (MDD)", ending: "mdd" },
    { name: "moving drawing (SVG)", ending: "svg" },
    { name: "animation (Lottie)", ending: "json" },
    { name: "trace (CSV)", ending: "csv" },
    { name: "trace (JSON)", ending: "jsonl" },
] as const;

const types: Record<string, string> = { glb: "model/gltf-binary", obj: "model/obj", mtl: "model/mtl", svg: "image/svg+xml", csv: "text/csv", json: "application/json" };

let exporter: Promise<Exporter> | undefined;

/** Writes the scene from its start, for as long as it says; the module for it is loaded the first time. */
export async function exportScene(text: string, overrides: string[], assets: Assets, name: string, ending: string): Promise<void> {
    announce("Writing the file…");
    exporter ??= loadOwn(loadExporter());
    exporter.catch(() => (exporter = undefined)); // without a network: another time
    const { files, notes } = await (await exporter).write(text, `${name}.${ending}`, {
        overrides: [...overrides, "solver.precision=double"], // the only worlds of the module
        ...assets.optionsOf(text),
    });
    for (const file of files) {
        const kind = file.name.slice(file.name.lastIndexOf(".") + 1);
        offer(new Blob([file.bytes as Uint8Array<ArrayBuffer>], { type: types[kind] ?? "application/octet-stream" }), file.name);
    }
    announce([`${name}.${ending} is written.`, ...notes].join(" "));
}
