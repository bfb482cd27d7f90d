// The site as a whole: phone, themes, without a network, for everybody, and as it looked.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { copyFile, mkdir, readFile, access } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { desktop, phone, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const run = promisify(execFile);
const axe = await readFile(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");

async function checkAccess(page, where) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] }));
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(" ")}`), [], where);
}

for (const colorScheme of ["light", "dark"])
    test(`accessible by axe: gallery, player, lessons, ${colorScheme}`, { timeout: 120_000 }, async () => {
        await site.on({ ...desktop, colorScheme }, "", async (page) => {
            await page.waitForFunction(() => window.sinew?.scenes);
            await checkAccess(page, "gallery");
            await page.evaluate(() => (location.hash = "#scene=ragdoll"));
            await playing(page);
            for (const tab of ["parameters", "text", "statistics"]) {
                await page.getByRole("tab", { name: tab }).click();
                await page.waitForTimeout(500);
                await checkAccess(page, tab);
            }
        });
        await site.on({ ...desktop, colorScheme }, "learn/#stick", async (page) => {
            await page.waitForFunction(() => window.sinew?.player);
            await checkAccess(page, "lesson");
        });
    });

test("a phone shows the scene, its bars and, on request, the panel; nothing is wider than the page", () =>
    site.on(phone, "#scene=ragdoll", async (page) => {
        await playing(page);
        const canvas = await page.locator("#stage").boundingBox();
        assert.ok(canvas.width === 390 && canvas.height > 500, JSON.stringify(canvas));
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
        assert.ok(!(await page.locator("#side").isVisible()));
        await page.getByRole("button", { name: "panel", exact: true }).tap();
        await page.getByRole("tab", { name: "parameters" }).waitFor();
        await page.getByRole("button", { name: "Close the panel" }).tap();
        await page.locator("#side").waitFor({ state: "hidden" });
        for (const button of await page.locator("#time button:visible, #tools button").all()) {
            const { width, height } = await button.boundingBox();
            assert.ok(width >= 40 && height >= 40, `${await button.getAttribute("title")} is too small for a finger: ${width} x ${height}`);
        }
    }));

test("the theme is that of the system until another is chosen, and is remembered", () =>
    site.on({ ...desktop, colorScheme: "dark" }, "#scene=rope", async (page) => {
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.state().theme), "dark");
        await page.keyboard.press("t");
        assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
        await page.reload();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.state().theme), "light");
    }));

test("works without a network after the first visit", { timeout: 120_000 }, async () => {
    await site.on(desktop, "", async (page) => {
        await page.evaluate(() => navigator.serviceWorker.ready);
        await page.waitForFunction(async () => (await caches.keys()).length > 0 && (await (await caches.open((await caches.keys())[0])).keys()).length > 20, null, { timeout: 60_000 });
        await page.waitForFunction(() => navigator.serviceWorker.controller !== null, null, { timeout: 30_000 });
        await page.context().setOffline(true);
        await page.goto(`${site.address}#scene=boxes`);
        await page.reload();
        await playing(page);
        await page.goto(`${site.address}learn/#swing`);
        await page.waitForFunction(() => window.sinew?.player?.state().step > 3, null, { timeout: 60_000 });
    });
});

test("every lesson has a live figure, whose slider acts", { timeout: 300_000 }, () =>
    site.on(desktop, "learn/", async (page) => {
        const ids = await page.locator("#contents a").evaluateAll((links) => links.map(({ hash }) => hash));
        assert.ok(ids.length >= 16);
        for (const id of ids) {
            await page.evaluate((id) => (location.hash = id), id);
            await page.waitForFunction((id) => document.querySelector("#contents [aria-current]")?.hash === id && window.sinew?.player?.state().step > 3, id, { timeout: 60_000 });
            const before = await page.evaluate(() => window.sinew.player.sceneText());
            const isLow = await page.locator("#slider").evaluate((slider) => slider.value === slider.min);
            await page.locator("#slider").press(isLow ? "End" : "Home");
            await page.waitForFunction((before) => window.sinew.player.sceneText() !== before, before);
            await page.waitForFunction(() => window.sinew.player.state().step > 3);
        }
    }));

/** Similarity of two pictures, 1 for equal ones. */
async function similarity(a, b) {
    const { stderr } = await run("ffmpeg", ["-hide_banner", "-i", a, "-i", b, "-lavfi", "ssim", "-f", "null", "-"]);
    return Number(/All:([\d.]+)/.exec(stderr)[1]);
}

const looks = {
    desktop_light: [desktop, "light"],
    desktop_dark: [desktop, "dark"],
    phone_light: [phone, "light"],
};

for (const [name, [options, colorScheme]] of Object.entries(looks))
    test(`looks as it did: ${name}`, () =>
        site.on({ ...options, colorScheme }, "#scene=ragdoll", async (page) => {
            await playing(page);
            await page.evaluate(() => {
                const { stage } = window.sinew;
                document.getElementById("hint").hidden = true;
                stage.player.pause();
                stage.player.restart();
                for (let i = 0; i < 60; ++i) stage.player.step();
                window.sinew.changed();
            });
            await page.waitForTimeout(500);
            const taken = path.join(site.folder, `${name}.png`);
            const kept = path.resolve(import.meta.dirname, `pictures/${name}.png`);
            await page.screenshot({ path: taken, scale: "css" });
            if (process.env.SINEW_RENEW_GOLDEN) {
                await mkdir(path.dirname(kept), { recursive: true });
                return copyFile(taken, kept);
            }
            await access(kept);
            const ssim = await similarity(taken, kept);
            assert.ok(ssim >= 0.98, `similarity ${ssim}`);
        }));
