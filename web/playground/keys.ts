import { announce, byId } from "../common/dom.js";
import type { App } from "./app.js";
import { steerByArrows } from "./steering.js";

const renamed: Record<string, string> = { " ": "space", ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down", Escape: "escape", Delete: "delete", Backspace: "delete", Home: "home" };

/** Name of a key as the player knows it: "p", "ctrl+z". */
function nameOf(event: KeyboardEvent): string {
    const key = renamed[event.key] ?? event.key.toLowerCase();
    return `${event.ctrlKey || event.metaKey ? "ctrl+" : ""}${event.shiftKey && key.length > 1 ? "shift+" : ""}${key}`;
}

/** Keys of the native window, wherever the focus is but in a field or a list. */
export function connectKeys(app: App, help: HTMLDialogElement): void {
    const own: Record<string, () => void> = {
        f1: () => help.showModal(),
        t: () => app.switchTheme(),
        "[": () => app.openNeighbour(-1),
        "]": () => app.openNeighbour(1),
        s: () => void app.savePicture(),
        v: () => app.toggleFilm(),
        home: () => app.stage!.seeAll(),
        "ctrl+s": () => app.saveScene(),
        "ctrl+o": () => app.chooseFile(),
    };
    const ofPlayer = new Set(app.engine.actions().map(({ key }) => key));
    const tools = new Map(app.engine.tools().map(({ key, name }) => [key, name]));
    const overlays = app.engine.overlays().map(({ name }) => name);

    steerByArrows(app, help, nameOf);
    addEventListener("keydown", (event) => {
        const player = app.stage?.player;
        if (!document.body.classList.contains("playing") || !player || help.open || isTyping(event)) return;
        const name = nameOf(event);
        const tool = tools.get(name);
        const overlay = /^[1-9]$/.test(name) ? overlays[Number(name) - 1] : undefined;
        if (own[name]) own[name]!();
        else if (tool && name !== "delete") player.setTool(tool);
        else if (overlay) player.setOverlays(toggled(player.state().overlays, overlay));
        else if (name === "escape" && app.notes.isOpen) app.notes.close();
        else if (name === "escape" && document.body.classList.contains("drawer")) app.openPanel(false);
        else if (name === "delete" || name === "escape" || ofPlayer.has(name) && !["ctrl+c", "ctrl+v", "ctrl+n", "ctrl+shift+s", "tab", "f2"].includes(name)) player.key(name);
        else return;
        event.preventDefault();
        app.changed();
    });
    addEventListener("keyup", (event) => {
        if (document.body.classList.contains("playing")) app.stage?.player.key(nameOf(event), false);
    });
    // After a press of the mouse or a finger, space pauses, and does not press the same button again.
    addEventListener("click", ({ target, detail }) => {
        const isOfBars = target instanceof Element && target.closest("#tools button, #time button, #side :is(.chips, .deeds, .segments) button");
        if (isOfBars && detail > 0) byId("stage").focus({ preventScroll: true });
    });
    addEventListener("error", (event) => announce(event.message));
    addEventListener("unhandledrejection", (event) => announce(String(event.reason)));
}

function toggled(all: string[], one: string): string[] {
    return all.includes(one) ? all.filter((other) => other !== one) : [...all, one];
}

/** Letters belong to the field under the cursor. */
function isTyping(event: KeyboardEvent): boolean {
    const target = event.target instanceof Element ? event.target : null;
    if (event.defaultPrevented) return true;
    if (target?.closest(".cm-editor, textarea, select, input:not([type=range], [type=checkbox])")) return true;
    const isSlider = target instanceof HTMLInputElement && target.type === "range";
    const isButton = target?.closest("button, a, summary, [role=tab]");
    return isSlider && (event.key.startsWith("Arrow") || event.key === "Home") || Boolean(isButton) && (event.key === " " || event.key === "Enter");
}
