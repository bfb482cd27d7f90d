import { closeBrackets, closeBracketsKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { javascript } from "@codemirror/lang-javascript";
import { json } from "@codemirror/lang-json";
import { bracketMatching, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { Annotation, EditorState, StateEffect, StateField } from "@codemirror/state";
import { Decoration, drawSelection, EditorView, keymap, lineNumbers, type DecorationSet } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { markedLines } from "./scene_text.js";

const fromOutside = Annotation.define<boolean>();

const colors = HighlightStyle.define([
    { tag: tags.propertyName, color: "var(--cool)" },
    { tag: [tags.keyword, tags.definitionKeyword, tags.controlKeyword], color: "var(--cool)" },
    { tag: tags.string, color: "var(--good)" },
    { tag: [tags.number, tags.bool, tags.null], color: "var(--accent-text)" },
    { tag: tags.comment, color: "var(--faint)", fontStyle: "italic" },
]);

const look = EditorView.theme({
    "&": { fontSize: "13px", backgroundColor: "transparent", color: "var(--text)", maxHeight: "min(560px, 70vh)" },
    "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "1px" },
    ".cm-scroller": { fontFamily: '"DejaVu Sans Mono", ui-monospace, SFMono-Regular, Menlo, Consolas, monospace', lineHeight: "1.5" },
    ".cm-content": { padding: "6px 0" },
    ".cm-gutters": { backgroundColor: "transparent", color: "var(--faint)", border: "0" },
    ".cm-lineNumbers .cm-gutterElement": { minWidth: "22px", padding: "0 8px 0 0" },
    ".cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground": { backgroundColor: "color-mix(in srgb, var(--accent), transparent 70%)" },
    ".cm-cursor": { borderLeftColor: "var(--accent)" },
    ".marked": { backgroundColor: "color-mix(in srgb, var(--accent), transparent 86%)" },
    ".wrong": { backgroundColor: "color-mix(in srgb, #e0245e, transparent 78%)", boxShadow: "inset 3px 0 0 #e0245e" },
});

const setLines = StateEffect.define<{ lines: number[]; name: string }>();

const highlighted = (name: string): StateField<DecorationSet> => StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update(old, { changes, effects, state }) {
        const set = effects.find((effect) => effect.is(setLines) && effect.value.name === name);
        if (!set) return old.map(changes);
        const lines = (set.value as { lines: number[] }).lines.filter((line) => line >= 1 && line <= state.doc.lines);
        return Decoration.set(lines.map((line) => Decoration.line({ class: name }).range(state.doc.line(line).from)));
    },
    provide: (field) => EditorView.decorations.from(field),
});

/** A text editor of a program or a scene, with the line the slider changes and those in error marked. */
export class CodeEditor {
    private readonly view: EditorView;

    constructor(parent: HTMLElement, language: "javascript" | "json", label: string, changed: () => void, run: () => void) {
        this.view = new EditorView({
            parent,
            state: EditorState.create({
                extensions: [
                    lineNumbers(), history(), drawSelection(), indentOnInput(), indentUnit.of(language === "json" ? "  " : "    "), bracketMatching(), closeBrackets(),
                    EditorView.lineWrapping, language === "json" ? json() : javascript(), syntaxHighlighting(colors), look, highlighted("marked"), highlighted("wrong"),
                    keymap.of([{ key: "Mod-Enter", preventDefault: true, run: () => (run(), true) }, ...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap]),
                    EditorView.contentAttributes.of({ tabindex: "0", "aria-label": label }),
                    EditorView.updateListener.of((update) => {
                        if (update.docChanged && !update.transactions.some((one) => one.annotation(fromOutside))) changed();
                    }),
                ],
            }),
        });
    }

    get text(): string {
        return this.view.state.doc.toString();
    }

    /** Replaces the text; marks the lines that differ with another value of the slider. */
    show(text: string, other: string): void {
        const lines = markedLines(text, other).flatMap(({ isMarked }, i) => (isMarked ? [i + 1] : []));
        this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, annotations: fromOutside.of(true), effects: setLines.of({ lines, name: "marked" }) });
    }

    /** Marks lines in error. */
    mark(lines: number[]): void {
        this.view.dispatch({ effects: setLines.of({ lines, name: "wrong" }) });
    }

    goTo(line: number): void {
        const at = this.view.state.doc.line(Math.min(Math.max(line, 1), this.view.state.doc.lines));
        this.view.dispatch({ selection: { anchor: at.from }, effects: EditorView.scrollIntoView(at.from, { y: "center" }) });
        this.view.focus();
    }
}
