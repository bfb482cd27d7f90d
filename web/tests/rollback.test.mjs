// The page of two worlds over a bad link: both end with the bits of a game without delay, in Node.js and as the page shows.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { byItself, Link, Peer, play, scene } from "../rollback/game.js";
import { load } from "../sinew/index.js";
import { desktop, phone, visit } from "./browser.mjs";

let site;
before(async () => (site = await visit()));
after(() => site.end());

const steps = 150;

test("two players end with the hash of a game without delay, whatever the link does", async () => {
    const engine = await load(await readFile(new URL("../sinew/sinew.wasm", import.meta.url)));
    const honest = engine.open(scene), bytes = honest.save();
    for (let step = 0; step < steps; ++step) play(honest, [byItself(0, step), byItself(1, step)]);
    for (const [loss, slowest] of [[0, 0], [1 / 3, 12], [0.8, 30]]) {
        const peers = [new Peer(engine, bytes, 0), new Peer(engine, bytes, 1)], [one, two] = peers;
        const link = Object.assign(new Link(7), { loss, slowest });
        for (let tick = 0; peers.some(({ confirmed }) => confirmed < steps); ++tick) {
            for (const peer of peers) {
                peer.receive(tick);
                if (peer.now < steps) peer.step(byItself(peer.own, peer.now));
            }
            link.carry(one, two, tick);
            link.carry(two, one, tick);
        }
        for (const peer of peers) {
            assert.equal(peer.simulation.hash(), honest.hash(), `loss ${loss}, player ${peer.own}`);
            assert.ok(peer.repeated > 0);
            peer.dispose();
        }
    }
    honest.dispose();
});

for (const [name, options] of Object.entries({ desktop, phone }))
    test(`the page shows two worlds that agree: ${name}`, () =>
        site.on(options, "rollback/", async (page) => {
            await page.waitForFunction(() => window.rollback?.compared >= 60, null, { timeout: 60_000 });
            assert.match(await page.locator("#verdict").textContent(), /^After \d+ steps both have the hash [0-9a-f]{16}\.$/);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
            await page.keyboard.press("d");
            await page.getByRole("button", { name: "Start again" }).click();
            await page.waitForFunction(() => window.rollback.compared === 0 || window.rollback.peers[0].now < 60);
        }));
