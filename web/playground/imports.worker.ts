import { loadImporter, type Imported } from "../sinew/index.js";
import { isGone } from "../common/fresh.js";

/** A file to read, and those brought with it. */
export interface Order {
    name: string;
    bytes: ArrayBuffer;
    files: Record<string, ArrayBuffer>;
}

export type Answer = { imported: Imported } | { problem: string; isGone: boolean };

self.addEventListener("message", async ({ data: { name, bytes, files } }: MessageEvent<Order>) => {
    let answer: Answer;
    try {
        answer = { imported: await (await loadImporter()).read(name, bytes, { files }) };
    } catch (error) {
        answer = error instanceof Error ? { problem: error.message, isGone: isGone(error.cause) } : { problem: String(error), isGone: false };
    }
    self.postMessage(answer);
});
