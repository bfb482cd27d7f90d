import { el } from "../common/dom.js";

export interface Segment {
    value: string;
    word: string;
    tip: string;
}

/** One choice of a few, as a row of buttons. */
export interface Segments {
    root: HTMLElement;
    /** Shows a value as chosen; a value that is none of the segments chooses nothing. */
    choose(value: string): void;
}

export function segments(label: string, choices: Segment[], chosen: (value: string) => void): Segments {
    const buttons = new Map(choices.map(({ value, word, tip }) => [value, el("button",
        { type: "button", role: "radio", title: tip, "aria-label": tip === word ? word : `${word}: ${tip}`, "aria-checked": "false", onclick: () => chosen(value) }, word)]));
    let shown = "";
    return {
        root: el("div", { class: "segments", role: "radiogroup", "aria-label": label }, ...buttons.values()),
        choose(value) {
            if (value === shown) return;
            shown = value;
            for (const [own, button] of buttons) button.setAttribute("aria-checked", String(own === value));
        },
    };
}
