// The lessons as their tests read them: texts, programs that run without a browser, scenes on the engine.
import assert from "node:assert/strict";
import path from "node:path";
import { createServer } from "vite";
import { programOf } from "../../learn/program/headless.mjs";
import { load } from "../../sinew/index.js";

const server = await createServer({ root: path.resolve(import.meta.dirname, "../.."), configFile: false, logLevel: "error", server: { middlewareMode: true, ws: false }, optimizeDeps: { noDiscovery: true } });
export const { texts, lessons, ownText, files, printed } = await server.ssrLoadModule("/learn/print.ts");
export const { withValue, textOf } = await server.ssrLoadModule("/learn/lesson.ts");
export const { sceneText } = await server.ssrLoadModule("/learn/scene_text.ts");
export const words = await server.ssrLoadModule("/learn/words.ts");
await server.close();
export const engine = await load();
export { programOf };

export const lesson = (id) => lessons.find((one) => one.id === id);
export const isProgram = (figure) => "program" in figure;
export const everyFigure = () => lessons.flatMap((one) => one.figures.map((figure, i) => ({ id: one.id, i, figure })));

/** Text of a lesson's program with one of its numbers set. */
export function programText(id, name, value, i = 0) {
    const text = withValue(lesson(id).figures[i].program, name, value);
    assert.match(text, new RegExp(`(let|const) ${name} = ${value};`), `${id} has no ${name}`);
    return text;
}

/** A running program of a lesson, maybe with parts of its text replaced: [from, to], each of which must be there. */
export function program(id, name, value, { i = 0, replaced = [], added = "" } = {}) {
    let text = programText(id, name, value, i);
    for (const [from, to] of replaced) {
        assert.ok(typeof from === "string" ? text.includes(from) : from.test(text), `${id} has no ${from}`);
        text = text.replaceAll(from, to);
    }
    return programOf(`${text}\n${added}`);
}

/** The file of a lesson's scene. */
export const sceneFile = (id, value, i = 0) => JSON.parse(textOf(lesson(id).figures[i], value, texts.en.lessons[id].figures[i], sceneText));
/** A running scene of a lesson. */
export const scene = (id, value, overrides = {}, i = 0) => engine.open(textOf(lesson(id).figures[i], value, texts.en.lessons[id].figures[i], sceneText), { overrides });

export const close = (found, wanted, share, name = "") => assert.ok(Math.abs(found - wanted) <= share * Math.abs(wanted), `${name} ${found}, not ${wanted} within ${100 * share} %`);
export const above = (found, least, name = "") => assert.ok(found > least, `${name} ${found}, not above ${least}`);
export const below = (found, most, name = "") => assert.ok(found < most, `${name} ${found}, not below ${most}`);

/** Largest of a number shown in the last of so many seconds. */
export function atRest(running, name = "stretch", seconds = 15) {
    running.run(60 * (seconds - 1));
    return Math.max(...Array.from({ length: 60 }, () => running.run(1).live[name]));
}

/** A number shown in each of so many frames. */
export const series = (running, name, frames) => Array.from({ length: frames }, () => running.run(1).live[name]);

/** Moves the hand of a program and takes a frame. */
export function handAt(running, x, y, isDown = true) {
    Object.assign(running.pointer, { x, y, isDown });
    return running.run(1).live;
}

/** A text as it is read: without marks, with the words for a mouse. */
export const plain = (text) => text.replace(/«([^|»]*)\|[^»]*»/g, "$1").replace(/\[\[([^\]|]+)(?:\|[^\]]+)?\]\]/g, "$1").replace(/<[^>]*>/g, "");

/** Sentences of a lesson: of its paragraphs, its answers and the tasks of its figures. */
export function sentencesOf({ before, figures, after, questions = [] }) {
    return [...before, ...figures.map(({ task }) => task), ...after, ...questions.map(([, answer]) => answer)]
        .flatMap((text) => plain(text).split(/(?<=[.!?:][”)]?) +(?=[A-Z0-9“(π])/));
}

/** Claims of the lessons, and the functions that try them. `says` are parts of sentences of the English text. */
export const claims = [];
export const claim = (id, says, holds) => void claims.push({ id, says: [says].flat(), holds });
