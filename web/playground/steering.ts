import type { Player } from "../sinew/index.js";
import { byId, el } from "../common/dom.js";
import { icon } from "../common/icons.js";
import type { App } from "./app.js";

/** Whether a scene has a character or a car. */
const isSteered = (player: Player): boolean => /"prefab"\s*:\s*"(character|car)"/.test(player.sceneText());

/** Keys that are held down and steer. */
class HeldKeys {
    private readonly held = new Set<string>();

    constructor(private readonly app: App) {}

    has(name: string): boolean {
        return this.held.has(name);
    }
    press(name: string): void {
        this.held.add(name);
        this.app.stage?.player.key(name);
        this.app.stage?.wake();
    }
    release(name: string): void {
        if (this.held.delete(name)) this.app.stage?.player.key(name, false);
    }
    releaseAll(): void {
        for (const name of [...this.held]) this.release(name);
    }
}

/** Arrows steer characters and cars, where a scene has such, in place of the keyboard's pointer; in bars they move the focus. */
export function steerByArrows(app: App, help: HTMLDialogElement, nameOf: (event: KeyboardEvent) => string): void {
    const keys = new HeldKeys(app);
    addEventListener("keydown", (event) => {
        const { target } = event, player = app.stage?.player;
        if (!event.key.startsWith("Arrow") || event.ctrlKey || event.metaKey || event.altKey || help.open) return;
        if (!document.body.classList.contains("playing") || !player || target !== document.body && target !== byId("stage")) return;
        const name = nameOf(event).replace("shift+", "");
        if (!keys.has(name) && !isSteered(player)) return;
        keys.press(name);
        event.preventDefault();
        event.stopPropagation();
    }, { capture: true });
    addEventListener("keyup", (event) => keys.release(nameOf(event).replace("shift+", "")));
    addEventListener("blur", () => keys.releaseAll()); // a key that is let go elsewhere is not told
}

/** Buttons of the pad, by the keys that they stand for: icons and words. Two are for the left thumb. */
const pad = {
    left: ["steer_left", "left"],
    right: ["steer_right", "right"],
    down: ["steer_down", "down"],
    up: ["steer_up", "up"],
    h: ["hold", "hold on"],
    space: ["jump", "jump or brake"],
} as const;

/** The pad of a touch device: each button is its key, held down as long as a finger is on it. */
export class SteeringPad {
    private readonly keys: HeldKeys;
    private readonly root: HTMLElement;

    constructor(app: App) {
        this.keys = new HeldKeys(app);
        this.root = el("div", { id: "pad", role: "group", "aria-label": "Steering", hidden: true }, ...Object.entries(pad).map(([key, [drawing, words]]) => this.button(key, drawing, words)));
        byId("scene").append(this.root);
    }

    /** Shown where there is something to steer. */
    show(player: Player): void {
        const isShown = isSteered(player);
        if (!isShown) this.keys.releaseAll();
        this.root.hidden = !isShown;
    }

    private button(key: string, drawing: string, words: string): HTMLElement {
        const release = (): void => this.keys.release(key);
        const button = el("button", { type: "button", "aria-label": words, onlostpointercapture: release, onblur: release,
            onpointerdown: (event: PointerEvent) => {
                button.setPointerCapture(event.pointerId);
                this.keys.press(key);
                event.preventDefault();
            },
            oncontextmenu: (event: Event) => event.preventDefault() }, icon(drawing));
        return button;
    }
}
