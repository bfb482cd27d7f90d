// The panel: sliders of the declared parameters, overlays, graphs of energy and stretch.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { catalogue } from "../sinew/index.js";
import { desktop, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const value = (page, path) => page.evaluate((path) => window.sinew.stage.player.parameters().find((one) => one.path === path)?.value, path);

test("every number that a scene states has a slider, which sets it", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const { parameters } = (await catalogue()).find(({ name }) => name === "rope");
        const stated = parameters.filter(({ type }) => type === "number" || type === "integer").map(({ path }) => path);
        assert.ok(stated.length >= 5);
        const sliders = await page.locator("#page-parameters input[type=range]").count();
        assert.ok(sliders >= stated.length, `${sliders} sliders for ${stated.length} numbers`);
        const damping = page.getByRole("slider", { name: "world damping", exact: true });
        const before = await value(page, "world.damping");
        await damping.focus();
        await page.keyboard.press("ArrowRight");
        await page.waitForFunction((before) => window.sinew.stage.player.parameters().find(({ path }) => path === "world.damping").value > before, before);
        await page.keyboard.press("ArrowRight");
        await page.getByRole("spinbutton", { name: "world damping, exact" }).fill("0.125");
        await page.keyboard.press("Enter");
        assert.equal(await value(page, "world.damping"), 0.125);
    }));

test("labels name what a value belongs to, in words", () =>
    site.on(desktop, "#scene=dress", async (page) => {
        await playing(page);
        for (const label of await page.locator("#page-parameters .label, #tools button").all())
            assert.doesNotMatch(await label.textContent() + (await label.getAttribute("aria-label") ?? ""), /_/);
        const slider = page.getByRole("slider", { name: "skirt contact wall friction", exact: true });
        await slider.focus();
        await page.keyboard.press("ArrowRight");
        await page.getByRole("button", { name: /^undo .*wall friction/ }).waitFor();
    }));

test("what is said of a scene is that of the mode shown, of both for both, by keys too", () =>
    site.on(desktop, "#scene=rally", async (page) => {
        await playing(page);
        const about = page.locator("#side .about");
        const [physical, classic] = [/motor on each axle/, /the land is tilted/i];
        for (const [key, shown, hidden] of [["", physical, classic], ["c", classic, physical], ["e", physical, null], ["e", classic, physical], ["c", physical, classic]]) {
            if (key) await page.keyboard.press(key);
            await page.waitForFunction(([shown, flags]) => new RegExp(shown, flags).test(document.querySelector("#side .about").textContent), [shown.source, shown.flags]);
            if (hidden) assert.doesNotMatch(await about.textContent(), hidden);
            else assert.match(await about.textContent(), classic);
        }
    }));

test("a value out of range is refused in words, and the scene goes on", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const before = await value(page, "figures.0.segments");
        await page.getByRole("spinbutton", { name: "line segments, exact" }).fill("-4");
        await page.keyboard.press("Enter");
        await page.getByRole("alert").waitFor();
        assert.equal(await value(page, "figures.0.segments"), before);
        const { step } = await page.evaluate(() => window.sinew.stage.player.state());
        await page.waitForFunction((step) => window.sinew.stage.player.state().step > step + 3, step);
    }));

test("overlays are switched by chips and by keys", () =>
    site.on(desktop, "#scene=bridge", async (page) => {
        await playing(page);
        const shown = () => page.evaluate(() => window.sinew.stage.player.state().overlays);
        const first = page.locator(".chips button").first(), name = await first.textContent();
        await first.click();
        assert.deepEqual(await shown(), [name]);
        assert.equal(await first.getAttribute("aria-pressed"), "true");
        await page.locator("#stage").focus();
        await page.keyboard.press("1");
        assert.deepEqual(await shown(), []);
    }));

/** Pixels of a graph that are not its paper, and how many colours they have. */
const inked = (page, index) => page.evaluate((index) => {
    const canvas = document.querySelectorAll(".graph canvas")[index];
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const colors = new Map();
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 250) {
        const color = data.slice(i, i + 3).join();
        colors.set(color, (colors.get(color) ?? 0) + 1);
    }
    return [...colors.values()].filter((count) => count > 3).length;
}, index);

test("graphs of energy and stretch draw their lines, tell their numbers and start again with the scene", { timeout: 120_000 }, () =>
    site.on(desktop, "#scene=swing", async (page) => {
        await playing(page);
        await page.getByRole("tab", { name: "statistics" }).click();
        await page.waitForFunction(() => /kinetic [\d.]+/.test(document.querySelector(".graph canvas").getAttribute("aria-label") ?? ""), null, { timeout: 30_000 });
        await page.waitForFunction(() => window.sinew.panel.graphs.energy.samples.length > 8, null, { timeout: 60_000 });
        assert.ok(await inked(page, 0) >= 3, "several lines of energy");
        assert.ok(await inked(page, 1) >= 1, "lines of stretch");
        const { energy, report } = await page.evaluate(() => {
            const { stage, panel } = window.sinew;
            stage.player.pause();
            const report = stage.player.simulation.report();
            panel.graphs.sampledAt = 0; // the pause may fall between two samples
            panel.graphs.sample(stage.player.simulation, performance.now());
            return { energy: panel.graphs.energy.samples.at(-1), report };
        });
        assert.deepEqual(energy, [report.kinetic + report.potential + report.stored, report.kinetic, report.potential, report.stored]);
        await page.keyboard.press("r");
        const left = await page.evaluate(() => {
            const { stage: { player }, panel: { graphs } } = window.sinew;
            player.pause();
            graphs.sampledAt = 0;
            graphs.sample(player.simulation, performance.now());
            return [graphs.energy.samples.length, player.simulation.report().steps];
        });
        assert.ok(left[0] <= left[1] + 1, `${left[0]} samples of ${left[1]} steps`);
    }));
