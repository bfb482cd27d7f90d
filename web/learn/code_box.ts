import { el } from "../common/dom.js";
import { icon } from "../common/icons.js";
import type { CodeEditor } from "./code_editor.js";
import { filled, type Ui } from "./lesson.js";
import type { Problem } from "./program/runner.js";
import { markedLines } from "./scene_text.js";

/** The text under a figure: read at once, edited when the editor has come, run, reset, its errors at their lines. */
export class CodeBox {
    private readonly pre = el("code", {});
    private readonly place = el("div", { class: "code" });
    private readonly problems = el("div", { class: "problems", role: "status" });
    private readonly note = el("p", { class: "note", hidden: true });
    private readonly resetButton: HTMLButtonElement;
    readonly link: HTMLAnchorElement;
    readonly root: HTMLElement;
    private editor: CodeEditor | null = null;
    private observer: IntersectionObserver | null = null;
    private shown: [text: string, other: string] = ["", ""];
    private edited: string | null = null; // before the editor has come

    /** `run` takes an edited text; `reset` brings the figure's own back. */
    constructor(private readonly language: "javascript" | "json", private readonly ui: Ui, private readonly run: (text: string) => void, private readonly reset: () => void) {
        const title = language === "json" ? ui.scene : ui.program;
        this.place.append(el("pre", { tabindex: 0, "aria-label": ui.code }, this.pre));
        this.resetButton = el("button", { type: "button", class: "reset", disabled: true, onclick: () => this.restore() }, icon("undo"), ui.reset);
        this.link = el("a", { class: "button quiet", hidden: language !== "json" }, ui.openInPlayground);
        this.root = el("details", { class: "lines", open: true }, el("summary", {}, title), this.place, this.problems,
            el("div", { class: "acts" }, el("button", { type: "button", class: "on run", title: ui.runKey, onclick: () => this.start() }, icon("play"), ui.run), this.resetButton, this.link),
            this.note, language === "javascript" && el("p", { class: "note" }, ui.words));
    }

    /** Loads the editor once the text is in sight. */
    begin(): void {
        this.observer = new IntersectionObserver((entries) => entries.at(-1)?.isIntersecting && void this.load());
        this.observer.observe(this.place);
    }

    end(): void {
        this.observer?.disconnect();
    }

    get text(): string {
        return this.editor?.text ?? this.edited ?? this.shown[0];
    }

    get isEdited(): boolean {
        return this.text !== this.shown[0];
    }

    /** Shows the figure's own text; lines that differ from `other` are marked. */
    show(text: string, other: string): void {
        this.shown = [text, other];
        this.edited = null;
        this.pre.replaceChildren(...markedLines(text, other).map(({ line, isMarked }) => el(isMarked ? "mark" : "span", {}, `${line}\n`)));
        this.editor?.show(text, other);
        this.tell([]);
        this.follow();
    }

    /** Takes a text that the reader has edited earlier. */
    take(text: string): void {
        this.edited = text;
        this.pre.replaceChildren(text);
        this.editor?.show(text, text);
        this.follow();
    }

    tell(problems: Problem[]): void {
        this.editor?.mark(problems.map(({ line }) => line));
        this.problems.replaceChildren(...problems.map(({ line, message }) =>
            el("button", { type: "button", class: "quiet", onclick: () => this.editor?.goTo(line) }, line > 0 && el("b", {}, filled(this.ui.line, { line: String(line) })), el("span", {}, message))));
    }

    private async load(): Promise<void> {
        this.observer?.disconnect();
        const { CodeEditor } = await import("./code_editor.js");
        if (this.editor) return;
        this.place.replaceChildren();
        this.editor = new CodeEditor(this.place, this.language, this.ui.code, () => this.follow(), () => this.start());
        if (this.edited === null) this.editor.show(...this.shown);
        else this.editor.show(this.edited, this.edited);
    }

    private start(): void {
        this.tell([]);
        this.run(this.text);
        this.follow();
    }

    private restore(): void {
        this.show(...this.shown);
        this.reset();
    }

    private follow(): void {
        this.resetButton.disabled = !this.isEdited;
        this.note.hidden = !this.isEdited;
        this.note.textContent = this.ui.edited;
        this.root.classList.toggle("edited", this.isEdited);
    }
}
