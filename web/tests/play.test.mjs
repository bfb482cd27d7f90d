// What stopped people in the playground, each once.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { brotliDecompressSync } from "node:zlib";
import { desktop, phone, playing, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const dist = path.resolve(import.meta.dirname, "../dist");

test("both modes in an address open both", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope&mode=both", async (page) => {
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.state().panes), 2);
        assert.equal(await page.getByRole("radio", { name: /^both/ }).getAttribute("aria-checked"), "true");
        await page.waitForFunction(() => location.hash.includes("mode=both"));
        await page.reload();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.state().panes), 2);
        await page.getByRole("radio", { name: /^physical/ }).click();
        await page.waitForFunction(() => !location.hash.includes("both"), null, { timeout: 10_000 });
    }));

test("both modes in an address are called by either name of the mode", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope&solver.mode=both", async (page) => {
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.stage.player.state().panes), 2);
    }));

for (const width of [360, 480, 600, 680, 742, 800])
    test(`every button of the menu is on the page: ${width} pixels`, { timeout: 60_000 }, () =>
        site.on({ viewport: { width, height: 800 } }, "#scene=rope", async (page) => {
            await playing(page);
            for (const button of await page.locator("#menu > *:visible").all()) {
                const { x, width: own } = await button.boundingBox();
                assert.ok(x >= 0 && x + own <= width, `${await button.getAttribute("class")} ends at ${x + own}`);
            }
            await page.getByRole("button", { name: "panel", exact: true }).click();
            await page.getByRole("tab", { name: "text" }).waitFor();
        }));

test("every tool of the phone's bar is on the page, undo and measure too", { timeout: 60_000 }, () =>
    site.on(phone, "#scene=rope", async (page) => {
        await playing(page);
        const buttons = await page.locator("#tools button").all();
        assert.ok(buttons.length >= 11);
        for (const button of buttons) {
            const { x, width } = await button.boundingBox();
            assert.ok(x >= 0 && x + width <= 390, `${await button.getAttribute("title")} ends at ${x + width}`);
        }
        await page.getByRole("radio", { name: /^measure/ }).tap();
        assert.equal(await page.evaluate(() => window.sinew.stage.player.state().tool), "measure");
    }));

for (const [width, height] of [[568, 320], [740, 360], [844, 390], [915, 412], [1280, 540]])
    test(`every tool of a phone on its side is in sight, and the scene has most of the page: ${width} x ${height}`, { timeout: 60_000 }, () =>
        site.on({ ...phone, viewport: { width, height } }, "#scene=rope", async (page) => {
            await playing(page);
            for (const button of await page.locator("#tools button").all()) {
                const box = await button.boundingBox();
                assert.ok(box.y >= 0 && box.y + box.height <= height && box.x + box.width <= width, `${await button.getAttribute("title")} ends at ${box.y + box.height}`);
                assert.ok(box.width >= 40 && box.height >= 40, "as large as a finger");
            }
            const scene = await page.locator("#stage").boundingBox(), side = width > 860 ? 340 : 0;
            assert.ok(scene.height >= 0.6 * height && scene.width >= 0.75 * (width - side), `${scene.width} x ${scene.height}`);
            assert.ok((await page.locator("#time .timeline").boundingBox()).width >= 80, "a timeline to drag along");
        }));

test("a tab that outlives a deployment is loaded again when a chunk is gone, once", { timeout: 60_000 }, async () => {
    const context = await site.browser.newContext({ ...desktop, serviceWorkers: "block" });
    const page = await context.newPage();
    let isGone = true, loads = 0;
    await page.route(/\/assets\/.*\.js$/, (route) => (isGone && /editor/.test(route.request().url()) ? route.fulfill({ status: 404 }) : route.continue()));
    page.on("load", () => ++loads);
    await page.goto(`${site.address}#scene=rope`);
    await playing(page);
    await page.getByRole("tab", { name: "text" }).click();
    await page.waitForEvent("load");
    isGone = false;
    await playing(page);
    await page.getByRole("tab", { name: "text" }).click();
    await page.locator(".cm-content").waitFor();
    assert.equal(loads, 2);
    await context.close();
});

const goTo = (hash) => (page) => page.evaluate((hash) => (location.hash = hash), hash);
const writeModel = async (page) => {
    await page.locator("summary", { hasText: "save" }).click();
    await page.getByRole("button", { name: "model (glTF)" }).click();
};
for (const [what, file, ask] of [
    ["text of a scene", /\/boxes-.*\.json$/, goTo("#scene=boxes")],
    ["module of float worlds", /\/sinew-float.*\.wasm$/, goTo("#scene=rope&solver.precision=float")],
    ["module of exports", /\/sinew-export.*\.wasm$/, writeModel],
    ["worker of the gallery", /\/thumbnails.*\.js$/, goTo("#")],
])
    test(`a tab that outlives a deployment is loaded again when this is gone: the ${what}`, { timeout: 60_000 }, async () => {
        const context = await site.browser.newContext({ ...desktop, serviceWorkers: "block" }), page = await context.newPage();
        await page.goto(`${site.address}#scene=rope`);
        await playing(page);
        await page.route(file, (route) => route.fulfill({ status: 404 }));
        const loaded = page.waitForEvent("load", { timeout: 20_000 });
        await ask(page);
        await loaded;
        await context.close();
    });

test("a phone's help has its fingers first, and a scene in both modes no name over theirs", { timeout: 60_000 }, () =>
    site.on(phone, "#scene=suspension_bridge&mode=both", async (page) => {
        await playing(page);
        const name = () => page.evaluate(() => getComputedStyle(document.getElementById("scene"), "::after").content);
        assert.equal(await name(), "none");
        await page.evaluate(() => (window.sinew.stage.player.do("split"), window.sinew.changed()));
        assert.equal(await name(), '"suspension bridge"');
        await page.getByRole("button", { name: "keys", exact: true }).tap();
        assert.equal(await page.locator(".help kbd").first().textContent(), "one finger");
    }));

test("a new scene and a file open from the gallery", { timeout: 60_000 }, () =>
    site.on(desktop, "", async (page) => {
        await page.waitForFunction(() => window.sinew?.scenes);
        await page.getByRole("button", { name: "new scene" }).click();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.opened.name), "new scene");
        assert.match(await page.locator("#side .about").textContent(), /^A room with a box in it/);
        assert.deepEqual(await page.evaluate(() => window.sinew.stage.player.simulation.figures().map(({ name }) => name)), ["box"]);
        const text = await page.evaluate(() => window.sinew.stage.player.sceneText());
        await page.getByRole("link", { name: "scenes", exact: true }).click();
        const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "open a file" }).click()]);
        await chooser.setFiles({ name: "my_room.json", mimeType: "application/json", buffer: Buffer.from(text) });
        await page.waitForFunction(() => window.sinew.opened.name === "my_room");
    }));

/** Runs in the page before its scripts: an address is written later than a hand is. */
function slowAddresses() {
    const own = globalThis.Response.prototype.arrayBuffer;
    globalThis.Response.prototype.arrayBuffer = async function () {
        const bytes = await own.call(this);
        await new Promise((resolve) => setTimeout(resolve, 500));
        return bytes;
    };
}

test("who leaves a new scene at once is in the gallery, and Back leads from a new scene to it", { timeout: 60_000 }, () =>
    site.on({ ...desktop, script: slowAddresses }, "", async (page) => {
        await page.waitForFunction(() => window.sinew?.scenes);
        const inGallery = () => page.evaluate(() => !document.getElementById("gallery").hidden && document.getElementById("player").hidden);
        await page.getByRole("button", { name: "new scene" }).click();
        await playing(page);
        assert.match(await page.evaluate(() => location.hash), /^#z=/);
        await page.goBack();
        await page.locator("#gallery").waitFor();
        await page.getByRole("button", { name: "new scene" }).click();
        await playing(page);
        await page.evaluate(() => (window.sinew.stage.player.setTool("pin"), window.sinew.stage.player.do("mode"), window.sinew.changed()));
        await page.waitForTimeout(500); // the address of the changed scene is being written
        await page.getByRole("link", { name: "scenes", exact: true }).click();
        await page.waitForTimeout(1500);
        assert.ok(await inGallery());
        assert.equal(await page.evaluate(() => location.hash), "");
    }));

/** Runs in the page before its scripts: the text of one scene is long on its way. */
function slowBoxes() {
    const own = window.fetch;
    window.fetch = async (address, ...more) => {
        if (/\/boxes-[^/]*\.json$/.test(address)) await new Promise((resolve) => setTimeout(resolve, 1000));
        return own(address, ...more);
    };
}

test("of two scenes asked for one after the other, the later stays", { timeout: 60_000 }, () =>
    site.on({ ...desktop, script: slowBoxes }, "#scene=rope", async (page) => {
        await playing(page);
        await page.evaluate(() => (location.hash = "#scene=boxes"));
        await page.waitForTimeout(100);
        await page.evaluate(() => (location.hash = "#scene=swing"));
        await page.waitForFunction(() => window.sinew.opened.name === "swing");
        await page.waitForTimeout(1500);
        assert.equal(await page.evaluate(() => window.sinew.opened.name), "swing");
    }));

test("the name of a file is kept, by its address too", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const text = (await page.evaluate(() => window.sinew.opened.text)).replace(/"weight": \d+/, '"weight": 9');
        await page.evaluate((text) => window.sinew.openText(text, "my rope.json"), text);
        await page.waitForFunction(() => location.hash.includes("name="));
        await page.reload();
        await playing(page);
        assert.equal(await page.evaluate(() => window.sinew.opened.name), "my rope");
        await page.locator("summary", { hasText: "save" }).click();
        const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "scene (JSON)" }).click()]);
        assert.equal(download.suggestedFilename(), "my rope.json");
    }));

test("the focus goes with the keyboard: from a card to the scene, and back", { timeout: 60_000 }, () =>
    site.on(desktop, "", async (page) => {
        await page.waitForFunction(() => window.sinew?.scenes);
        await page.locator('.card[href="#scene=curtain"]').focus();
        await page.keyboard.press("Enter");
        await playing(page);
        assert.equal(await page.evaluate(() => document.activeElement.id), "stage");
        await page.evaluate(() => (location.hash = "#"));
        await page.waitForFunction(() => document.activeElement?.getAttribute("href") === "#scene=curtain");
    }));

test("the focus goes with the keyboard: from the list of files to its head, to a new scene and back", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        await page.locator("summary", { hasText: "save" }).focus();
        for (const key of ["Enter", "Tab"]) await page.keyboard.press(key);
        await Promise.all([page.waitForEvent("download"), page.keyboard.press("Enter")]);
        assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "save");
        await page.evaluate(() => (location.hash = "#"));
        await page.getByRole("button", { name: "new scene" }).focus();
        await page.keyboard.press("Enter");
        await page.waitForFunction(() => document.activeElement.id === "stage");
        await page.evaluate(() => (location.hash = "#"));
        await page.waitForFunction(() => document.activeElement.textContent === "new scene", null, { timeout: 10_000 });
    }));

test("the focus goes with the keyboard: into the drawer of a narrow page, and back to its button", { timeout: 60_000 }, () =>
    site.on({ viewport: { width: 742, height: 800 } }, "#scene=rope", async (page) => {
        await playing(page);
        const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent);
        await page.getByRole("button", { name: "panel", exact: true }).focus();
        await page.keyboard.press("Enter");
        assert.equal(await focused(), "parameters");
        await page.keyboard.press("Escape");
        await page.locator("#side").waitFor({ state: "hidden" });
        assert.equal(await focused(), "panel");
    }));

test("the gallery has the best first, each scene once, and filters by kind", { timeout: 60_000 }, () =>
    site.on(desktop, "", async (page) => {
        await page.waitForFunction(() => window.sinew?.scenes);
        const names = await page.locator(".card .name").allTextContents();
        assert.deepEqual(names.slice(0, 6), ["ragdoll pose", "spiderweb", "tree", "polygons", "curtain", "hammock"]);
        assert.equal(new Set(names).size, await page.evaluate(() => window.sinew.scenes.length));
        await page.getByRole("button", { name: "cloth", exact: true }).click();
        const kinds = await page.evaluate(() => {
            const kindOf = new Map(window.sinew.scenes.map(({ name, category }) => [`#scene=${name}`, category]));
            return [...document.querySelectorAll(".card:not([hidden])")].map((card) => kindOf.get(card.getAttribute("href")));
        });
        assert.ok(kinds.length > 3 && kinds.every((kind) => kind === "cloth"), kinds.join(" "));
        await page.getByRole("button", { name: "all", exact: true }).click();
        assert.equal(await page.locator(".card:visible").count(), names.length);
    }));

test("a card shows classic beside physical while the pointer is on it", { timeout: 60_000 }, () =>
    site.on(desktop, "", async (page) => {
        const card = page.locator('.card[href="#scene=ragdoll_pose"]'), modes = () => card.locator("canvas").getAttribute("data-modes");
        await page.waitForFunction(() => document.querySelectorAll(".card canvas.drawn").length >= 8, null, { timeout: 40_000 }); // each has its first picture before others move
        assert.equal(await modes(), "1");
        await card.hover();
        await page.waitForFunction(() => document.querySelector('.card[href="#scene=ragdoll_pose"] canvas').dataset.modes === "2", null, { timeout: 10_000 });
        await page.mouse.move(2, 2);
        await page.waitForFunction(() => document.querySelector('.card[href="#scene=ragdoll_pose"] canvas').dataset.modes === "1", null, { timeout: 10_000 });
        await card.click();
        await playing(page);
        await page.goBack();
        await page.waitForFunction(() => document.activeElement.getAttribute("href") === "#scene=ragdoll_pose");
        await page.mouse.move(2, 2);
        // A card shows one mode for a focus that the pointer brought.
        await page.waitForFunction(() => document.querySelector('.card[href="#scene=ragdoll_pose"] canvas').dataset.modes === "1", null, { timeout: 20_000 });
    }));

test("the module of float worlds is loaded when a scene asks for it; an open page goes to float and back", { timeout: 60_000 }, async () => {
    const context = await site.browser.newContext({ ...desktop, serviceWorkers: "block" });
    const page = await context.newPage();
    const asked = [];
    page.on("request", (request) => request.url().endsWith(".wasm") && asked.push(request.url().replace(/.*\//, "")));
    await page.goto(`${site.address}#scene=rope`);
    await playing(page);
    assert.ok(asked.length > 0 && asked.every((name) => !name.includes("float")), asked.join(" "));
    await page.evaluate(() => (location.hash = "#scene=rope&solver.precision=float"));
    await page.waitForFunction(() => window.sinew.stage.player.simulation.precision === "float", null, { timeout: 30_000 });
    assert.ok(asked.some((name) => name.includes("float")));
    const precision = () => page.evaluate(() => window.sinew.stage.player.simulation.precision);
    await page.evaluate(() => (location.hash = "#scene=boxes"));
    await page.waitForFunction(() => window.sinew.opened.name === "boxes");
    assert.equal(await precision(), "double", "and back");
    await page.evaluate(() => window.sinew.stage.player.setTool("cut"));
    await page.evaluate(() => window.sinew.stage.become(window.sinew.opened.text.replace('"sinew": 1,', '"sinew": 1, "solver": {"precision": "float"},')));
    assert.equal(await precision(), "float", "an edited text, too");
    assert.equal(await page.evaluate(() => window.sinew.stage.player.state().tool), "cut", "the tool stays");
    const { step } = await page.evaluate(() => window.sinew.stage.player.state());
    await page.waitForFunction((step) => window.sinew.stage.player.state().step > step + 3, step);
    await context.close();
});

test("modules that a scene or a file asks for are kept when they have been loaded, and not before", { timeout: 120_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        const kept = () => page.evaluate(async () => (await (await caches.open((await caches.keys())[0])).keys()).map(({ url }) => url.replace(/.*\//, "")).filter((name) => /^sinew-(float|export|import)/.test(name)));
        await page.evaluate(() => navigator.serviceWorker.ready);
        await page.waitForFunction(() => navigator.serviceWorker.controller !== null, null, { timeout: 30_000 });
        assert.deepEqual(await kept(), []);
        await page.evaluate(() => (location.hash = "#scene=rope&solver.precision=float", location.reload()));
        const isFloat = () => window.sinew?.stage?.player.simulation.precision === "float";
        await page.waitForFunction(isFloat, null, { timeout: 30_000 });
        assert.ok((await kept()).length >= 1);
    }));

test("files have copies under Brotli that say the same; a first visit weighs what docs/measured/web.md says", { timeout: 120_000 }, async () => {
    const names = readdirSync(dist, { recursive: true }).filter((name) => /\.(html|js|css|wasm|svg)$/.test(name));
    for (const name of names) {
        assert.ok(existsSync(path.join(dist, `${name}.br`)), name);
        assert.ok(brotliDecompressSync(readFileSync(path.join(dist, `${name}.br`))).equals(readFileSync(path.join(dist, name))), name);
    }
    const own = await visit(); // whose server no service worker of another test asks
    const [scene, gallery] = [await weighed(own, "#scene=rope"), await weighed(own, "")];
    await own.end();
    const [, ...told] = /^\| all \| \*\*(\d+)\*\* \| \*\*(\d+)\*\* \|/m.exec(readFileSync(path.resolve(dist, "../../docs/measured/web.md"), "utf8")).map(Number);
    for (const [i, weight] of [scene, gallery].entries()) assert.ok(Math.abs(weight - told[i]) <= 0.03 * told[i], `${weight} KB, ${told[i]} by the page`);
    assert.equal(readdirSync(path.join(dist, "assets")).filter((name) => /^catalogue-.*\.js$/.test(name)).length, 1, "the catalogue once");
});

/** KB that a first visit has asked for when its scene, or the first pictures of the gallery, are there: by the page and its workers, without images, which come one by one. */
async function weighed(site, address) {
    const context = await site.browser.newContext({ ...desktop, serviceWorkers: "block" }), page = await context.newPage();
    site.server.sent.length = 0;
    await page.goto(site.address + address);
    if (address) await playing(page);
    else await page.waitForFunction(() => document.querySelectorAll(".card canvas.drawn").length >= 8, null, { timeout: 40_000 });
    await context.close();
    return site.server.sent.filter(({ name }) => !name.endsWith(".png")).reduce((sum, { bytes }) => sum + bytes, 0) / 1024;
}

test("a mistake in an address and in a file is told in the page's words, with the name that was meant", { timeout: 60_000 }, async () => {
    await site.on(desktop, "#scene=rope&figures.line.segmants=3", async (page) => {
        const told = page.locator("#message.shown");
        await told.waitFor();
        assert.equal(await told.textContent(), 'in the address, figures.line.segmants=3: unknown property "segmants"; did you mean "segments"?');
    });
    await site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        await page.evaluate(() => window.sinew.openText('{"sinew": 1,\n "figurs": []}', "mine"));
        assert.match(await page.locator("#message.shown").textContent(), /^line 2: unknown property "figurs"; did you mean "figures"\?/);
        assert.equal(await page.evaluate(() => window.sinew.opened.name), "rope");
    });
});
