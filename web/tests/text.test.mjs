// The scene as text, its errors, and as an address.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
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
        await replace(page, "with an iron ball", "mit eiserner Kugel ☂");
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

test("the scene is saved as files of other programs; the module for them is loaded once, when it is asked for", { timeout: 120_000 }, () =>
    site.on(desktop, "#scene=rope&seconds=1", async (page) => {
        const asked = [];
        page.on("request", (request) => request.url().endsWith(".wasm") && asked.push(request.url().replace(/.*\//, "")));
        await playing(page);
        await page.evaluate(() => window.sinew.stage.player.pause()); // leaves the processor to the file
        const saved = async (name) => {
            await page.locator("summary", { hasText: "save" }).click();
            const [download] = await Promise.all([page.waitForEvent("download", { timeout: 60_000 }), page.getByRole("button", { name, exact: true }).click()]);
            return [download.suggestedFilename(), await readFile(await download.path())];
        };
        assert.ok(asked.every((name) => !name.includes("export")), asked.join(" "));
        const [name, glb] = await saved("model (glTF)");
        assert.deepEqual([name, glb.subarray(0, 4).toString()], ["rope.glb", "glTF"]);
        const { animations } = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());
        assert.ok(animations.length > 0);
        const [drawing, svg] = await saved("moving drawing (SVG)");
        assert.equal(drawing, "rope.svg");
        assert.match(svg.toString(), /^<svg[^]*<animate/);
        const [film, lottie] = await saved("animation (Lottie)");
        assert.equal(film, "rope.json");
        assert.ok(JSON.parse(lottie).layers.length > 0);
        const [mesh, obj] = await saved("mesh (OBJ)");
        assert.equal(mesh, "rope.obj");
        assert.match(obj.toString(), /^v /m);
        assert.equal(asked.filter((name) => name.includes("export")).length, 1);
    }));

test("an OBJ model is opened as cloth; a file without a shape or a face is told, and the scene stays", { timeout: 60_000 }, () =>
    site.on(desktop, "#scene=rope", async (page) => {
        await playing(page);
        const open = async (name, text) => {
            await page.locator("summary", { hasText: "save" }).click();
            const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "open a file" }).click()]);
            await chooser.setFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
        };
        const corner = (i, k) => `v ${i * 0.5} ${k * 0.5} 0`, corners = [0, 1, 2].flatMap((k) => [0, 1, 2].map((i) => corner(i, k)));
        await open("sheet.obj", [...corners, "f 1 2 5 4", "f 2 3 6 5", "f 4 5 8 7", "f 5 6 9 8"].join("\n"));
        await page.waitForFunction(() => window.sinew.opened.name === "sheet" && window.sinew.stage.player.state().step > 10, null, { timeout: 30_000 });
        assert.equal(await page.evaluate(() => window.sinew.stage.player.simulation.particleCount), 9);
        await open("drawing.svg", "<svg/>");
        await page.locator("#message.shown", { hasText: "no shape in it" }).waitFor();
        await open("empty.obj", "# nothing");
        await page.locator("#message.shown", { hasText: "no face in it" }).waitFor();
        assert.equal(await page.evaluate(() => window.sinew.opened.name), "sheet");
    }));

test("share copies an address that another browser opens as the same scene", () =>
    site.on(desktop, "#scene=rope&mode=classic", async (page) => {
        await playing(page);
        await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
        await page.evaluate(() => window.sinew.stage.player.set("figures.rope.weight", 21));
        await page.getByRole("button", { name: "share" }).click();
        await page.locator("#message.shown", { hasText: "copied" }).waitFor();
        const [address, text] = await page.evaluate(async () => [await navigator.clipboard.readText(), window.sinew.stage.player.sceneText()]);
        assert.match(text, /"weight": ?21/);
        await site.on(desktop, address.slice(site.address.length), async (other) => {
            await playing(other);
            assert.equal(await other.evaluate(() => window.sinew.stage.player.sceneText()), text);
        });
    }));

test("a saved scene opens again as a file, and by pasting", () =>
    site.on(desktop, "#scene=box", async (page) => {
        await playing(page);
        const text = await page.evaluate(() => window.sinew.stage.player.sceneText());
        await page.evaluate(() => (location.hash = "#scene=rope"));
        await page.waitForFunction(() => window.sinew.opened.name === "rope");
        const paste = (text) => page.evaluate((text) => {
            const clipboardData = new DataTransfer();
            clipboardData.setData("text/plain", text);
            document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
        }, text);
        await paste(text);
        await page.waitForFunction(() => window.sinew.opened.name === "pasted scene");
        assert.equal(await page.evaluate(() => window.sinew.stage.player.sceneText()), text);
        await page.locator("summary", { hasText: "save" }).click();
        const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "open a file" }).click()]);
        await chooser.setFiles({ name: "mine.json", mimeType: "application/json", buffer: Buffer.from(text) });
        await page.waitForFunction(() => window.sinew.opened.name === "mine");
        await paste("{\"sinew\": 1, \"figurs\": []}");
        await page.locator("#message.shown", { hasText: "figurs" }).waitFor();
    }));

/** Frames and size of a film, as ffprobe counts them. */
async function probed(file) {
    const { stdout } = await promisify(execFile)("ffprobe", ["-v", "error", "-count_frames", "-select_streams", "v", "-show_entries", "stream=nb_read_frames,width,height", "-of", "json", file]);
    return JSON.parse(stdout).streams[0];
}

/** Runs before a page's own scripts: counts the parts of films, frames of a GIF and pieces of a video. */
function countParts() {
    window.filmed = 0;
    const count = ({ data }) => (window.filmed += data === "frame" || data?.size > 0 ? 1 : 0);
    window.Worker = class extends Worker {
        constructor(...given) {
            super(...given);
            this.addEventListener("message", count);
        }
    };
    window.MediaRecorder = class extends MediaRecorder {
        constructor(...given) {
            super(...given);
            this.addEventListener("dataavailable", count);
        }
    };
}

test("a film is recorded as GIF and as WebM", { timeout: 120_000 }, () =>
    site.on({ ...desktop, script: countParts }, "#scene=rope", async (page) => {
        await playing(page);
        for (const [name, begins] of [["film (GIF)", "GIF89a"], ["film (WebM)", "\x1aE\xdf\xa3"]]) {
            await page.locator("summary", { hasText: "save" }).click();
            await page.getByRole("button", { name }).click();
            await page.evaluate(() => (window.filmed = 0));
            await page.waitForFunction(() => window.filmed >= 4, null, { timeout: 60_000 }); // a busy machine encodes late
            const [download] = await Promise.all([page.waitForEvent("download", { timeout: 90_000 }), page.getByRole("button", { name: "recording" }).click()]);
            const file = await download.path();
            assert.equal((await readFile(file)).subarray(0, begins.length).toString("latin1"), begins);
            const { nb_read_frames, width, height } = await probed(file);
            assert.ok(nb_read_frames >= 2 && width > 200 && height > 100, `${name}: ${nb_read_frames} frames, ${width} x ${height}`);
        }
    }));
