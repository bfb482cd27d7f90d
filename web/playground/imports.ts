import type { Imported } from "../sinew/index.js";
import type { Assets } from "../common/engine.js";
import { tellGone, watchWorker } from "../common/fresh.js";
import type { Answer, Order } from "./imports.worker.js";

/** Endings of files that a scene is made of; where several are brought, the first of this list is, and refers to others. */
const endings = ["gltf", "glb", "tmj", "svg", "obj", "json", "png"];
const mostBytes = 16_000_000; // as everywhere: files/in/import.h
const longest = 30_000; // milliseconds

const endingOf = (name: string): string => name.slice(name.lastIndexOf(".") + 1).toLowerCase();
const rank = ({ name }: File): number => (endings.indexOf(endingOf(name)) + endings.length + 1) % (endings.length + 1);

/** The file of several that is to be opened. */
export function mainOf(files: File[]): File | undefined {
    return [...files].sort((a, b) => rank(a) - rank(b))[0];
}

/** True for a file of another program: a scene is JSON that says so. */
export async function isForeign(file: File): Promise<boolean> {
    if (!/\.json$/i.test(file.name)) return endings.includes(endingOf(file.name));
    if (file.size > mostBytes) return false;
    const text = await file.text();
    const has = (word: string): boolean => text.includes(`"${word}"`);
    return !/"sinew"\s*:/.test(text) && ((has("points") && has("sticks")) || (has("tilewidth") && has("layers")) || (has("asset") && has("buffers")));
}

/** A scene of a file, read by a worker that ends with it; its images and models are among the assets then. */
export async function readForeign(main: File, all: File[], assets: Assets): Promise<Imported> {
    for (const { name, size } of all) if (size > mostBytes) throw new Error(`${name} has more than 16 MB.`);
    const files: Record<string, ArrayBuffer> = {};
    for (const file of all) if (file !== main) files[file.name] = await file.arrayBuffer();
    const imported = await ask({ name: main.name, bytes: await main.arrayBuffer(), files });
    for (const { name, bytes } of imported.files)
        if (name.endsWith(".png")) await assets.addImage(name, bytes as Uint8Array<ArrayBuffer>);
        else assets.addModel(name, new TextDecoder().decode(bytes));
    return imported;
}

function ask(order: Order): Promise<Imported> {
    const worker = watchWorker(new Worker(new URL("./imports.worker.ts", import.meta.url), { type: "module" }));
    const answer = new Promise<Imported>((resolve, reject) => {
        const timer = setTimeout(() => reject(new Error(`${order.name} takes more than ${longest / 1000} seconds to read.`)), longest);
        worker.addEventListener("error", () => reject(new Error("The module that reads such files cannot be loaded.")));
        worker.addEventListener("message", ({ data }: MessageEvent<Answer>) => {
            clearTimeout(timer);
            if ("problem" in data && data.isGone) tellGone();
            if ("problem" in data) reject(new Error(data.problem));
            else resolve(data.imported);
        });
    });
    worker.postMessage(order);
    return answer.finally(() => worker.terminate());
}
