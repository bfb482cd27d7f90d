// The scene as text, its errors, and as an address.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { desktop, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

async function openEditor(page) {
    await playing(page);
    await page.getByRole("tab", { name: "text" }).click();
    await page.locator(".cm-content").waitFor();
}

/** Replaces the first occurrence of a text in the editor, as a user who selects and types. */
async function replace(page, from, to) {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.press("Control+f");
    await page.locator(".cm-search input[name=search]").pressSequentially(from); // the panel listens to keys
    await page.keyboard.press("Enter");
    await page.keyboard.press("Escape");
    await page.keyboard.insertText(to);
}

test("a sentence of the text changes the running scene", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await openEditor(page);
        await replace(page, '"weight": 8', '"weight": 99');
        await page.waitForFunction(() => /"weight": ?99/.test(window.sinew.stage.player.sceneText()), null, { timeout: 10_000 });
        await page.waitForFunction(() => location.hash.includes("z=") || location.hash.includes("weight"), null, { timeout: 10_000 });
    }));

test("errors stand at their lines, all at once, and the scene goes on", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await openEditor(page);
        const lines = (await page.evaluate(() => window.sinew.opened.text)).split("\n");
        await replace(page, '"gravity"', '"gravitty"');
        await replace(page, '"segments": 40', '"segments": -3');
        await page.waitForFunction(() => document.querySelectorAll(".problems button").length >= 2, null, { timeout: 10_000 });
        const problems = await page.locator(".problems button").allTextContents();
        const at = (text) => lines.findIndex((line) => line.includes(text)) + 1;
        assert.ok(problems.some((text) => text.startsWith(`${at('"gravity"')}:`) && text.includes("gravitty") && text.includes('"gravity"')), problems.join("\n"));
        assert.ok(problems.some((text) => text.startsWith(`${at('"segments": 40')}:`)), problems.join("\n"));
        assert.ok(await page.locator(".cm-lintRange-error").count() >= 1);
        const step = await page.evaluate(() => window.sinew.stage.player.state().step);
        await page.waitForFunction((step) => window.sinew.stage.player.state().step > step + 5, step);
    }));

test("names and words are completed from the schema", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await openEditor(page);
        await page.locator(".cm-content").click();
        await page.keyboard.press("Control+Home");
        await page.keyboard.press("End");
        await page.keyboard.press("Enter");
        await page.keyboard.type('"fig');
        const option = page.locator(".cm-tooltip-autocomplete li", { hasText: "figures" });
        await option.waitFor({ timeout: 5000 });
    }));

test("a slider's change is in the address, which leads back to the same scene", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        await page.evaluate(() => {
            window.sinew.stage.player.set("world.damping", 0.25);
            window.sinew.changed();
        });
        await page.waitForFunction(() => location.hash.includes("world.damping=0.25"), null, { timeout: 10_000 });
        assert.match(await page.evaluate(() => location.hash), /^#scene=rope&/);
        const text = await page.evaluate(() => window.sinew.stage.player.sceneText());
        await page.reload();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.sceneText()), text);
    }));

test("a scene of one's own fits in the address", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await openEditor(page);
        await replace(page, '"name": "line"', '"name": "täu ☂"');
        await page.waitForFunction(() => location.hash.startsWith("#z="), null, { timeout: 10_000 });
        const [text, hash] = await page.evaluate(() => [window.sinew.stage.player.sceneText(), location.hash]);
        assert.ok(hash.length < 2500, `${hash.length} characters`);
        await page.reload();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.sceneText()), text);
    }));

test("the pairs of the command line work in an address, and wrong ones are told", () =>
    site.on(desktop, "#scene=rope&mode=classic&world.gravity.1=0.125", async (page) => {
        await playing(page);
        const text = await page.evaluate(() => window.sinew.stage.player.sceneText());
        assert.match(text, /0\.125/);
        assert.match(text, /"mode": ?"classic"/);
        await page.evaluate(() => (location.hash = "#scene=rope&world.gravitty=3"));
        await page.locator("#message.shown", { hasText: "gravitty" }).waitFor();
        await page.evaluate(() => (location.hash = "#z=damaged"));
        await page.locator("#message.shown", { hasText: "damaged" }).waitFor();
    }));

test("the scene is saved as JSON, the picture as PNG", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const saved = async (name) => {
            await page.locator("summary", { hasText: "save" }).click();
            const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name }).click()]);
            return [download.suggestedFilename(), await readFile(await download.path())];
        };
        const [name, bytes] = await saved("scene (JSON)");
        assert.equal(name, "rope.json");
        assert.equal(JSON.parse(bytes).sinew, 1);
        const [picture, png] = await saved("picture (PNG)");
        assert.equal(picture, "rope.png");
        assert.equal(png.subarray(1, 4).toString(), "PNG");
    }));

test("a film is recorded as GIF and as WebM", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        for (const [name, begins] of [["film (GIF)", "GIF89a"], ["film (WebM)", "\x1aE\xdf\xa3"]]) {
            await page.locator("summary", { hasText: "save" }).click();
            await page.getByRole("button", { name }).click();
            await page.waitForTimeout(900);
            const [download] = await Promise.all([page.waitForEvent("download", { timeout: 90_000 }), page.getByRole("button", { name: "recording" }).click()]);
            assert.equal((await readFile(await download.path())).subarray(0, begins.length).toString("latin1"), begins);
        }
    }));
