import type { Imported } from "../sinew/index.js";
import { el } from "../common/dom.js";
import { icon } from "../common/icons.js";

/** A list of all that a file has and a scene cannot hold, with each place. It stays until it is closed. */
export class NotesList {
    private readonly title = el("h2", { id: "notes-title" });
    private readonly list = el("ul");
    private readonly dialog = el("dialog", { class: "notes", "aria-labelledby": "notes-title" },
        el("button", { class: "quiet close", type: "button", "aria-label": "Close the notes", onclick: () => this.dialog.close() }, icon("close")),
        this.title, this.list);

    constructor() {
        document.body.append(this.dialog);
    }

    get isOpen(): boolean {
        return this.dialog.open;
    }

    close(): void {
        this.dialog.close();
    }

    show(name: string, notes: Imported["notes"]): void {
        this.dialog.close();
        if (notes.length === 0) return;
        this.title.textContent = `Not taken from ${name}, or changed`;
        this.list.replaceChildren(...notes.map(({ place, message }) => el("li", {}, place && el("code", {}, place), place && " ", message)));
        this.dialog.show();
    }
}
