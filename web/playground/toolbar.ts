import type { Engine, PlayerState } from "../sinew/index.js";
import { byId, el, words } from "../common/dom.js";
import { icon } from "../common/icons.js";
import type { Stage } from "../common/stage.js";

/** A button with an icon; the tip is its name for screen readers too. */
export function iconButton(name: string, tip: string, press: () => void): HTMLButtonElement {
    const button = el("button", { class: "tool quiet", type: "button", title: tip, "aria-label": tip.split("\n")[0], onclick: press });
    button.append(icon(name));
    return button;
}

/** Moves the focus between the buttons of a bar by arrow keys, so that Tab passes the bar in one step. */
export function rove(bar: HTMLElement): void {
    const items = (): HTMLElement[] => [...bar.querySelectorAll<HTMLElement>("button:not(:disabled), input, select")];
    const choose = (item: HTMLElement | undefined): void => {
        for (const one of items()) one.tabIndex = one === item ? 0 : -1;
    };
    choose(items()[0]);
    bar.addEventListener("focusin", (event) => choose(event.target as HTMLElement));
    bar.addEventListener("keydown", (event) => {
        const isRange = event.target instanceof HTMLInputElement && event.target.type === "range";
        const by = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
        if (by === undefined || isRange || event.ctrlKey || event.metaKey) return;
        const all = items(), next = all[(all.indexOf(event.target as HTMLElement) + by + all.length) % all.length];
        next?.focus();
        event.preventDefault();
        event.stopPropagation();
    });
}

/** The bar at the left: tools, undo, redo. */
export class Toolbar {
    private readonly root = byId("tools");
    private readonly tools = new Map<string, HTMLButtonElement>();
    private readonly undo: HTMLButtonElement;
    private readonly redo: HTMLButtonElement;

    constructor(engine: Engine, stage: Stage, changed: () => void) {
        const group = el("div", { class: "group", role: "radiogroup", "aria-label": "Tool" });
        for (const { name, key, about } of engine.tools()) {
            const button = iconButton(name, `${name}  (${key})\n${about}`, () => (stage.player.setTool(name), changed()));
            button.setAttribute("role", "radio");
            this.tools.set(name, button);
            group.append(button);
        }
        this.undo = iconButton("undo", "undo  (ctrl+z)", () => (stage.player.undo(), changed()));
        this.redo = iconButton("redo", "do again  (ctrl+y)", () => (stage.player.redo(), changed()));
        this.root.append(group, el("div", { class: "group" }, this.undo, this.redo,
            iconButton("home", "see everything  (home)", () => (stage.seeAll(), changed()))));
        rove(this.root);
    }

    show(state: PlayerState): void {
        for (const [name, button] of this.tools) {
            button.setAttribute("aria-checked", String(name === state.tool));
        }
        this.label(this.undo, "undo", state.undo, "ctrl+z");
        this.label(this.redo, "do again", state.redo, "ctrl+y");
    }

    private label(button: HTMLButtonElement, word: string, what: string, key: string): void {
        const tip = `${word}${what ? ` ${words(what)}` : ""}  (${key})`;
        if (button.title === tip) return;
        button.title = tip;
        button.setAttribute("aria-label", tip);
        button.classList.toggle("faint", what === "");
    }
}
