import type { CatalogueScene } from "../sinew/index.js";
import { watchWorker } from "../common/fresh.js";
import type { Order } from "./thumbnails.worker.js";

/** Live pictures of scenes, stepped and painted by a worker, so that the page never waits for them. */
export class Thumbnails {
    private readonly worker = watchWorker(new Worker(new URL("./thumbnails.worker.ts", import.meta.url), { type: "module" }));
    private readonly names = new Map<Element, string>();
    private readonly given = new Set<string>();
    private readonly observer = new IntersectionObserver((entries) => {
        for (const entry of entries) this.see(entry.target as HTMLCanvasElement, entry.isIntersecting);
    }, { rootMargin: "80px" });

    constructor(scenes: CatalogueScene[], module: WebAssembly.Module) {
        this.send({ order: "begin", scenes, module });
        this.worker.addEventListener("message", ({ data }: MessageEvent<{ drawn: string; modes: number }>) => {
            for (const [canvas, name] of this.names) if (name === data.drawn) this.drawn(canvas as HTMLCanvasElement, data.modes);
        });
    }

    private drawn(canvas: HTMLCanvasElement, modes: number): void {
        canvas.classList.add("drawn");
        canvas.dataset.modes = String(modes); // 2: classic beside physical
    }

    add(canvas: HTMLCanvasElement, name: string): void {
        this.names.set(canvas, name);
        this.observer.observe(canvas);
    }

    private see(canvas: HTMLCanvasElement, visible: boolean): void {
        const name = this.names.get(canvas) ?? "";
        if (visible && !this.given.has(name)) {
            this.given.add(name);
            const density = Math.min(devicePixelRatio || 1, 2);
            canvas.width = Math.max(Math.round(canvas.clientWidth * density), 1);
            canvas.height = Math.max(Math.round(canvas.clientHeight * density), 1);
            const surface = canvas.transferControlToOffscreen();
            this.send({ order: "open", name, canvas: surface }, [surface]);
        }
        if (this.given.has(name)) this.send({ order: "see", name, visible });
    }

    /** Gives the scene under the pointer the most frames, in both modes beside each other. */
    prefer(name: string, on: boolean): void {
        this.send({ order: "prefer", name: on ? name : "" });
    }

    run(on: boolean, theme: string): void {
        const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
        this.send({ order: "run", on, theme, still });
    }

    private send(order: Order, transfer: Transferable[] = []): void {
        this.worker.postMessage(order, transfer);
    }
}
