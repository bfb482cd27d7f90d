import { loadImporter, type Imported } from "../sinew/index.js";

/** A file to read, and those brought with it. */
export interface Order {
    name: string;
    bytes: ArrayBuffer;
    files: Record<string, ArrayBuffer>;
}

export type Answer = { imported: Imported } | { problem: string };

self.addEventListener("message", async ({ data: { name, bytes, files } }: MessageEvent<Order>) => {
    let answer: Answer;
    try {
        answer = { imported: await (await loadImporter()).read(name, bytes, { files }) };
    } catch (error) {
        answer = { problem: error instanceof Error ? error.message : String(error) };
    }
    self.postMessage(answer);
});
