import { filled, isProgram, textOf, withComments, type Figure } from "./lesson.js";
import { lessons } from "./lessons/lessons.js";
import { sceneText } from "./scene_text.js";
import { de } from "./text/de.js";
import { en } from "./text/en.js";
import type { Text } from "./text/text.js";

const takeHome = import.meta.glob<string>("./take_home/*.html", { query: "?raw", import: "default", eager: true });

export const texts: Record<string, Text> = { en, de };
export { lessons };

/** The files to take home, in a language, by their addresses. */
export function files(language: string): [address: string, content: string][] {
    const { ui } = texts[language]!;
    return Object.entries(takeHome).map(([path, content]) => {
        const name = path.replace(/.*\/|\.html$/g, "");
        return [`take_home/${language}/${name}.html`, withComments(content, { ...ui.fileComments, title: ui.fileTitles[name]! })];
    });
}

/** The text of a figure as its slider first stands. */
export const ownText = (figure: Figure, lesson: string, i: number, language: string): string =>
    textOf(figure, figure.slider.value, texts[language]!.lessons[lesson]!.figures[i]!, (scene) => sceneText(scene, 84));

const escaped = (text: string): string => text.replace(/[&<>]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[sign]!);

/** Explanations stand in brackets behind their first use; both ways of pointing are said. */
function plain(text: string, terms: Record<string, string>, used: Set<string>): string {
    return text.replace(/«([^|»]*)\|([^»]*)»/g, "$1").replace(/\[\[([^\]|]+)(?:\|([^\]]+))?\]\]/g, (_, shown: string, name = shown) => {
        if (used.has(name)) return shown;
        used.add(name);
        return `${shown}<small> (${terms[name]})</small>`;
    });
}

const style = `body { font: 17px/1.6 Inter, system-ui, sans-serif; color: #2b2d42; background: #fdfaf3; margin: 0 auto; max-width: 46rem; padding: 2rem 1.2rem }
h1 { font-size: 2.3rem; line-height: 1.15 } h2 { margin: 3.5rem 0 .6rem; font-size: 1.7rem; line-height: 1.2; break-after: avoid } small { color: #6b6455; font-size: .85em }
pre { font: 12.5px/1.45 "DejaVu Sans Mono", ui-monospace, Menlo, monospace; background: #efe7d7; padding: .7rem .9rem; border-radius: 8px; overflow-x: auto; white-space: pre-wrap; break-inside: auto }
svg { width: 100%; height: auto; border: 1px solid #ded4c0; border-radius: 8px; background: #fffdf8; display: block; break-inside: avoid } .source { font-style: italic; color: #6b6455 } a { color: #b93a15 }
@media print { body { background: none; font-size: 11pt; max-width: none; padding: 0 } pre { font-size: 8.5pt; background: none; border: 1px solid #ccc } h2 { break-before: page } h2:first-of-type { break-before: auto } nav { display: none } }`;

/** All lessons on one page, to print and to read without a program. `picture` draws a figure from its text, as SVG. */
export function printed(language: string, picture: (figure: Figure, text: string) => string): string {
    const text = texts[language]!, { ui } = text, used = new Set<string>();
    const say = (words: string): string => `<p>${plain(words, text.terms, used)}</p>`;
    const body = lessons.map((lesson, index) => {
        const words = text.lessons[lesson.id]!;
        const figures = lesson.figures.map((figure, i) => {
            const own = ownText(figure, lesson.id, i, language), { task, challenge } = words.figures[i]!;
            return `<figure style="margin: 1.2rem 0">${picture(figure, own)}<figcaption>${say(`<b>${ui.try}</b> ${task}`)}${challenge ? say(`<b>${ui.challenge}</b> ${challenge}`) : ""}</figcaption>
<p><b>${isProgram(figure) ? ui.program : ui.scene}</b></p><pre><code>${escaped(own)}</code></pre></figure>`;
        });
        const questions = (words.questions ?? []).map(([question, answer]) => `<p><b>${question}</b></p>${say(answer)}`);
        const home = (lesson.files ?? []).map((file) => `<p><b>${ui.takeHome}:</b> <a href="../take_home/${language}/${file}.html">${ui.fileTitles[file]}</a>. ${ui.fileAbouts[file]}</p>`);
        const listing = words.listing ? `<p>${words.listing.about}</p><pre><code>${escaped(words.listing.code)}</code></pre>` : "";
        return `<h2 id="${lesson.id}">${index + 1}. ${words.title}</h2>${[...words.before.map(say), ...figures, ...words.after.map(say), listing, ...questions, ...home].join("\n")}<p class="source">${ui.of} ${words.source}</p>`;
    });
    const glossary = Object.entries(text.terms).map(([term, explanation]) => `<p><b>${term}</b>: ${explanation}</p>`);
    const contents = lessons.map(({ id }) => `<li><a href="#${id}">${text.lessons[id]!.title}</a></li>`);
    return `<!doctype html>
<html lang="${language}"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>${ui.title}</title><link rel="icon" href="../icon.svg"><style>${style}</style></head>
<body><main><h1>${ui.coverTitle}</h1><p>${filled(ui.lead, { count: String(lessons.length) })}</p><nav><ol>${contents.join("")}</ol></nav>
${body.join("\n")}
<h2>${ui.glossary}</h2>${glossary.join("\n")}</main></body></html>
`;
}
