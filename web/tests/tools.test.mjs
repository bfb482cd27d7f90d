// The tools that build, as a hand uses them on the page: select, join, walls and ground; space is pause.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { desktop, phone, pixelOf, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const two = {
    sinew: 1, view: { center: [0, 1], height: 4 }, world: { gravity: [0, -9.81], bounds: { planes: [{ normal: [0, 1] }] } },
    figures: [{ prefab: "box", name: "left", at: [-1, 1], width: 0.4, height: 0.4 }, { prefab: "box", name: "right", at: [1, 1], width: 0.4, height: 0.4 }],
};
const state = (page) => page.evaluate(() => window.sinew.stage.player.state());
const scene = (page) => page.evaluate(() => JSON.parse(window.sinew.stage.player.sceneText()));
const tool = (page, name) => page.getByRole("radio", { name: new RegExp(`^${name} `) }).click();

/** The two boxes of the scene, at rest. */
async function begin(page) {
    await page.waitForFunction(() => window.sinew?.openText);
    await page.evaluate((text) => window.sinew.openText(text, "two"), JSON.stringify(two));
    await playing(page);
    await page.evaluate(() => (window.sinew.stage.player.restart(), window.sinew.stage.player.pause()));
}

async function middleOf(page, name) {
    const [[ax, ay], [bx, by]] = [await pixelOf(page, `${name}/top_left`), await pixelOf(page, `${name}/bottom_right`)];
    return [(ax + bx) / 2, (ay + by) / 2];
}

async function drag(page, [fromX, fromY], [toX, toY]) {
    await page.mouse.move(fromX, fromY);
    await page.mouse.down();
    await page.mouse.move(toX, toY, { steps: 6 });
    await page.mouse.up();
}

test("every tool has an icon of its own", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const icons = await page.locator("#tools .icon").evaluateAll((all) => all.map((svg) => svg.innerHTML));
        assert.equal(new Set(icons).size, icons.length);
        for (const button of await page.locator("#tools button").all()) {
            const { y, height } = await button.boundingBox();
            assert.ok(y + height <= desktop.viewport.height, `${await button.getAttribute("title")} ends at ${y + height}`);
        }
    }));

test("no two icons of the bar look alike", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const drawn = await page.locator("#tools .icon").evaluateAll((all) => Promise.all(all.map(async (svg) => {
            const own = svg.cloneNode(true);
            own.setAttribute("xmlns", "http://www.w3.org/2000/svg");
            own.innerHTML = `<style>* { fill: none; stroke: #000; stroke-width: 0.19 } .fill { fill: #000; stroke: none }</style>${svg.innerHTML}`;
            const image = new Image(36, 36);
            image.src = `data:image/svg+xml,${encodeURIComponent(own.outerHTML)}`;
            await image.decode();
            const pen = new OffscreenCanvas(36, 36).getContext("2d");
            pen.drawImage(image, 0, 0, 36, 36);
            const { data } = pen.getImageData(0, 0, 36, 36), ink = [];
            for (let i = 3; i < data.length; i += 4) ink.push(data[i] > 127);
            return { name: svg.parentNode.title.split("  ")[0], ink };
        })));
        for (const [i, a] of drawn.entries()) for (const b of drawn.slice(i + 1)) {
            const [both, either] = a.ink.reduce(([both, either], on, at) => [both + (on && b.ink[at]), either + (on || b.ink[at])], [0, 0]);
            assert.ok(both < 0.6 * either, `${a.name} and ${b.name} share ${(100 * both / either).toFixed(0)} % of their ink`);
        }
    }));

test("Escape unchooses; without a choice it does nothing", () =>
    site.on(desktop, "", async (page) => {
        await begin(page);
        await tool(page, "select");
        await page.mouse.click(...await middleOf(page, "left"));
        await page.keyboard.press("Escape");
        await page.keyboard.press("Delete");
        assert.equal((await scene(page)).figures.length, 2, "nothing is chosen");
        await page.keyboard.press("Escape");
        await page.mouse.click(...await middleOf(page, "left"));
        await page.keyboard.press("Delete");
        assert.deepEqual((await scene(page)).figures.map(({ name }) => name), ["right"]);
    }));

test("every word of the panel fits its button, at the joint tool too", () =>
    site.on(desktop, "", async (page) => {
        await begin(page);
        await tool(page, "join");
        for (const button of await page.locator("#side button:visible").all()) {
            const over = await button.evaluate((own) => {
                const words = document.createRange(), { right } = own.getBoundingClientRect();
                const page = own.closest(".page, .head, #side"), edge = page.getBoundingClientRect().right - parseFloat(getComputedStyle(page).paddingRight);
                words.selectNodeContents(own);
                return Math.max(words.getBoundingClientRect().right - right, right - edge);
            });
            assert.ok(over <= 0.5, `${await button.textContent()} sticks out by ${over}`);
        }
    }));

test("select chooses with shift, carries, copies and deletes", () =>
    site.on(desktop, "", async (page) => {
        await begin(page);
        await tool(page, "select");
        const left = await middleOf(page, "left"), right = await middleOf(page, "right");
        await page.mouse.click(...left);
        await page.keyboard.down("Shift");
        await page.mouse.click(...right);
        await page.keyboard.up("Shift");
        await drag(page, right, [right[0], right[1] - 90]);
        for (const [name, [x, y]] of [["left", left], ["right", right]]) {
            const [nx, ny] = await middleOf(page, name);
            assert.ok(Math.abs(nx - x) < 2 && Math.abs(ny - y + 90) < 2, `${name} at ${nx}, ${ny}`);
        }
        await page.keyboard.press("Control+d");
        assert.deepEqual((await scene(page)).figures.map(({ name }) => name), ["left", "right", "left_2", "right_2"]);
        await page.keyboard.press("Delete");
        assert.equal((await scene(page)).figures.length, 2);
        await page.getByRole("button", { name: "choose all" }).click();
        await page.getByRole("button", { name: "copy", exact: true }).click();
        assert.equal((await scene(page)).figures.length, 4);
        await page.getByRole("button", { name: "delete", exact: true }).click();
        assert.equal((await scene(page)).figures.length, 2);
        assert.equal((await state(page)).tool, "select", "the tool stays");
    }));

test("walls and ground are drawn", () =>
    site.on(desktop, "", async (page) => {
        await begin(page);
        const [x, y] = await middleOf(page, "left");
        await tool(page, "wall");
        await drag(page, [x - 60, y + 90], [x + 90, y + 60]);
        await tool(page, "terrain");
        await drag(page, [x + 150, y + 90], [x + 300, y + 60]);
        assert.deepEqual((await scene(page)).colliders.map(({ shape }) => shape), ["capsule", "chain"]);
        await page.keyboard.press("Control+z");
        assert.equal((await scene(page)).colliders.length, 1);
    }));

test("a joint is of the kind that the panel says", () =>
    site.on(desktop, "", async (page) => {
        await begin(page);
        await tool(page, "join");
        await page.getByRole("radio", { name: /^spring/ }).click();
        await drag(page, await pixelOf(page, "left/top_right"), await pixelOf(page, "right/top_left"));
        const { figures } = await scene(page);
        assert.equal(figures.length, 3);
        assert.ok(figures[2].constraints[0].compliance > 0, JSON.stringify(figures[2]));
    }));

test("a finger carries what it takes, and draws a frame around more", { timeout: 60_000 }, () =>
    site.on(phone, "", async (page) => {
        await begin(page);
        await page.getByRole("radio", { name: /^select/ }).tap();
        const client = await page.context().newCDPSession(page);
        const touch = (type, ...points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
        const box = await page.locator("#stage").boundingBox();
        const before = (await scene(page)).figures.map(({ at }) => at);
        await touch("touchStart", [box.x + 3, box.y + 3]);
        await touch("touchMove", [box.x + box.width - 3, box.y + box.height - 3]);
        await touch("touchEnd");
        const [x, y] = await middleOf(page, "left");
        await touch("touchStart", [x, y]);
        await touch("touchMove", [x, y - 40]);
        await touch("touchEnd");
        for (const [i, { at }] of (await scene(page)).figures.entries()) assert.ok(at[1] > before[i][1] + 0.1, `figure ${i}: ${at}`);
    }));

test("space is pause, after a press of any button too", () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        await page.keyboard.press("Space");
        assert.ok((await state(page)).isPaused, "without a focus");
        await page.getByRole("radio", { name: /^pin/ }).click();
        await page.keyboard.press("Space");
        assert.ok(!(await state(page)).isPaused, "after a tool");
        await page.getByRole("button", { name: "strain" }).click();
        await page.keyboard.press("Space");
        assert.ok((await state(page)).isPaused, "after an overlay");
        assert.deepEqual((await state(page)).overlays, ["strain"]);
        await page.getByRole("button", { name: /^undo/ }).focus();
        await page.keyboard.press("Space");
        assert.ok((await state(page)).isPaused, "a button with the focus of keys is pressed by space");
    }));

test("the spawn tool offers what exists in the scene's dimension, and puts in each of it", { timeout: 90_000 }, () =>
    site.on(desktop, "", async (page) => {
        await begin(page);
        for (const [dimension, more] of [[2, {}], [3, { dimension: 3, view: {} }]]) {
            const floor = { world: { gravity: [0, -9.81, 0].slice(0, dimension) } }, figures = two.figures.map((figure) => ({ ...figure, at: [...figure.at, 0].slice(0, dimension) }));
            await page.evaluate((text) => window.sinew.openText(text, "two"), JSON.stringify({ ...two, ...floor, figures, ...more }));
            await page.evaluate(() => window.sinew.stage.player.pause());
            await tool(page, "spawn");
            const offered = await page.locator("#prefab option").evaluateAll((all) => all.map(({ value }) => value));
            assert.equal(offered.includes("jelly"), dimension === 3);
            assert.equal(offered.includes("car"), dimension === 2);
            const { x, y, width, height } = await page.locator("#stage").boundingBox();
            for (const name of offered.filter((one) => one !== "mesh")) {
                await page.locator("#prefab").selectOption(name);
                await page.mouse.click(x + width / 2, y + height / 2);
                assert.equal((await scene(page)).figures.length, 3, `${name} in ${dimension}D: ${(await state(page)).message}`);
                await page.keyboard.press("Control+z");
            }
        }
    }));

test("a tool tells where its choices are if they are out of sight, on a phone and beside another page of the panel", { timeout: 60_000 }, async () => {
    const told = (page) => page.locator("#message.shown").textContent();
    await site.on(phone, "", async (page) => {
        await begin(page);
        await page.getByRole("radio", { name: /^spawn/ }).tap();
        assert.match(await told(page), /the panel has other figures/);
        await page.getByRole("radio", { name: /^join/ }).tap();
        assert.match(await told(page), /the panel has the kinds of joints/);
    });
    await site.on(desktop, "", async (page) => {
        await begin(page);
        await tool(page, "spawn");
        assert.ok(await page.locator("#prefab").isVisible());
        assert.ok(!(await page.locator("#message.shown").isVisible()), "the choices are in sight");
        await tool(page, "grab");
        await page.getByRole("tab", { name: "statistics" }).click();
        await tool(page, "spawn");
        assert.match(await told(page), /the panel has other figures/);
    });
});
