import { watchWorker } from "../common/fresh.js";
import type { Stage } from "../common/stage.js";

/** Offers a file for saving. */
export function offer(blob: Blob, name: string): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

export const sceneFile = (text: string): Blob => new Blob([text], { type: "application/json" });

export interface Film {
    /** Ends the film and gives the file. */
    end(): Promise<{ blob: Blob; ending: string }>;
}

/** Films the canvas as the browser can: WebM, or MP4 where it is Safari. */
export function filmVideo(stage: Stage): Film {
    const type = ["video/webm;codecs=vp9", "video/webm", "video/mp4"].find((one) => MediaRecorder.isTypeSupported(one));
    if (!type) throw new Error("This browser cannot record a film.");
    const recorder = new MediaRecorder(stage.canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 6_000_000 });
    const parts: Blob[] = [];
    recorder.addEventListener("dataavailable", ({ data }) => data.size > 0 && parts.push(data));
    recorder.start(250);
    const begun = filled(parts);
    return {
        async end() {
            await begun; // a film that ends before its first frame is encoded would be an empty file
            await new Promise((resolve) => {
                recorder.addEventListener("stop", resolve);
                recorder.stop();
            });
            return { blob: new Blob(parts, { type }), ending: type.includes("mp4") ? "mp4" : "webm" };
        },
    };
}

const longestWait = 10_000; // milliseconds for the first frame of a film

/** Waits until a list has something. */
async function filled(parts: Blob[]): Promise<void> {
    const until = performance.now() + longestWait;
    while (parts.length === 0 && performance.now() < until) await new Promise((resolve) => setTimeout(resolve, 50));
}

const gifSide = 480; // pixels of the longer side
const gifPeriod = 50; // milliseconds between frames; viewers know multiples of ten
const mostWaiting = 2; // frames; where the encoder is slower, frames are left out

/** Films the canvas as an animated GIF, which a worker encodes meanwhile. */
export function filmGif(stage: Stage): Film {
    const worker = watchWorker(new Worker(new URL("./gif.worker.ts", import.meta.url), { type: "module" }));
    const scale = Math.min(1, gifSide / Math.max(stage.canvas.width, stage.canvas.height));
    const small = document.createElement("canvas");
    small.width = Math.max(Math.round(stage.canvas.width * scale), 1);
    small.height = Math.max(Math.round(stage.canvas.height * scale), 1);
    const context = small.getContext("2d", { willReadFrequently: true })!;
    let waiting = 0, takenAt = performance.now() - gifPeriod;
    worker.addEventListener("message", () => --waiting);
    const take = (): void => {
        if (waiting >= mostWaiting) return;
        const now = performance.now(), delay = Math.max(Math.round((now - takenAt) / 10) * 10, 20);
        takenAt = now;
        ++waiting;
        context.drawImage(stage.canvas, 0, 0, small.width, small.height);
        const { data } = context.getImageData(0, 0, small.width, small.height);
        worker.postMessage({ pixels: data.buffer, width: small.width, height: small.height, delay }, [data.buffer]);
    };
    take();
    const timer = setInterval(take, gifPeriod);
    return {
        end: () => new Promise((resolve) => {
            clearInterval(timer);
            worker.addEventListener("message", ({ data }: MessageEvent<ArrayBuffer | "frame">) => {
                if (data === "frame") return;
                worker.terminate();
                resolve({ blob: new Blob([data], { type: "image/gif" }), ending: "gif" });
            });
            worker.postMessage("end");
        }),
    };
}
