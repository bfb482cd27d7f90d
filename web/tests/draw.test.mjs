// What a hand can build: ropes, forms and cloth drawn on the scene, prefabs, removal; and walking around a scene of three dimensions.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { desktop, phone, pixelOf, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

async function still(page) {
    await playing(page);
    await page.evaluate(() => window.sinew.stage.player.pause());
}

const text = (page) => page.evaluate(() => window.sinew.stage.player.sceneText());
const scene = async (page) => JSON.parse(await text(page));
const counts = (page) => page.evaluate(() => [window.sinew.stage.player.simulation.particleCount, window.sinew.stage.player.simulation.constraintCount]);
const choose = (page, tool) => page.locator("#tools").getByRole("radio", { name: new RegExp(`^${tool} `) }).click();

/** Draws through points that are given as shares of the canvas. */
async function draw(page, ...shares) {
    const box = await page.locator("#stage").boundingBox();
    const [first, ...rest] = shares.map(([x, y]) => [box.x + x * box.width, box.y + y * box.height]);
    await page.mouse.move(...first);
    await page.mouse.down();
    for (const at of rest) await page.mouse.move(...at, { steps: 8 });
    await page.mouse.up();
}

const drawings = {
    rope: [[0.3, 0.7], [0.4, 0.75], [0.6, 0.7]],
    polygon: [[0.4, 0.6], [0.55, 0.6], [0.55, 0.8], [0.4, 0.8], [0.4, 0.62]],
    cloth: [[0.4, 0.5], [0.6, 0.75]],
};

for (const [tool, shares] of Object.entries(drawings))
    test(`a ${tool} is drawn by hand, moves, is in the address and can be undone`, () =>
        site.on(desktop, "#scene=fixed_stick", async (page) => {
            await still(page);
            const [before, [particles, constraints]] = [await scene(page), await counts(page)];
            await choose(page, tool);
            await draw(page, ...shares);
            const drawn = await scene(page), [now, links] = await counts(page);
            assert.equal(drawn.figures.length, before.figures.length + 1);
            assert.ok(now >= particles + 3 && links >= constraints + 2, `${now} particles, ${links} constraints`);
            const last = () => page.evaluate((row) => [...window.sinew.stage.player.simulation.positions.slice(2 * row)], now - 1);
            const start = await last();
            for (let i = 0; i < 20; ++i) await page.keyboard.press("o");
            assert.notDeepEqual(await last(), start, "it falls");
            await page.waitForFunction(() => location.hash.startsWith("#z="), null, { timeout: 10_000 });
            const shared = await text(page);
            await page.reload();
            await playing(page);
            assert.equal(await text(page), shared, "the address leads to the same scene");
        }));

test("a drawing is taken back by undo and comes again by redo", () =>
    site.on(desktop, "#scene=fixed_stick", async (page) => {
        await still(page);
        const before = await text(page);
        await choose(page, "rope");
        await draw(page, ...drawings.rope);
        const after = await text(page);
        await page.getByRole("button", { name: /^undo/ }).click();
        assert.equal(await text(page), before);
        await page.getByRole("button", { name: /^do again/ }).click();
        assert.equal(await text(page), after);
    }));

test("a finger draws a rope on a phone", () =>
    site.on(phone, "#scene=fixed_stick", async (page) => {
        await still(page);
        const before = (await scene(page)).figures.length;
        await page.locator("#tools").getByRole("radio", { name: /^rope / }).tap();
        const client = await page.context().newCDPSession(page);
        const touch = (type, ...points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
        await touch("touchStart", [80, 400]);
        for (let x = 90; x <= 300; x += 15) await touch("touchMove", [x, 400 + x / 8]);
        await touch("touchEnd");
        assert.equal((await scene(page)).figures.length, before + 1);
    }));

test("a prefab is put in and a figure is removed", () =>
    site.on(desktop, "#scene=fixed_stick", async (page) => {
        await still(page);
        const before = (await scene(page)).figures.length;
        await choose(page, "spawn");
        await page.getByLabel("prefab").selectOption("polygon");
        const box = await page.locator("#stage").boundingBox();
        await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.75);
        const put = (await scene(page)).figures;
        assert.equal(put.length, before + 1);
        assert.equal(put.at(-1).prefab, "polygon");
        const name = await page.evaluate(() => {
            const { simulation } = window.sinew.stage.player;
            return simulation.nameOf(simulation.particleCount - 1);
        });
        const [x, y] = await pixelOf(page, name);
        await choose(page, "remove");
        await page.mouse.click(x, y);
        assert.equal((await scene(page)).figures.length, before);
    }));

/** The first two points of the picture: those of the scene, whatever the pointer adds later. */
const picture = (page) => page.evaluate(() => [...window.sinew.stage.player.draw().points.slice(0, 4)]);

test("the middle button moves a flat scene, and a button brings all of it back", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await still(page);
        const seeEverything = () => page.getByRole("button", { name: "see everything" }).click();
        await seeEverything(); // the beam of the scene is longer than its view
        await page.mouse.move(300, 300);
        const before = await picture(page);
        await page.mouse.down({ button: "middle" });
        await page.mouse.move(340, 330, { steps: 4 });
        await page.mouse.up({ button: "middle" });
        const after = await picture(page);
        assert.ok(Math.abs(after[0] - before[0] - 40) < 0.01 && Math.abs(after[1] - before[1] - 30) < 0.01, `from ${before} to ${after}`);
        await seeEverything();
        assert.deepEqual(await picture(page), before);
    }));

test("three dimensions: dragging where nothing is turns the scene, the state stays", () =>
    site.on(desktop, "#scene=cloth3d", async (page) => {
        await still(page);
        const hash = () => page.evaluate(() => window.sinew.stage.player.hash());
        const [before, state] = [await picture(page), await hash()];
        await draw(page, [0.05, 0.9], [0.25, 0.85]);
        const turned = await picture(page);
        assert.notDeepEqual(turned, before);
        assert.equal(await hash(), state);
        await page.mouse.wheel(0, -300);
        await page.waitForFunction((turned) => window.sinew.stage.player.draw().points[0] !== turned[0], turned);
        await page.locator("#stage").focus();
        await page.keyboard.press("Home");
        assert.deepEqual(await picture(page), before, "Home looks from where it was");
    }));

test("three dimensions on a phone: the cloth is seen from edge to edge", () =>
    site.on(phone, "#scene=cloth3d", async (page) => {
        await still(page);
        const seen = () => page.evaluate(() => {
            const { player, canvas } = window.sinew.stage;
            const cloth = [...player.draw()].filter(({ color }) => color[0] > 0.5 && color[1] < 0.3).flatMap(({ points }) => [...points]).filter((_, i) => i % 2 === 0);
            return [Math.min(...cloth), Math.max(...cloth), canvas.width];
        });
        const [low, high, width] = await seen();
        assert.ok(low > 0 && high < width && high > low, `${low} to ${high} of ${width}`);
    }));
