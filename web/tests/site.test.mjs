// The site as a whole: phone, themes, without a network, for everybody, and as it looked.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { copyFile, mkdir, readFile, access } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { desktop, moving, phone, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const run = promisify(execFile);
const axe = await readFile(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");

async function checkAccess(page, where) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document)); // all rules, best practices too
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(" ")}`), [], where);
}

for (const colorScheme of ["light", "dark"]) {
    test(`accessible by axe on a phone: gallery, drawer, help, lesson, ${colorScheme}`, { timeout: 120_000 }, async () => {
        await site.on({ ...phone, colorScheme }, "", async (page) => {
            await page.waitForFunction(() => window.sinew?.scenes);
            await checkAccess(page, "gallery");
            await page.evaluate(() => (location.hash = "#scene=swing"));
            await playing(page);
            await page.getByRole("button", { name: "panel", exact: true }).tap();
            await page.waitForTimeout(500);
            await checkAccess(page, "drawer");
            await page.getByRole("button", { name: "Close the panel" }).tap();
            await page.getByRole("button", { name: "keys", exact: true }).tap();
            await checkAccess(page, "help");
        });
        await site.on({ ...phone, colorScheme }, "learn/#integrators", async (page) => {
            await moving(page);
            await page.locator(".lines .acts").scrollIntoViewIfNeeded();
            await page.locator(".cm-content").waitFor();
            await checkAccess(page, "lesson");
        });
    });

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
        await site.on({ ...desktop, colorScheme }, "learn/#rope", async (page) => {
            await moving(page);
            await checkAccess(page, "lesson");
        });
        await site.on({ ...desktop, colorScheme }, "learn/", async (page) => {
            await page.locator(".cover").waitFor();
            await checkAccess(page, "cover");
        });
    });
}

test("no keyboard trap: Tab goes round through all bars, out of the editor too, and back", { timeout: 120_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        await page.getByRole("tab", { name: "text" }).click();
        await page.locator(".cm-content").waitFor();
        const place = () => page.evaluate(() => {
            const at = document.activeElement;
            return at === document.body ? "page" : at.closest(".menu, #tools, #time, #side .cm-editor, #side, #stage")?.className.split(" ")[0] || at.closest("[id]")?.id;
        });
        for (const key of ["Tab", "Shift+Tab"]) {
            const places = new Set();
            for (let i = 0; i < 40; ++i) {
                await page.keyboard.press(key);
                places.add(await place());
            }
            for (const wanted of ["menu", "tools", "stage", "time", "cm-editor"]) assert.ok(places.has(wanted), `${key} never comes to ${wanted}: ${[...places]}`);
        }
    }));

test("installable: the manifest has names, icons and a start within the site", () =>
    site.on(desktop, "", async (page) => {
        const client = await page.context().newCDPSession(page);
        const { url, errors, data } = await client.send("Page.getAppManifest");
        assert.deepEqual(errors, []);
        assert.ok(url.startsWith(site.address));
        const manifest = JSON.parse(data);
        assert.ok(manifest.name && manifest.short_name && manifest.display === "standalone");
        assert.equal(new URL(manifest.start_url, url).href, site.address);
        for (const icon of manifest.icons) assert.ok((await page.request.get(new URL(icon.src, url).href)).ok(), icon.src);
        await page.evaluate(() => navigator.serviceWorker.ready);
        const { installabilityErrors } = await client.send("Page.getInstallabilityErrors");
        assert.deepEqual(installabilityErrors.filter(({ errorId }) => errorId !== "in-incognito"), []);
    }));

for (const where of ["", "learn/", "learn/#box", "learn/#triangle", "learn/#determinism"])
    test(`nothing is wider than a phone: ${where || "gallery"}`, () =>
        site.on(phone, where, async (page) => {
            await page.waitForFunction(() => document.querySelectorAll(".card, .cover li, .live").length > 0);
            const wide = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
            assert.ok(wide[0] <= wide[1], wide.join(" > "));
        }));

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

test("a scene that is made for the dark is dark on a light page, in the gallery and when it is open, until a theme is chosen", () =>
    site.on(phone, "#scene=spiderweb", async (page) => {
        const shown = () => page.evaluate(() => [document.documentElement.dataset.theme, window.sinew.stage.player.state().theme, getComputedStyle(document.getElementById("scene"), "::after").color]);
        await playing(page);
        assert.deepEqual(await shown(), ["light", "dark", "rgb(232, 228, 218)"]);
        await page.evaluate(() => (location.hash = "#scene=rope"));
        await page.waitForFunction(() => window.sinew.opened.name === "rope");
        assert.deepEqual(await shown(), ["light", "light", "rgb(43, 45, 66)"]);
        await page.evaluate(() => (location.hash = "#scene=ragdoll&mode=classic"));
        await page.waitForFunction(() => window.sinew.opened.name === "ragdoll");
        assert.equal((await shown())[1], "dark", "white lines on black");
        await page.keyboard.press("t");
        await page.keyboard.press("t");
        assert.deepEqual((await shown()).slice(0, 2), ["light", "light"]);
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
        await moving(page);
    });
});

/** Similarity of two pictures, 1 for equal ones. */
async function similarity(a, b) {
    const { stderr } = await run("ffmpeg", ["-hide_banner", "-i", a, "-i", b, "-lavfi", "ssim", "-f", "null", "-"]);
    return Number(/All:([\d.]+)/.exec(stderr)[1]);
}

/** The scene after its first second, the same on every machine. */
async function aSecondIn(page) {
    await playing(page);
    await page.evaluate(() => {
        const { stage } = window.sinew;
        document.getElementById("hint").hidden = true;
        stage.player.pause();
        stage.player.restart();
        for (let i = 0; i < 60; ++i) stage.player.step();
        window.sinew.changed();
    });
}

/** Thumbnails that stand still: all that are in sight. */
async function stillGallery(page) {
    await page.waitForFunction(() => {
        const inSight = [...document.querySelectorAll(".card canvas")].filter((canvas) => canvas.getBoundingClientRect().top < innerHeight);
        return inSight.length > 5 && inSight.every((canvas) => canvas.classList.contains("drawn"));
    }, null, { timeout: 60_000 });
}

async function stillLesson(page) {
    await moving(page);
    await page.evaluate(() => window.sinew.views.forEach((view) => view.standStill(5)));
}

const looks = {
    desktop_light: [desktop, "light", "#scene=ragdoll", aSecondIn],
    desktop_dark: [desktop, "dark", "#scene=ragdoll", aSecondIn],
    phone_light: [phone, "light", "#scene=ragdoll", aSecondIn],
    phone_dark: [phone, "dark", "#scene=cloth3d", aSecondIn],
    gallery_light: [{ ...desktop, reducedMotion: "reduce" }, "light", "", stillGallery],
    lesson_dark: [desktop, "dark", "learn/#stick", stillLesson],
    lesson_phone_light: [phone, "light", "learn/#triangle", stillLesson],
};

for (const [name, [options, colorScheme, where, prepare]] of Object.entries(looks))
    test(`looks as it did: ${name}`, () =>
        site.on({ ...options, colorScheme }, where, async (page) => {
            await prepare(page);
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
