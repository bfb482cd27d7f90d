// The files that readers of the lessons take home, in the browser, from a folder of their own.
import assert from "node:assert/strict";
import { copyFile, cp, mkdir, writeFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { desktop, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

/** True if the picture of a page's canvas changes. */
async function moves(page) {
    const taken = () => page.evaluate(() => document.querySelector("canvas").toDataURL());
    const first = await taken();
    await page.waitForTimeout(400);
    return first !== (await taken());
}

test("files to take home run by themselves, from a folder, without a server", { timeout: 120_000 }, async () => {
    for (const language of ["en", "de"]) for (const name of ["sticks", "rope", "cloth", "ragdoll"]) {
        const from = path.resolve(import.meta.dirname, `../dist/take_home/${language}/${name}.html`), file = path.join(site.folder, `${name}.html`);
        await copyFile(from, file);
        const page = await site.browser.newPage({ viewport: { width: 640, height: 480 } });
        const complaints = [];
        page.on("pageerror", (error) => complaints.push(String(error)));
        page.on("request", (request) => request.url().startsWith("http") && complaints.push(request.url()));
        await page.goto(pathToFileURL(file).href);
        assert.ok(await moves(page), `${name} stands still`);
        await page.mouse.move(200, 120);
        await page.mouse.down();
        await page.mouse.move(500, 300, { steps: 5 });
        await page.mouse.up();
        assert.ok(await moves(page), name);
        assert.deepEqual(complaints, []);
        await page.close();
    }
});

test("the last file to take home runs on the package", { timeout: 60_000 }, async () => {
    const root = path.join(site.folder, "own"), files = path.resolve(import.meta.dirname, "../sinew");
    await mkdir(root, { recursive: true });
    await cp(files, path.join(root, "sinew"), { recursive: true, filter: (name) => !/node_modules|\/test\/|-threads|float/.test(name) });
    await copyFile(path.resolve(import.meta.dirname, "../dist/take_home/en/package.html"), path.join(root, "package.html"));
    await writeFile(path.join(root, "index.html"), "<!doctype html>");
    const own = await visit(root);
    try {
        await own.on(desktop, "package.html", async (page) => {
            await page.waitForTimeout(500);
            assert.ok(await moves(page));
        });
    } finally {
        await own.end();
    }
});
