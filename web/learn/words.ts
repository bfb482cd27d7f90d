import { inLanguage, percent, type Ui } from "./lesson.js";

/** A text of the lessons as HTML: [[term]] and [[shown|term]] explain a word, «mouse|touch» is said for the one or the other. */
export function html(text: string, terms: Record<string, string>): string {
    return text
        .replace(/«([^|»]*)\|([^»]*)»/g, (_, mouse: string, touch: string) => `<span class="mouse">${mouse}</span><span class="touch">${touch}</span>`)
        .replace(/\[\[([^\]|]+)(?:\|([^\]]+))?\]\]/g, (_, shown: string, name?: string) => term(shown, terms[name ?? shown] ?? ""));
}

let count = 0;

function term(shown: string, explanation: string): string {
    const id = `term-${++count}`;
    return `<span class="term" tabindex="0" aria-describedby="${id}">${shown}<span class="tip" role="tooltip" id="${id}">${explanation}</span></span>`;
}

/** Terms of a text that its language does not explain. */
export const unexplained = (text: string, terms: Record<string, string>): string[] =>
    [...text.matchAll(/\[\[([^\]|]+)(?:\|([^\]]+))?\]\]/g)].map(([, shown, name]) => name ?? shown!).filter((name) => !(name in terms));

const formats: Record<string, (value: number) => string> = {
    percent,
    tenth: (value) => value.toFixed(1),
    one: (value) => value.toFixed(0),
};

/** Writes the numbers of a running figure into the text: <output name="stretch" data-as="percent">. */
export function react(page: ParentNode, live: Record<string, number>, ui: Ui): void {
    for (const output of page.querySelectorAll<HTMLOutputElement>("p output[name]")) {
        const value = live[output.name];
        if (value === undefined) continue;
        const shown = inLanguage((formats[output.dataset.as ?? ""] ?? String)(value), ui);
        if (output.textContent !== shown) output.textContent = shown;
    }
}

const margin = 12; // pixels between an explanation and the edge of the page

/** Explanations stay on the page: one that would reach over its right edge is moved to the left. */
export function keepTipsOnPage(page: HTMLElement): void {
    const place = ({ target }: Event): void => {
        const term = target instanceof Element ? target.closest<HTMLElement>(".term") : null, tip = term?.querySelector<HTMLElement>(".tip");
        if (!term || !tip) return;
        term.style.setProperty("--shift", "0px");
        const over = tip.getBoundingClientRect().right + margin - document.documentElement.clientWidth;
        if (over > 0) term.style.setProperty("--shift", `${-over}px`);
    };
    page.addEventListener("pointerover", place);
    page.addEventListener("focusin", place);
}
