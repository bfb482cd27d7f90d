// The lessons in the browser: figures, programs that are edited, run, broken and reset.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { desktop, moving, phone, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

/** Replaces a text of the first editor, as its user would by selecting and typing. */
async function rewrite(page, from, to) {
    await page.locator(".lines .acts").first().scrollIntoViewIfNeeded(); // the editor comes when it is in sight
    await page.locator(".cm-content").first().waitFor();
    await page.evaluate(([from, to]) => {
        const view = document.querySelector(".cm-content").cmTile?.view ?? document.querySelector(".cm-content").cmView.view;
        const at = view.state.doc.toString().indexOf(from);
        if (at < 0) throw new Error(`no ${from}`);
        view.dispatch({ changes: { from: at, to: at + from.length, insert: to } });
    }, [from, to]);
}

const state = (page, i = 0) => page.evaluate((i) => window.sinew.views[i].state, i);
const run = (page) => page.locator(".run").first().click();
const problem = (page) => page.locator(".live .problems button").first();

test("every figure of every lesson runs, and its slider acts", { timeout: 300_000 }, () =>
    site.on(desktop, "learn/", async (page) => {
        await page.locator(".cover").waitFor();
        const lessons = await page.evaluate(() => window.sinew.lessons);
        assert.ok(lessons.length >= 18);
        for (const { id, figures } of lessons) {
            await page.evaluate((id) => (location.hash = id), id);
            await page.waitForFunction(([id, figures]) => document.querySelector("#contents [aria-current]")?.hash === `#${id}` && window.sinew.views.length === figures, [id, figures]);
            for (let i = 0; i < figures; ++i) {
                const slider = page.locator(".live input.slider").nth(i);
                await slider.scrollIntoViewIfNeeded();
                await page.waitForFunction((i) => window.sinew.views[i].state.steps > 3, i, { timeout: 60_000 });
                const before = (await state(page, i)).text;
                const isLow = await slider.evaluate((slider) => slider.value === slider.min);
                await slider.press(isLow ? "End" : "Home");
                await page.waitForFunction(([i, before]) => window.sinew.views[i].state.text !== before, [i, before]);
                await page.waitForFunction((i) => window.sinew.views[i].state.steps > 3, i);
            }
        }
    }));

test("a program is edited, run, and reset", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#point", async (page) => {
        await moving(page);
        await rewrite(page, "speedY + gravity * dt * dt", "0");
        await run(page);
        assert.ok((await state(page)).text.includes("ball.y += 0"));
        await page.waitForFunction(() => window.sinew.views[0].state.live.height === 384 - 330); // it flies level
        await page.waitForFunction(() => document.querySelector(".live canvas").getBoundingClientRect().top > 0); // and is in sight
        await page.getByRole("button", { name: "Reset" }).click();
        assert.ok((await state(page)).text.includes("speedY + gravity"));
        await page.waitForFunction(() => window.sinew.views[0].state.live.height !== 384 - 330);
        await page.waitForFunction(() => document.querySelector(".live canvas").getBoundingClientRect().bottom > 40); // in sight again: out of sight it would stand still
        await moving(page);
    }));

test("an error stands at its line: of writing, and of running", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#point", async (page) => {
        await moving(page);
        const line = (await state(page)).text.split("\n").findIndex((text) => text.includes("ball.oldX = ball.x;")) + 1;
        await rewrite(page, "ball.oldX = ball.x;", "ball.oldX = = ball.x;");
        await run(page);
        await problem(page).waitFor();
        assert.match(await problem(page).textContent(), new RegExp(`line ${line}.*SyntaxError`));
        assert.ok((await page.locator(".cm-line.wrong").textContent()).includes("= ="));
        await rewrite(page, "ball.oldX = = ball.x;", "nothing.oldX = ball.x;");
        await run(page);
        await page.waitForFunction(() => document.querySelector(".problems button")?.textContent.includes("nothing"));
        assert.match(await problem(page).textContent(), new RegExp(`line ${line}.*nothing is not defined`));
        await rewrite(page, "nothing.oldX", "ball.oldX");
        await run(page);
        await page.waitForFunction(() => window.sinew.views[0].state.steps > 20 && !document.querySelector(".problems button"));
    }));

const workerBegins = 40_000; // milliseconds: on a busy machine the page gives the worker of a program 30 seconds to begin

test("a loop without end is stopped, in the first line and in a step", { timeout: 180_000 }, () =>
    site.on(desktop, "learn/#point", async (page) => {
        await moving(page);
        for (const [from, to] of [["function step(dt) {", "function step(dt) { for (;;);"], ["let gravity", "while (true);\nlet gravity"]]) {
            await rewrite(page, from, to);
            await run(page);
            await problem(page).waitFor({ timeout: workerBegins });
            assert.match(await problem(page).textContent(), /longer than two seconds/);
        }
        await page.getByRole("button", { name: "Reset" }).click();
        await moving(page);
    }));

test("a program can do no harm: it has neither the page nor the network", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#point", async (page) => {
        await moving(page);
        await rewrite(page, "let gravity", "document.title = 1;\nlet gravity");
        await run(page);
        await problem(page).waitFor();
        assert.match(await problem(page).textContent(), /line 1.*document is not defined/);
    }));

test("a scene is edited and run, and its errors stand at their lines", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#triangle", async (page) => {
        await moving(page);
        const { text } = await state(page);
        assert.equal(JSON.parse(text).sinew, 1);
        await rewrite(page, '"sides": 3', '"sides": 5');
        await run(page);
        await page.waitForFunction(() => window.sinew.views[0].player.simulation.particleCount === 5);
        const line = text.split("\n").findIndex((one) => one.includes('"gravity"')) + 1;
        await rewrite(page, '"gravity"', '"gravitty"');
        await run(page);
        await problem(page).waitFor();
        assert.match(await problem(page).textContent(), new RegExp(`line ${line}.*gravitty.*gravity`));
        assert.ok(await page.locator("input.slider").isDisabled());
        await page.getByRole("button", { name: "Reset" }).click();
        await page.waitForFunction(() => window.sinew.views[0].player.simulation.particleCount === 3);
    }));

test("a hand throws what a program draws", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#stick", async (page) => {
        await moving(page);
        await page.evaluate(() => window.sinew.views[0].standStill(5));
        const canvas = page.locator(".live canvas").first();
        await canvas.scrollIntoViewIfNeeded();
        const box = await canvas.boundingBox();
        const at = (x, y) => [box.x + (x * box.width) / 640, box.y + (y * box.height) / 400];
        await page.waitForFunction(() => window.sinew.views[0].state.steps === 5);
        await page.mouse.move(...at(170, 230));
        await page.mouse.down(); // before the stick moves on
        await page.getByRole("button", { name: "go on" }).evaluate((button) => button.click());
        await page.waitForFunction(() => window.sinew.views[0].state.steps > 5);
        await page.mouse.move(...at(560, 80), { steps: 10 });
        await page.waitForFunction(() => { // an end is where the hand is
            const canvas = document.querySelector(".live canvas"), pen = canvas.getContext("2d");
            const { data } = pen.getImageData(Math.round(canvas.width * 0.76), 0, Math.round(canvas.width * 0.24), Math.round(canvas.height * 0.45));
            return data.some((value, i) => i % 4 === 2 && data[i - 2] > 200 && value < 80);
        });
        await page.mouse.up();
    }));

test("a challenge is checked, and what is done is kept", { timeout: 120_000 }, () =>
    site.on(desktop, "learn/#compliance", async (page) => {
        await moving(page);
        await rewrite(page, "let compliance = 0.05", "let compliance = 0.102");
        await rewrite(page, "-0.7 * h", "-4 * h");
        await run(page);
        await page.locator(".challenge.solved").waitFor({ timeout: workerBegins });
        await page.reload();
        await page.locator(".challenge.solved").waitFor();
        assert.ok(await page.locator('#contents a.solved[href="#compliance"]').isVisible());
    }));

test("a text that was run is there after another lesson and after a reload, until it is reset", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#point", async (page) => {
        await moving(page);
        await rewrite(page, "speedY + gravity * dt * dt", "0");
        await run(page);
        await page.locator(".turn .on").click();
        await page.waitForFunction(() => document.querySelector("h1").textContent.includes("stick"));
        await page.goBack();
        const isFlying = () => page.waitForFunction(() => window.sinew?.views[0]?.state.live.height === 384 - 330);
        await isFlying();
        await page.reload();
        await isFlying();
        assert.ok((await state(page)).text.includes("ball.y += 0"));
        assert.ok(await page.locator(".lines.edited").isVisible());
        await page.getByRole("button", { name: "Reset" }).click();
        await page.reload();
        await moving(page);
        assert.ok((await state(page)).text.includes("speedY + gravity"));
    }));

test("a lesson begins at its head after a reload, where its figure moves", { timeout: 90_000 }, () =>
    site.on(desktop, "learn/#point", async (page) => {
        for (let i = 0; i < 6; ++i) { // the browser goes back to where a reader was, sooner or later than the lesson comes
            await moving(page);
            await page.evaluate(() => scrollTo(0, 900));
            await page.waitForTimeout(300);
            await page.reload();
            await moving(page);
            await page.waitForTimeout(500);
            assert.equal(await page.evaluate(() => scrollY), 0);
        }
    }));

test("numbers in the text follow the figure", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#triangle", async (page) => {
        await moving(page);
        await page.locator("input.slider").press("End");
        await page.waitForFunction(() => document.querySelector('p output[name="needed"]').textContent === "21");
    }));

test("words are explained on hover and by the keyboard", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#compliance", async (page) => {
        await moving(page);
        const term = page.locator(".term").first();
        assert.ok(!(await term.locator(".tip").isVisible()));
        await term.hover();
        assert.ok(await term.locator(".tip").isVisible());
        await page.mouse.move(0, 0);
        await term.focus();
        assert.match(await term.locator(".tip").textContent(), /stiffness/);
        assert.ok(await term.locator(".tip").isVisible());
    }));

test("explanations stay on the page", { timeout: 60_000 }, async () => {
    for (const options of [desktop, phone])
        await site.on(options, "learn/#ragdoll", async (page) => {
            await moving(page);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "before");
            const term = page.locator(".term", { hasText: "torque" });
            await term.focus();
            const { x, width } = await term.locator(".tip").boundingBox();
            assert.ok(x >= 0 && x + width <= options.viewport.width, `${x} ${width}`);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
        });
});

test("a challenge of a scene counts what the reader's own text has", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#triangle", async (page) => {
        await moving(page);
        await page.locator("input.slider").press("ArrowRight");
        await page.locator("input.slider").press("ArrowRight");
        await page.locator("input.slider").press("ArrowRight");
        await page.waitForFunction(() => document.querySelector("p output[name=needed]").textContent === "9");
        const code = await page.locator(".challenge code").textContent();
        assert.match(code, /constraints/);
        const more = code.replace("}]", '}, {"between": ["form/corner_0", "form/corner_3"]}, {"between": ["form/corner_0", "form/corner_4"]}]');
        await rewrite(page, "}]\n}", `}], ${more}\n}`);
        await run(page);
        await page.locator(".challenge.solved").waitFor({ timeout: workerBegins });
        assert.equal(await page.locator("p output[name=sticks]").textContent(), "9");
    }));

test("printed, a lesson has its text, its figure and its program, and nothing to press", { timeout: 60_000 }, () =>
    site.on(desktop, "learn/#stick", async (page) => {
        await moving(page);
        await page.emulateMedia({ media: "print" });
        for (const shown of ["h1", ".live canvas", ".lines"]) assert.ok(await page.locator(shown).first().isVisible(), shown);
        for (const hidden of [".menu", "#contents", ".controls button", ".controls input", ".acts", ".turn"]) assert.ok(!(await page.locator(hidden).first().isVisible()), hidden);
    }));

test("words for fingers where there are fingers, and a knife for them", { timeout: 60_000 }, async () => {
    for (const [options, shown] of [[desktop, "mouse"], [phone, "touch"]])
        await site.on(options, "learn/#cloth", async (page) => {
            await moving(page);
            for (const way of ["mouse", "touch"]) assert.equal(await page.locator(`figcaption .${way}`).first().isVisible(), way === shown, `${way} where there is ${shown}`);
            await page.getByRole("button", { name: "knife" }).click();
            assert.equal(await page.evaluate(() => window.sinew.views[0].player.state().tool), "cut");
        });
});

test("in German, by the address, by the browser, and by a button", { timeout: 60_000 }, async () => {
    await site.on(desktop, "learn/?language=de#stick", async (page) => {
        await moving(page);
        assert.equal(await page.locator("h1").textContent(), "Zwei Punkte und ein Stab");
        assert.equal(await page.evaluate(() => document.documentElement.lang), "de");
        assert.match((await state(page)).text, /die Hälfte des Fehlers/);
        await page.waitForFunction(() => /\d,\d/.test(document.querySelector(".reading").textContent)); // a German number
        await page.getByRole("button", { name: "English" }).click();
        await page.waitForFunction(() => document.querySelector("h1").textContent === "Two points and a stick");
        await page.reload();
        await page.waitForFunction(() => document.querySelector("h1")?.textContent === "Two points and a stick");
    });
    await site.on({ ...desktop, locale: "de-AT" }, "learn/", async (page) => {
        await page.getByRole("heading", { name: "Vom Punkt zur Gliederpuppe" }).waitFor();
    });
});

test("readable and printable without JavaScript, in both languages", { timeout: 60_000 }, async () => {
    const context = await site.browser.newContext({ javaScriptEnabled: false });
    const page = await context.newPage();
    await page.goto(`${site.address}learn/`);
    for (const [link, heading] of [["in English", "From a point to a ragdoll"], ["auf Deutsch", "Vom Punkt zur Gliederpuppe"]]) {
        await page.goto(`${site.address}learn/`);
        await page.getByRole("link", { name: link }).click();
        await page.getByRole("heading", { name: heading }).waitFor();
        await page.waitForLoadState();
        assert.ok(await page.locator("h2").count() >= 18);
        assert.ok(await page.locator("svg").count() >= 20);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    }
    await context.close();
    assert.match(await readFile(path.resolve(import.meta.dirname, "../dist/learn/print.en.html"), "utf8"), /<svg viewBox/);
});
