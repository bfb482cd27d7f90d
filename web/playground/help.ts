import type { Engine } from "../sinew/index.js";
import { el } from "../common/dom.js";
import { icon } from "../common/icons.js";

const fingers = {
    "one finger": "takes hold of what is nearest, or uses the tool; letting go throws it",
    "two fingers": "move and zoom",
};
const mouse = {
    "left button": "takes hold of what is nearest; letting go throws it",
    "right button": "cuts what it is drawn across",
    "middle button": "looks elsewhere; in 3D, dragging where nothing is turns the scene",
    wheel: "zooms about the pointer",
};
const arrows = {
    "arrow keys": "move a pointer over the scene; Enter presses, and lets go. Where there is a character or a car, they steer it; space jumps or brakes, h holds on",
};
const ofPage = new Set(["open", "new", "save_as", "copy", "paste", "panel", "settings", "close", "free_running"]);

/** All keys, in a dialog; a touch device has its fingers first. */
export function helpDialog(engine: Engine): HTMLDialogElement {
    const row = (key: string, about: string): HTMLElement[] => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, about)];
    const pointer = matchMedia("(pointer: coarse)").matches ? { ...fingers, ...mouse, ...arrows } : { ...mouse, ...fingers, ...arrows };
    const actions = engine.actions().filter(({ name }) => !ofPage.has(name));
    const dialog = el("dialog", { class: "help", "aria-labelledby": "help-title" },
        el("button", { class: "quiet close", type: "button", "aria-label": "Close the help", onclick: () => dialog.close() }, icon("close")),
        el("h2", { id: "help-title" }, "Keys and buttons"),
        el("div", { class: "columns" },
            el("dl", {}, ...Object.entries(pointer).flatMap(([key, about]) => row(key, about)),
                ...engine.tools().flatMap(({ name, key, about }) => row(key, `${name}: ${about}`))),
            el("dl", {}, ...actions.flatMap(({ key, about }) => row(key, about)), ...row("1 to 6", "overlays"), ...row("escape", "chooses nothing, or closes the panel of a narrow page"), ...row("tab", "to the next bar, arrow keys within"))));
    dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
    document.body.append(dialog);
    return dialog;
}
