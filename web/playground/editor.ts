import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { json } from "@codemirror/lang-json";
import { bracketMatching, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Annotation, EditorState, type Text } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Engine, SceneError } from "../sinew/index.js";
import { completionsOf } from "./completion.js";

const fromOutside = Annotation.define<boolean>();

const colors = HighlightStyle.define([
    { tag: tags.propertyName, color: "var(--cool)" },
    { tag: tags.string, color: "var(--good)" },
    { tag: [tags.number, tags.bool, tags.null], color: "var(--accent-text)" },
    { tag: tags.comment, color: "var(--faint)", fontStyle: "italic" },
]);

const look = EditorView.theme({
    "&": { height: "100%", fontSize: "12.5px", backgroundColor: "transparent", color: "var(--text)" },
    "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "-2px" },
    ".cm-scroller": { fontFamily: '"DejaVu Sans Mono", ui-monospace, Menlo, Consolas, monospace', lineHeight: "1.5" },
    ".cm-gutters": { backgroundColor: "transparent", color: "var(--faint)", border: "0" },
    ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--raised), transparent 45%)" },
    ".cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground": { backgroundColor: "color-mix(in srgb, var(--accent), transparent 70%)" },
    ".cm-cursor": { borderLeftColor: "var(--accent)" },
    ".cm-tooltip, .cm-panels": { backgroundColor: "var(--surface)", color: "var(--text)", border: "1px solid var(--line)" },
    ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--fill)", color: "var(--on-accent)" },
    ".cm-completionDetail": { color: "inherit", opacity: "0.75", fontStyle: "normal", marginLeft: "1em" },
    ".cm-diagnostic": { fontFamily: '"Inter Variable", system-ui, sans-serif', fontSize: "13px" },
});

/** A text editor of scenes: the engine's errors at their lines, its schema as completion. */
export class SceneEditor {
    private readonly view: EditorView;

    /** `changed` is called with each text that the user writes. */
    constructor(parent: HTMLElement, engine: Engine, changed: (text: string) => void) {
        this.view = new EditorView({
            parent,
            state: EditorState.create({
                extensions: [
                    lineNumbers(), lintGutter(), history(), drawSelection(), indentOnInput(), bracketMatching(), closeBrackets(),
                    highlightActiveLine(), EditorView.lineWrapping, highlightSelectionMatches(), json(), syntaxHighlighting(colors), look,
                    autocompletion({ override: [completionsOf(engine.schema())] }),
                    keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap, ...lintKeymap]),
                    EditorView.contentAttributes.of({ tabindex: "0", "aria-label": "Text of the scene" }),
                    EditorView.updateListener.of((update) => {
                        if (update.docChanged && !update.transactions.some((one) => one.annotation(fromOutside))) changed(this.text);
                    }),
                ],
            }),
        });
    }

    get text(): string {
        return this.view.state.doc.toString();
    }

    /** Replaces the text, for a change that was made elsewhere. */
    show(text: string): void {
        if (text === this.text) return;
        const { scrollTop } = this.view.scrollDOM;
        this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, annotations: fromOutside.of(true) });
        this.view.scrollDOM.scrollTop = scrollTop;
        this.mark([]);
    }

    mark(errors: SceneError[]): void {
        const { doc } = this.view.state;
        this.view.dispatch(setDiagnostics(this.view.state, errors.map((error) => diagnosticOf(error, doc))));
    }

    /** Puts the cursor at the first error. */
    goTo(error: SceneError): void {
        const { from } = diagnosticOf(error, this.view.state.doc);
        this.view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
        this.view.focus();
    }

    get hasFocus(): boolean {
        return this.view.hasFocus;
    }
}

function diagnosticOf({ line, column, length, message, help }: SceneError, doc: Text): Diagnostic {
    const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
    const from = Math.min(at.from + Math.max(column - 1, 0), at.to);
    const to = Math.min(Math.max(from + Math.max(length, 1), from), doc.length);
    return { from, to, severity: "error", message: help ? `${message}\n${help}` : message };
}
