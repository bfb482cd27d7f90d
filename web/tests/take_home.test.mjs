// The files that readers of the lessons take home, in the browser, from a folder of their own.
import assert from "node:assert/strict";
import { copyFile, cp, mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { desktop, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

/** Waits until the picture of a page's canvas has changed twice: once could be its first. */
async function moves(page, what) {
    for (let i = 0; i < 2; ++i) {
        const before = await page.evaluate(() => document.querySelector("canvas").toDataURL());
        await page.waitForFunction((before) => document.querySelector("canvas").toDataURL() !== before, before, { timeout: 20_000, polling: 100 }).catch(() => assert.fail(`${what} stands still`));
    }
}

const names = ["sticks", "rope", "cloth", "ragdoll"];
const made = (language, name) => path.resolve(import.meta.dirname, `../dist/take_home/${language}/${name}.html`);

test("files to take home are the same program in every language", async () => {
    const program = async (language, name) => (await readFile(made(language, name), "utf8")).replace(/ *\/\/ .*|<title>.*/g, "");
    for (const name of [...names, "package"]) assert.equal(await program("de", name), await program("en", name), name);
});

for (const name of names)
    test(`${name}.html to take home runs by itself, from a folder, without a server`, { timeout: 120_000 }, async () => {
        const file = path.join(site.folder, `${name}.html`), page = await site.browser.newPage({ viewport: { width: 640, height: 480 } }), complaints = [];
        await copyFile(made("en", name), file);
        page.on("pageerror", (error) => complaints.push(String(error)));
        page.on("request", (request) => request.url().startsWith("http") && complaints.push(request.url()));
        await page.goto(pathToFileURL(file).href);
        await moves(page, name);
        await page.mouse.move(200, 120);
        await page.mouse.down();
        await page.mouse.move(500, 300, { steps: 5 });
        await page.mouse.up();
        await moves(page, `${name} after a throw`);
        assert.deepEqual(complaints, []);
        await page.close();
    });

test("the last file to take home runs on the package", { timeout: 60_000 }, async () => {
    const root = path.join(site.folder, "own"), files = path.resolve(import.meta.dirname, "../sinew");
    await mkdir(root, { recursive: true });
    await cp(files, path.join(root, "sinew"), { recursive: true, filter: (name) => !/node_modules|\/test\/|-threads|float/.test(name) });
    await copyFile(made("en", "package"), path.join(root, "package.html"));
    await writeFile(path.join(root, "index.html"), "<!doctype html>");
    const own = await visit(root);
    try {
        await own.on(desktop, "package.html", async (page) => {
            await moves(page, "the package's man");
        });
    } finally {
        await own.end();
    }
});
