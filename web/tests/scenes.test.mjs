// Every scene of the catalogue in the browser opens and moves; bits are those of the native engine.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { desktop, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

/** Hashes after two seconds, of the native engine: "ragdoll physical double" to 16 digits. */
const golden = new Map(readFileSync(path.resolve(import.meta.dirname, "../../tests/golden/scenes.txt"), "utf8").split("\n")
    .filter((line) => line && !line.startsWith("#")).map((line) => [line.slice(0, line.lastIndexOf(" ")), line.slice(line.lastIndexOf(" ") + 1)]));

// A scene of each kind: web/sinew/test/hashes.mjs compares all of them in Node.
test("hashes after two seconds are those of the native engine", { timeout: 300_000 }, () =>
    site.on(desktop, "", async (page) => {
        await page.waitForFunction(() => window.sinew?.scenes, null, { timeout: 60_000 });
        const names = await page.evaluate(() => [...new Map(window.sinew.scenes.map(({ name, category }) => [category, name])).values()]);
        assert.ok(names.length > 5);
        for (const name of names) for (const mode of ["physical", "classic"]) {
            const hash = await page.evaluate(([name, mode]) => {
                const scene = window.sinew.scenes.find((one) => one.name === name);
                const simulation = window.sinew.engine.open(scene.text, { ...scene, overrides: { mode } });
                const state = [simulation.runUntil(2), simulation.precision, simulation.hash()];
                simulation.dispose();
                return state;
            }, [name, mode]);
            assert.equal(hash[2], golden.get(`${name} ${mode} ${hash[1]}`), `${name} ${mode} ${hash[1]}`);
        }
    }));

test("every scene opens by its address and moves", { timeout: 600_000 }, () =>
    site.on(desktop, "", async (page) => {
        const names = await page.waitForFunction(() => window.sinew?.scenes?.map(({ name }) => name)).then((handle) => handle.jsonValue());
        for (const name of names) {
            await page.evaluate((name) => (location.hash = `#scene=${name}`), name);
            await page.waitForFunction((name) => window.sinew.opened?.name === name && window.sinew.stage.player.state().step >= 20, name, { timeout: 60_000 });
            const moved = await page.evaluate(() => {
                const { simulation } = window.sinew.stage.player, start = simulation.copy();
                start.restart();
                const [before, now] = [start.positions.slice(), simulation.positions.slice()];
                start.dispose();
                return before.some((value, i) => value !== now[i]);
            });
            assert.ok(moved, `${name} stands still`);
        }
    }));

test("thumbnails of the gallery are painted, and search finds", () =>
    site.on(desktop, "", async (page) => {
        await page.waitForFunction(() => document.querySelectorAll(".card canvas.drawn").length >= 8, null, { timeout: 60_000 });
        await page.getByRole("searchbox").fill("cloth tear");
        const visible = await page.locator(".card:visible .name").allTextContents();
        assert.deepEqual(visible, ["curtain", "seam"]);
        await page.getByRole("searchbox").fill("zzz");
        assert.ok(await page.getByText("nothing is called so").isVisible());
    }));
