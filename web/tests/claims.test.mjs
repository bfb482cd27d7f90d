// Every claim of every lesson, tried: each sentence of their texts is held by a test, or claims nothing.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import "./claims/bodies.mjs";
import "./claims/cloths.mjs";
import "./claims/exact.mjs";
import "./claims/points.mjs";
import "./claims/shapes.mjs";
import "./claims/steps.mjs";
import { claimless } from "./claims/claimless.mjs";
import { claims, lessons, plain, sentencesOf, texts } from "./claims/reader.mjs";

describe("claims", () => {
    for (const [i, { id }] of lessons.entries())
        for (const { says, holds } of claims.filter((one) => one.id === id)) test(`${i + 1}: ${says[0]}`, holds);
});

test("every sentence of every lesson is held by a test, or claims nothing", () => {
    const open = lessons.flatMap(({ id }) => {
        const held = claims.filter((one) => one.id === id).flatMap(({ says }) => says);
        return sentencesOf(texts.en.lessons[id]).filter((sentence) => ![...held, ...claimless[id] ?? []].some((part) => sentence.includes(part))).map((sentence) => `${id}: ${sentence}`);
    });
    assert.deepEqual(open, []);
});

test("what the tests hold is said by the lessons", () => {
    const gone = lessons.flatMap(({ id }) => {
        const text = texts.en.lessons[id], said = [...sentencesOf(text), text.listing?.about ?? ""].join(" ");
        return [...claims.filter((one) => one.id === id).flatMap(({ says }) => says), ...claimless[id] ?? []].filter((part) => !said.includes(part)).map((part) => `${id}: ${part}`);
    });
    assert.deepEqual(gone, []);
    assert.ok(claims.every(({ id }) => lessons.some((one) => one.id === id)));
});

/** Numbers of a text, in their order of size. */
const numbersOf = (text) => (plain(text).replace(/(\d),(\d)/g, "$1.$2").match(/\d+(\.\d+)?/g) ?? []).sort();

test("every language states the numbers that the tests hold", () => {
    for (const [name, { lessons: said }] of Object.entries(texts)) for (const [id, text] of Object.entries(said)) {
        const english = texts.en.lessons[id];
        for (const part of ["before", "after"]) text[part].forEach((paragraph, i) => assert.deepEqual(numbersOf(paragraph), numbersOf(english[part][i]), `${name} ${id} ${part} ${i}`));
        text.figures.forEach(({ task, challenge = "" }, i) => assert.deepEqual(numbersOf(task + challenge), numbersOf(english.figures[i].task + (english.figures[i].challenge ?? "")), `${name} ${id}`));
        (text.questions ?? []).forEach(([, answer], i) => assert.deepEqual(numbersOf(answer), numbersOf(english.questions[i][1]), `${name} ${id}`));
    }
});
