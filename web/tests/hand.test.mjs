// What a hand can do: drag, throw, cut, pin, move and zoom, with a mouse, with fingers and by keys alone.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { desktop, phone, pixelOf, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const state = (page) => page.evaluate(() => window.sinew.stage.player.state());

/** Pauses, so that a slow machine finds things where they were. */
async function still(page) {
    await playing(page);
    await page.evaluate(() => window.sinew.stage.player.pause());
}

/** Waits until so many more steps are taken. */
async function steps(page, count) {
    const { step } = await state(page);
    await page.waitForFunction((until) => window.sinew.stage.player.state().step >= until, step + count, { timeout: 60_000 });
}

const positionOf = (page, name) => page.evaluate((name) => window.sinew.stage.player.simulation.stateOf(name).position, name);

test("dragging takes a particle along, letting go throws it", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await still(page);
        const [x, y] = await pixelOf(page, "rope/end");
        await page.mouse.move(x, y);
        await page.mouse.down();
        assert.ok((await state(page)).isHolding);
        await page.evaluate(() => window.sinew.stage.player.pause(false));
        await page.mouse.move(x + 60, y - 120, { steps: 8 });
        await steps(page, 60);
        const [hx, hy] = await pixelOf(page, "rope/end");
        assert.ok(Math.hypot(hx - x - 60, hy - y + 120) < 30, `held at ${hx}, ${hy}`);
        await page.mouse.up();
        assert.ok(!(await state(page)).isHolding);
        const before = await positionOf(page, "rope/end");
        await steps(page, 5);
        assert.notDeepEqual(await positionOf(page, "rope/end"), before);
    }));

test("the right button cuts", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await still(page);
        const count = () => page.evaluate(() => window.sinew.stage.player.simulation.constraintCount);
        const before = await count();
        const [ax, ay] = await pixelOf(page, "rope/start"), [bx, by] = await pixelOf(page, "rope/end");
        const [mx, my] = [(ax + bx) / 2, (ay + by) / 2], [nx, ny] = [(by - ay) / 3, (ax - bx) / 3];
        await page.mouse.move(mx - nx, my - ny);
        await page.mouse.down({ button: "right" });
        await page.mouse.move(mx + nx, my + ny, { steps: 12 });
        await page.mouse.up({ button: "right" });
        await page.keyboard.press("o");
        assert.ok(await count() < before);
    }));

test("the wheel zooms, the pin tool pins, undo takes it back", () =>
    site.on(desktop, "#scene=box", async (page) => {
        await still(page);
        const picture = () => page.evaluate(() => window.sinew.stage.player.draw().copy().points.join());
        const before = await picture();
        await page.mouse.move(500, 400);
        await page.mouse.wheel(0, -300);
        await page.waitForFunction((before) => window.sinew.stage.player.draw().copy().points.join() !== before, before);
        await page.getByRole("button", { name: "see everything" }).click();
        await page.getByRole("radio", { name: "pin", exact: false }).first().click();
        assert.equal((await state(page)).tool, "pin");
        const [x, y] = await pixelOf(page, "box/top_left"), text = await page.evaluate(() => window.sinew.stage.player.sceneText());
        await page.mouse.click(x, y);
        assert.notEqual(await page.evaluate(() => window.sinew.stage.player.sceneText()), text);
        await page.keyboard.press("Control+z");
        assert.equal(await page.evaluate(() => window.sinew.stage.player.sceneText()), text);
    }));

test("two fingers move and zoom, one finger drags", () =>
    site.on(phone, "#scene=rope", async (page) => {
        await still(page);
        const client = await page.context().newCDPSession(page);
        const touch = (type, ...points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
        const [x, y] = await pixelOf(page, "rope/end");
        await touch("touchStart", [x, y]);
        assert.ok((await state(page)).isHolding, "one finger holds");
        await touch("touchMove", [x + 30, y - 40]);
        await touch("touchEnd");
        assert.ok(!(await state(page)).isHolding);
        const picture = () => page.evaluate(() => window.sinew.stage.player.draw().copy().points.join());
        const before = await picture();
        await touch("touchStart", [150, 300], [250, 300]);
        await touch("touchMove", [110, 300], [290, 300]);
        await touch("touchEnd");
        assert.notEqual(await picture(), before);
    }));

test("everything works by keys alone", () =>
    site.on(desktop, "", async (page) => {
        await page.waitForFunction(() => window.sinew?.scenes);
        await page.getByRole("searchbox").focus();
        await page.keyboard.type("rope");
        await page.keyboard.press("Tab");
        for (let i = 0; i < 12 && !(await page.evaluate(() => document.activeElement.matches('[href="#scene=rope"]'))); ++i) await page.keyboard.press("Tab");
        await page.keyboard.press("Enter");
        await playing(page);
        await page.keyboard.press("p");
        assert.ok((await state(page)).isPaused);
        await page.keyboard.press("o");
        await page.locator("#stage").focus();
        const [x, y] = await pixelOf(page, "rope/end");
        const box = await page.locator("#stage").boundingBox();
        const press = async (key, count) => { for (let i = 0; i < count; ++i) await page.keyboard.press(key); };
        const dx = x - box.x - box.width / 2, dy = y - box.y - box.height / 2;
        await press(dx > 0 ? "ArrowRight" : "ArrowLeft", Math.round(Math.abs(dx) / 10) || 1);
        await press(dy > 0 ? "ArrowDown" : "ArrowUp", Math.round(Math.abs(dy) / 10) || 1);
        await page.keyboard.press("Enter");
        assert.ok((await state(page)).isHolding, "Enter grabs");
        await page.keyboard.press("Enter");
        assert.ok(!(await state(page)).isHolding);
        await page.keyboard.press("x");
        assert.equal((await state(page)).tool, "cut");
        await page.keyboard.press("F1");
        assert.ok(await page.getByRole("dialog").isVisible());
        await page.keyboard.press("Escape");
        assert.ok(!(await page.getByRole("dialog").isVisible()));
    }));

test("time: pause, a step, a step back, slow motion, restart, the last minute", () =>
    site.on(desktop, "#scene=ragdoll", async (page) => {
        await still(page);
        const { step } = await state(page);
        const hash = () => page.evaluate(() => window.sinew.stage.player.hash());
        const here = await hash();
        await page.keyboard.press("o");
        assert.equal((await state(page)).step, step + 1);
        await page.keyboard.press("b");
        assert.equal((await state(page)).step, step);
        assert.equal(await hash(), here, "a step back leads to the same bits");
        await page.getByRole("radio", { name: /^¼/ }).click();
        assert.equal((await state(page)).timeScale, 0.25);
        const timeline = page.getByRole("slider", { name: "Step of the last minute" });
        await timeline.fill(String(step - 2));
        assert.equal((await state(page)).step, step - 2, "the timeline leads back");
        await timeline.fill(String(step));
        assert.equal(await hash(), here, "and forth again, to the same bits");
        await page.keyboard.press("r");
        assert.ok(await page.evaluate(() => window.sinew.stage.player.simulation.report().steps) < step);
    }));

test("both modes run side by side, and classic alone", () =>
    site.on(desktop, "#scene=ragdoll", async (page) => {
        await playing(page);
        await page.getByRole("radio", { name: /^both/ }).click();
        assert.equal((await state(page)).panes, 2);
        await steps(page, 40);
        const hashes = await page.evaluate(() => [0, 1].map((pane) => window.sinew.stage.player.pane(pane).hash()));
        assert.notEqual(hashes[0], hashes[1], "each side goes its own way");
        await page.getByRole("radio", { name: /^classic/ }).click();
        assert.equal((await state(page)).panes, 1);
        assert.equal(await page.getByRole("radio", { name: /^classic/ }).getAttribute("aria-checked"), "true");
        await page.waitForFunction(() => location.hash.includes("mode=classic"), null, { timeout: 5000 });
    }));

test("arrow keys steer a car and a character, with and without the focus on the scene, until they are let go", { timeout: 90_000 }, async () => {
    for (const [scene, particle] of [["rally", "car/rear_wheel"], ["platformer", "hero/feet"]])
        await site.on(desktop, `#scene=${scene}`, async (page) => {
            await playing(page);
            for (const isFocused of [false, true]) {
                await page.evaluate((isFocused) => {
                    window.sinew.stage.player.restart();
                    if (isFocused) document.getElementById("stage").focus();
                    else document.activeElement.blur();
                }, isFocused);
                const [start] = await positionOf(page, particle);
                await page.keyboard.down("ArrowLeft");
                await steps(page, 30);
                const [x] = await positionOf(page, particle);
                assert.ok(x < start - 0.05, `${scene}, ${isFocused}: from ${start} to ${x}`);
                await page.keyboard.up("ArrowLeft");
            }
        });
    await site.on(desktop, "#scene=rope", async (page) => {
        await still(page);
        await page.locator("#stage").focus();
        await page.keyboard.press("ArrowLeft");
        assert.ok(await page.evaluate(() => window.sinew.stage.pointer.cross), "elsewhere they move a pointer");
    });
});

test("a finger steers a car and a character by buttons, which other scenes and other pages lack", { timeout: 90_000 }, async () => {
    for (const [scene, particle] of [["rally", "car/rear_wheel"], ["platformer", "hero/feet"]])
        await site.on(phone, `#scene=${scene}`, async (page) => {
            await playing(page);
            await page.evaluate(() => window.sinew.stage.player.restart());
            const client = await page.context().newCDPSession(page);
            const box = await page.getByRole("button", { name: "left", exact: true }).boundingBox();
            assert.ok(box.width >= 40 && box.height >= 40 && box.x >= 0, JSON.stringify(box));
            const [start] = await positionOf(page, particle);
            await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x: box.x + box.width / 2, y: box.y + box.height / 2 }] });
            await steps(page, 30);
            const [x] = await positionOf(page, particle);
            assert.ok(x < start - 0.05, `${scene}: from ${start} to ${x}`);
            await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
            await page.waitForFunction(() => !document.querySelector("#pad button:active"));
            const last = await page.getByRole("button", { name: "jump or brake" }).boundingBox();
            assert.ok(last.x + last.width <= phone.viewport.width, JSON.stringify(last));
            await page.evaluate(() => (location.hash = "#scene=rope"));
            await page.locator("#pad").waitFor({ state: "hidden" });
        });
    await site.on(desktop, "#scene=rally", async (page) => {
        await playing(page);
        assert.ok(!(await page.locator("#pad").isVisible()), "a keyboard has arrows");
    });
});
