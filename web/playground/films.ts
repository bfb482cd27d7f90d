import { announce, byId, el } from "../common/dom.js";
import type { Stage } from "../common/stage.js";
import { filmGif, filmVideo, offer, type Film } from "./files.js";

const longest = { gif: 10, video: 120 }; // seconds

/** At most one film at a time; a button over the scene ends it. */
export class Films {
    private film: Film | null = null;
    private end: () => void = () => {};

    toggle(stage: Stage, kind: "gif" | "video", name: string): void {
        if (this.film) return this.end();
        try {
            this.film = kind === "gif" ? filmGif(stage) : filmVideo(stage);
        } catch (error) {
            return announce(error instanceof Error ? error.message : String(error));
        }
        const button = el("button", { type: "button", class: "recording", onclick: () => this.end() }, "recording: press to end");
        byId("scene").append(button);
        const timer = setTimeout(() => this.end(), longest[kind] * 1000);
        this.end = () => {
            clearTimeout(timer);
            button.remove();
            void this.finish(name);
        };
    }

    private async finish(name: string): Promise<void> {
        const { film } = this;
        this.film = null;
        if (!film) return;
        const { blob, ending } = await film.end();
        offer(blob, `${name}.${ending}`);
        announce(`The film has ${(blob.size / 1e6).toFixed(1)} MB.`);
    }
}
