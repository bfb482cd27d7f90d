import { SceneErrors, type Engine, type SceneError } from "../sinew/index.js";
import { debounced, el } from "../common/dom.js";
import { provide } from "../common/engine.js";
import type { Stage } from "../common/stage.js";
import type { SceneEditor } from "./editor.js";

/** The scene as text, read again at every key. The editor is loaded when it is first opened. */
export class TextTab {
    private readonly place = el("div", { class: "editor" });
    private readonly problems = el("div", { class: "problems", role: "status" });
    readonly root = el("div", { class: "text" }, this.place, this.problems);
    private editor: Promise<SceneEditor> | null = null;
    private shown = "";
    /** The text the user wrote last, while the scene is what it says. */
    private written: string | null = null;
    private sceneOfWritten = "";
    private readonly readAgain = debounced(300, () => void this.read());

    constructor(private readonly engine: Engine, private readonly stage: Stage, private readonly changed: (text: string) => void) {}

    async open(): Promise<void> {
        this.editor ??= import("./editor.js").then(({ SceneEditor }) => new SceneEditor(this.place, this.engine, () => this.readAgain()));
        (await this.editor).show(this.shown);
    }

    /** The scene was opened from a text. */
    opened(text: string): void {
        this.written = text;
        this.sceneOfWritten = this.stage.player.sceneText();
        void this.display(text);
    }

    /** The scene may have been edited by tools or sliders: the user's own words stay where they say the same. */
    follow(): void {
        const scene = this.stage.player.sceneText();
        if (scene === this.sceneOfWritten) return;
        this.written = null;
        this.sceneOfWritten = scene;
        void this.display(scene);
    }

    /** The running scene in the user's own words, if it is what they say. */
    get text(): string {
        return this.written ?? this.stage.player.sceneText();
    }

    private async display(text: string): Promise<void> {
        this.shown = text;
        this.problems.replaceChildren();
        if (this.editor) (await this.editor).show(text);
    }

    private async read(): Promise<void> {
        if (!this.editor) return;
        const editor = await this.editor, { text } = editor;
        if (text === this.shown) return;
        this.shown = text;
        await provide(this.stage, text);
        const errors = this.take(text);
        editor.mark(errors);
        this.problems.replaceChildren(...errors.map((error) => this.problem(error, editor)));
        if (errors.length > 0) return;
        this.written = text;
        this.sceneOfWritten = this.stage.player.sceneText();
        this.changed(text);
    }

    /** Continues with an edited text; returns its errors. */
    private take(text: string): SceneError[] {
        try {
            this.stage.become(text);
            return [];
        } catch (error) {
            if (error instanceof SceneErrors) return error.errors;
            throw error;
        }
    }

    private problem(error: SceneError, editor: SceneEditor): HTMLElement {
        return el("button", { type: "button", class: "quiet", onclick: () => editor.goTo(error) },
            el("b", {}, `${error.line}:${error.column}`), ` ${error.message}`, error.help && el("small", {}, error.help));
    }
}
