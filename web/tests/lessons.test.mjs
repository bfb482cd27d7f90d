// The lessons without a browser: every language, program, scene and file; claims.test.mjs tries what the texts claim.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { ofProgram } from "../learn/program/svg.mjs";
import { engine, everyFigure, files, isProgram, lessons, ownText, printed, program, programOf, scene, sceneText, textOf, texts, withValue, words } from "./claims/reader.mjs";

const valuesOf = ({ low, high, value, step }) => [...new Set([low, value, high, low + Math.round((high - low) / step / 2) * step])];

/** Strings of a tree of texts, by their paths. */
function leaves(value, at = "") {
    if (typeof value === "string") return [[at, value]];
    return Object.entries(value ?? {}).flatMap(([key, one]) => leaves(one, `${at}/${key}`));
}

describe("languages", () => {
    test("every language says the same things", () => {
        const shape = (text) => leaves({ ui: text.ui, lessons: text.lessons }).map(([at]) => at).sort();
        for (const [name, text] of Object.entries(texts)) {
            assert.deepEqual(shape(text), shape(texts.en), name);
            assert.deepEqual(Object.keys(text.lessons), lessons.map(({ id }) => id), name);
            for (const [at, said] of leaves(text)) assert.ok(said.trim() !== "", `${name}${at} is empty`);
        }
    });

    test("terms are explained, words for mouse and finger come in pairs, and no mark is left", () => {
        for (const [name, text] of Object.entries(texts)) for (const [at, said] of leaves(text.lessons)) {
            assert.deepEqual(words.unexplained(said, text.terms), [], `${name}${at}`);
            assert.doesNotMatch(words.html(said, text.terms), /[«»]|\[\[|\]\]/, `${name}${at}`);
        }
    });

    test("every word of a program is said, and nothing else", () => {
        for (const [name, text] of Object.entries(texts)) for (const { id, i, figure } of everyFigure()) {
            if (!isProgram(figure)) continue;
            const wanted = [...figure.program.matchAll(/(?<!\$)\{([a-z][A-Za-z0-9]*)\}/g)].map(([, word]) => word).filter((word) => new RegExp(`// \\{${word}\\}|"\\{${word}\\}"`).test(figure.program));
            assert.deepEqual(Object.keys(text.lessons[id].figures[i].comments ?? {}).sort(), [...new Set(wanted)].sort(), `${name} ${id}`);
        }
    });

    test("numbers in the texts are numbers of the figures", () => {
        for (const text of Object.values(texts)) for (const one of lessons) {
            const wanted = text.lessons[one.id].after.flatMap((said) => [...said.matchAll(/<output name="(\w+)"/g)].map(([, name]) => name));
            const live = Object.assign({}, ...one.figures.map((figure, i) => isProgram(figure)
                ? programOf(ownText(figure, one.id, i, "en")).run(2).live : figure.live?.(scene(one.id, figure.slider.value, {}, i), figure.slider.value)));
            for (const name of wanted) assert.ok(name in live, `${one.id}: ${name}`);
        }
    });
});

describe("figures", () => {
    test("every program runs with every value of its slider, in every language, under a hand, and draws finite things", () => {
        for (const language of Object.keys(texts)) for (const { id, i, figure } of everyFigure()) {
            if (!isProgram(figure)) continue;
            for (const value of valuesOf(figure.slider)) {
                const running = programOf(withValue(ownText(figure, id, i, language), figure.sets, value));
                const drawn = [running.run(5)];
                if (language !== "en") continue;
                Object.assign(running.pointer, { isDown: true, x: 320, y: 200 });
                for (let step = 0; step < 20; ++step) {
                    Object.assign(running.pointer, { x: 320 + 15 * step, y: 200 - 9 * step });
                    drawn.push(running.run(1));
                }
                running.pointer.isDown = false;
                drawn.push(running.run(60));
                for (const { commands, live } of drawn) {
                    assert.ok(commands.length > 2, id);
                    assert.ok(Object.values(live).every(Number.isFinite), `${id} ${value}: ${JSON.stringify(live)}`);
                    assert.ok(commands.flat(3).every((one) => typeof one === "string" || Number.isFinite(one)), `${id} ${value}`);
                }
            }
        }
    });

    test("every scene is complete, opens with every value of its slider, and stays finite", () => {
        for (const { id, i, figure } of everyFigure()) {
            if (isProgram(figure)) continue;
            for (const value of valuesOf(figure.slider)) {
                const text = textOf(figure, value, texts.en.lessons[id].figures[i], sceneText);
                assert.equal(JSON.parse(text).sinew, 1, id);
                const simulation = engine.open(text);
                simulation.runUntil(0.5);
                assert.ok(simulation.positions.every(Number.isFinite), `${id} ${value}`);
                simulation.dispose();
            }
        }
    });

    test("files to take home have at most 60 lines, need nothing, and speak every language", () => {
        for (const language of Object.keys(texts)) {
            const made = files(language);
            assert.deepEqual(made.map(([address]) => address.replace(/.*\/|\.html/g, "")).sort(), lessons.flatMap((one) => one.files ?? []).sort());
            for (const [address, content] of made) {
                assert.ok(content.trimEnd().split("\n").length <= 60, `${address}: ${content.trimEnd().split("\n").length} lines`);
                assert.doesNotMatch(content, /https?:|\/\/ \{|<title>\{/, address);
                if (!address.includes("package")) assert.match(content, /setInterval\(\(\) => \{\n    step\(1 \/ 60\);[^]*\}, 1000 \/ 60\);/, `${address} keeps its own time, whatever the screen's`);
                assert.equal(/\bimport\b/.test(content), address.includes("package"), address);
            }
        }
    });

    test("a printed graph has the lines of the one on the page", () => {
        const { commands } = program("iterations", "passes", 4).run(10), picture = ofProgram(commands.filter(([shape]) => shape === "graph"));
        assert.equal(picture.match(/<polyline/g).length, 1 + 5, "the curve, and lines at 0.1, 1, 10, 100 and 1000 %");
    });

    test("all lessons are on one page, with a picture of each figure", () => {
        for (const [language, text] of Object.entries(texts)) {
            const page = printed(language, () => "<svg></svg>");
            for (const one of lessons) assert.ok(page.includes(`<h2 id="${one.id}">`) && page.includes(text.lessons[one.id].title));
            assert.equal(page.match(/<svg>/g).length, everyFigure().length);
            assert.ok(!/[«»]|\[\[/.test(page.replace(/<pre>.*?<\/pre>/gs, "")), language);
        }
    });
});

