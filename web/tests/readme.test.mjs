// Every example of the package's README on a page, as a reader would paste it.
import assert from "node:assert/strict";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { desktop, visit } from "./browser.mjs";

const packageFolder = path.resolve(import.meta.dirname, "../sinew");
const examples = [...(await readFile(path.join(packageFolder, "README.md"), "utf8")).matchAll(/^## (.*)$|```js\n([^]*?)```/gm)]
    .reduce(({ title, found }, [, heading, code]) => ({ title: heading ?? title, found: code ? [...found, { title, code }] : found }), { title: "ten lines", found: [] }).found;

let site;
before(async () => {
    const root = await mkdtemp(path.join(os.tmpdir(), "sinew-readme-"));
    await cp(packageFolder, path.join(root, "sinew"), { recursive: true, filter: (name) => !/node_modules|\/test(\/|$)|-threads|float/.test(name) });
    for (const [i, { code }] of examples.entries()) {
        const canvas = '<canvas width="640" height="480"></canvas>';
        const map = '<script type="importmap">{"imports": {"sinew": "./sinew/index.js", "sinew/inline": "./sinew/sinew-inline.js"}}</script>';
        await writeFile(path.join(root, `${i}.html`), `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">${canvas}${map}<script type="module">${code}\nglobalThis.isDone = true;</script>`);
    }
    site = { ...(await visit(root)), root };
});
after(async () => {
    await site.end();
    await rm(site.root, { recursive: true });
});

for (const [i, { title, code }] of examples.entries())
    test(`the example of "${title}" runs on a page`, { timeout: 60_000 }, async () => {
        // The time of a frame may lie before the last call of performance.now(), as in a page that has been busy.
        const early = () => {
            window.said = [];
            console.log = (...words) => window.said.push(...words);
            const ask = window.requestAnimationFrame.bind(window);
            let first = true;
            window.requestAnimationFrame = (work) => ask((now) => work(first ? ((first = false), now - 1000) : now));
        };
        await site.on({ ...desktop, script: early }, `${i}.html`, async (page) => {
            await page.waitForFunction(() => globalThis.isDone, null, { timeout: 30_000 });
            const said = await page.evaluate(() => window.said);
            assert.equal(said.length > 0, code.includes("console.log"));
            assert.ok(said.every((word) => word === true || word === 101), `${said}`);
            if (!code.includes("querySelector(\"canvas\")")) return;
            const taken = () => page.evaluate(() => document.querySelector("canvas").toDataURL());
            await page.waitForTimeout(300);
            const first = await taken();
            await page.waitForTimeout(500);
            assert.notEqual(await taken(), first, "the picture moves");
        });
    });
