// The examples for pages, built with the packed package as their README says, move in Chromium and answer the pointer.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { visit } from "./browser.mjs";

const web = path.resolve(import.meta.dirname, "..");
const kept = process.env.SINEW_EXAMPLES; // a folder for pictures, and for what was installed
let folder, site;
before(async () => {
    folder = kept ?? (await mkdtemp(path.join(tmpdir(), "sinew-examples-")));
    const run = (command, ...words) => execFileSync(command, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
    await cp(path.resolve(web, "../examples/web"), folder, { recursive: true, filter: (name) => !name.includes("node_modules") });
    const packed = run("npm", "pack", path.join(web, "sinew"), "--silent").trim();
    run("npm", "ci", "--no-audit", "--no-fund", "--loglevel=error");
    run("npm", "install", "--no-save", "--no-audit", "--no-fund", "--loglevel=error", `./${packed}`);
    run("npx", "vite", "build", "--logLevel", "warn");
    site = await visit(path.join(folder, "dist"));
});
after(async () => {
    await site?.end();
    if (!kept) await rm(folder, { recursive: true, force: true });
});

test("none has 150 lines", async () => {
    for (const name of ["three.js", "pixi.js", "phaser.js", "p5.js", "react.jsx", "clock.js"])
        assert.ok((await readFile(path.join(folder, name), "utf8")).split("\n").length <= 150, name);
});

test("their types are right, strictly", () => {
    execFileSync("npx", ["tsc", "--project", "."], { cwd: folder, stdio: ["ignore", "inherit", "inherit"] });
});

for (const name of ["three", "pixi", "phaser", "p5", "react"])
    test(`${name} moves, and follows the pointer`, () =>
        site.on({ viewport: { width: 900, height: 620 } }, `${name}.html`, async (page) => {
            const canvas = page.locator("canvas").first();
            await canvas.waitFor({ timeout: 60_000 });
            const picture = async (after) => (await page.waitForTimeout(after), page.screenshot());
            const early = await picture(500);
            let late = await picture(1000);
            for (let i = 0; i < 20 && early.equals(late); ++i) late = await picture(1000); // a slow machine is still loading
            assert.ok(!early.equals(late), "it moves");
            const box = await canvas.boundingBox();
            await page.mouse.move(box.x + box.width / 2, box.y + box.height / 3);
            await page.mouse.down();
            await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2, { steps: 8 });
            const pulled = await picture(300);
            assert.ok(pulled.length > 6000, "something is painted"); // a page of one colour has 3 KB
            if (kept) await writeFile(path.join(folder, `${name}.png`), pulled);
            await page.mouse.up();
        }));
