import "../common/base.css";
import "./learn.css";
import { byId, el } from "../common/dom.js";
import { loadEngine } from "../common/engine.js";
import { icon } from "../common/icons.js";
import { workOffline } from "../common/offline.js";
import { applyTheme, setTheme, theme } from "../common/theme.js";
import { FigureView } from "./figure_view.js";
import type { Lesson } from "./lesson.js";
import { lessons } from "./lessons/lessons.js";

applyTheme();
workOffline("../sw.js");

const page = byId("lesson"), contents = byId("contents");
let view: FigureView | null = null;

byId("menu").append(
    el("a", { class: "button quiet", href: "../", "aria-label": "scenes" }, icon("scenes"), el("span", {}, "scenes")),
    el("a", { class: "button quiet", href: "#", "aria-label": "lessons" }, icon("lessons"), el("span", {}, "lessons")),
    el("button", { type: "button", class: "quiet theme", "aria-label": "theme", title: "light or dark", onclick: switchTheme }, icon("theme"), el("span", {}, "theme")));
contents.append(el("ol", {}, ...lessons.map(({ id, title }) => el("li", {}, el("a", { href: `#${id}` }, title)))));

function switchTheme(): void {
    setTheme(theme() === "dark" ? "light" : "dark");
    applyTheme();
    view?.setTheme();
}

/** A paragraph of a lesson's own HTML. */
function paragraph(html: string): HTMLElement {
    const element = el("p");
    element.innerHTML = html;
    return element;
}

function cover(): void {
    document.title = "Sinew lessons";
    page.replaceChildren(
        el("h1", {}, "From a point to a ragdoll"),
        el("p", { class: "lead" }, "Ropes, cloth and people that fall down stairs: all of them are points, and a few rules that are mended again and again. ",
            `${lessons.length} short lessons, each with a figure to drag and one slider that matters. You need to know what x and y are, and to have written a small program once.`),
        el("p", {}, el("a", { class: "button on", href: `#${lessons[0]!.id}` }, "Begin: a point falls")),
        el("ol", { class: "cover" }, ...lessons.map(({ id, title, figure }) => el("li", {}, el("a", { href: `#${id}` }, el("b", {}, title), el("span", {}, figure.task))))));
}

async function show(lesson: Lesson): Promise<void> {
    const index = lessons.indexOf(lesson), before = lessons[index - 1], next = lessons[index + 1];
    document.title = `${lesson.title} – Sinew lessons`;
    const loaded = await loading;
    if (location.hash.slice(1) !== lesson.id) return;
    const shown = (view = new FigureView(loaded, lesson));
    page.replaceChildren(
        el("p", { class: "number" }, `Lesson ${index + 1} of ${lessons.length}`),
        el("h1", {}, lesson.title),
        ...lesson.before.map(paragraph), shown.root, ...lesson.after.map(paragraph),
        ...(lesson.questions ?? []).map(([question, answer]) => el("details", { class: "question" }, el("summary", {}, question), paragraph(answer))),
        el("p", { class: "source" }, `After: ${lesson.source}`),
        el("nav", { class: "turn", "aria-label": "Neighbours" },
            before && el("a", { class: "button", href: `#${before.id}` }, `← ${before.title}`),
            next ? el("a", { class: "button on", href: `#${next.id}` }, `${next.title} →`) : el("a", { class: "button on", href: "../" }, "To the playground →")));
    shown.begin();
}

async function follow(): Promise<void> {
    const id = location.hash.slice(1);
    const lesson = lessons.find((one) => one.id === id);
    view?.end();
    view = null;
    for (const link of contents.querySelectorAll("a")) link.toggleAttribute("aria-current", link.hash === `#${id}`);
    contents.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest", inline: "center" });
    if (lesson) await show(lesson);
    else cover();
    scrollTo(0, 0);
}

const loading = loadEngine();
Object.defineProperty(window, "sinew", { get: () => view }); // for the browser's console
addEventListener("hashchange", () => void follow());
try {
    await follow();
} catch (error) {
    page.replaceChildren(el("p", { role: "alert" }, `Sinew did not start: ${error instanceof Error ? error.message : error}`));
    throw error;
}
