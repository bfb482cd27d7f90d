import "../common/base.css";
import "./learn.css";
import { byId, el, type Child } from "../common/dom.js";
import { loadEngine, type Loaded } from "../common/engine.js";
import { icon } from "../common/icons.js";
import { stayFresh } from "../common/fresh.js";
import { workOffline } from "../common/offline.js";
import { applyTheme, setTheme, theme } from "../common/theme.js";
import { FigureView } from "./figure_view.js";
import { filled, isProgram, type Lesson } from "./lesson.js";
import { lessons } from "./lessons/lessons.js";
import { isSeen, isSolved, markSeen } from "./progress.js";
import { language, languages, loadText, setLanguage, type Text } from "./text/text.js";
import { html, keepTipsOnPage } from "./words.js";

history.scrollRestoration = "manual"; // a lesson begins at its head, where its figure moves: see follow()
applyTheme();
stayFresh();
workOffline("../sw.js");

const page = byId("lesson"), contents = byId("contents");
let views: FigureView[] = [];
let text: Text = await loadText(language());
let loading: Promise<Loaded> | null = null;
const engine = (): Promise<Loaded> => (loading ??= loadEngine());

const hasChallenge = ({ id }: Lesson): boolean => text.lessons[id]!.figures.some(({ challenge }) => challenge !== undefined);
const isWhollySolved = (lesson: Lesson): boolean => hasChallenge(lesson) && lesson.figures.every((_, i) => !text.lessons[lesson.id]!.figures[i]!.challenge || isSolved(figureId(lesson, i)));
const figureId = (lesson: Lesson, i: number): string => (i === 0 ? lesson.id : `${lesson.id}-${i + 1}`);
const titleOf = (lesson: Lesson): string => text.lessons[lesson.id]!.title;

/** The bars around the page, in the language of the text. */
function dress(): void {
    const { ui } = text, name = language();
    document.documentElement.lang = name;
    byId("menu").replaceChildren(
        el("a", { class: "button quiet", href: "../", "aria-label": ui.scenes }, icon("scenes"), el("span", {}, ui.scenes)),
        el("a", { class: "button quiet", href: "#", "aria-label": ui.lessons }, icon("lessons"), el("span", {}, ui.lessons)),
        el("button", { type: "button", class: "quiet language", lang: languages.find((other) => other !== name), onclick: () => void switchLanguage() }, ui.otherLanguage),
        el("button", { type: "button", class: "quiet theme", "aria-label": ui.theme, title: ui.lightOrDark, onclick: switchTheme }, icon("theme"), el("span", {}, ui.theme)));
    contents.setAttribute("aria-label", ui.lessons);
    contents.replaceChildren(el("ol", {}, ...lessons.map((lesson) => el("li", {}, el("a", { href: `#${lesson.id}` }, titleOf(lesson))))));
    showProgress();
}

function showProgress(): void {
    lessons.forEach((lesson, i) => {
        const link = contents.querySelectorAll("a")[i];
        link?.classList.toggle("seen", isSeen(lesson.id));
        link?.classList.toggle("solved", isWhollySolved(lesson));
    });
}

function switchTheme(): void {
    setTheme(theme() === "dark" ? "light" : "dark");
    applyTheme();
    for (const view of views) view.setTheme();
}

async function switchLanguage(): Promise<void> {
    const other = languages[(languages.indexOf(language()) + 1) % languages.length]!;
    setLanguage(other);
    const address = new URL(location.href);
    address.searchParams.delete("language");
    history.replaceState(null, "", address);
    text = await loadText(other);
    dress();
    await follow();
}

/** A paragraph of a lesson's own HTML. */
function paragraph(words: string): HTMLElement {
    const element = el("p");
    element.innerHTML = html(words, text.terms);
    return element;
}

function cover(): void {
    const { ui } = text, begun = lessons.find(({ id }) => !isSeen(id)) ?? lessons[0]!;
    document.title = ui.title;
    page.replaceChildren(
        el("h1", {}, ui.coverTitle),
        el("p", { class: "lead" }, filled(ui.lead, { count: String(lessons.length) })),
        el("p", {}, el("a", { class: "button on", href: `#${begun.id}` }, `${begun === lessons[0] ? ui.begin : ui.goOn}: ${titleOf(begun)}`)),
        el("ol", { class: "cover" }, ...lessons.map((lesson) => el("li", { class: isWhollySolved(lesson) ? "solved" : isSeen(lesson.id) ? "seen" : "" },
            el("a", { href: `#${lesson.id}` }, el("b", {}, titleOf(lesson)), plain(text.lessons[lesson.id]!.figures[0]!.task))))),
        el("p", { class: "source" }, el("a", { href: `print.${language()}.html` }, ui.printed)));
}

function plain(words: string): HTMLElement {
    const element = el("span");
    element.innerHTML = html(words, text.terms).replace(/<span class="term".*?>(.*?)<span class="tip".*?<\/span><\/span>/g, "$1");
    return element;
}

function takeHome(files: string[]): Child {
    const { ui } = text;
    return el("section", { class: "home", "aria-label": ui.takeHome }, el("h2", {}, ui.takeHome), el("p", {}, ui.takeHomeAbout),
        ...files.map((file) => {
            const href = `../take_home/${language()}/${file}.html`;
            return el("p", { class: "file" }, el("span", {}, el("b", {}, ui.fileTitles[file]!), ` ${ui.fileAbouts[file]!}`), file !== "package" && el("a", { class: "button", href, target: "_blank" }, icon("play"), ui.look),
                el("a", { class: "button", href, download: `${file}.html` }, icon("save"), ui.save));
        }));
}

async function show(lesson: Lesson): Promise<void> {
    const { ui } = text, words = text.lessons[lesson.id]!;
    const index = lessons.indexOf(lesson), before = lessons[index - 1], next = lessons[index + 1];
    document.title = `${words.title} – ${ui.title}`;
    const loaded = lesson.figures.every(isProgram) ? null : await engine();
    if (location.hash.slice(1) !== lesson.id) return;
    const shown = (views = lesson.figures.map((figure, i) => new FigureView(figureId(lesson, i), figure, words.figures[i]!, ui, text.terms, words.title, loaded)));
    page.replaceChildren(
        el("p", { class: "number" }, filled(ui.lesson, { number: String(index + 1), count: String(lessons.length) })),
        el("h1", {}, words.title),
        ...words.before.map(paragraph), ...shown.map(({ root }) => root), ...words.after.map(paragraph),
        ...(words.listing ? [el("p", {}, words.listing.about), el("pre", { class: "listing", tabindex: 0 }, el("code", {}, words.listing.code))] : []),
        ...(words.questions ?? []).map(([question, answer]) => el("details", { class: "question" }, el("summary", {}, question), paragraph(answer))),
        ...(lesson.files ? [takeHome(lesson.files) as Node] : []),
        el("p", { class: "source" }, `${ui.of} ${words.source}`),
        el("nav", { class: "turn", "aria-label": ui.neighbours },
            before && el("a", { class: "button", href: `#${before.id}` }, `← ${titleOf(before)}`),
            next ? el("a", { class: "button on", href: `#${next.id}` }, `${titleOf(next)} →`) : el("a", { class: "button on", href: "../" }, `${ui.toPlayground} →`)));
    for (const view of shown) view.begin();
    markSeen(lesson.id);
}

async function follow(): Promise<void> {
    const id = location.hash.slice(1);
    const lesson = lessons.find((one) => one.id === id);
    for (const view of views) view.end();
    views = [];
    for (const link of contents.querySelectorAll("a")) link.toggleAttribute("aria-current", link.hash === `#${id}`);
    contents.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest", inline: "center" });
    if (lesson) await show(lesson);
    else cover();
    scrollTo(0, 0);
}

Object.defineProperty(window, "sinew", { get: () => ({ views, lessons: lessons.map(({ id, figures }) => ({ id, figures: figures.length })) }) }); // for the browser's console
document.addEventListener("progress", showProgress);
addEventListener("hashchange", () => void follow());
keepTipsOnPage(page);
dress();
try {
    await follow();
} catch (error) {
    page.replaceChildren(el("p", { role: "alert" }, `${text.ui.failed} ${error instanceof Error ? error.message : error}`));
    throw error;
}
