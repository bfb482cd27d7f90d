// visit.mjs [HASH]: how long a first visit of the built site takes until its scene is on the screen, and what it loads:
// a phone at 10 Mbit/s, 40 ms away, its processor slowed four times; five visits. Nothing else may run on the machine.
import { phone, visit } from "../tests/browser.mjs";

const address = process.argv[2] ?? "#scene=rope", visits = 5;
const site = await visit();
const times = [];
for (let i = 0; i < visits; ++i) {
    const context = await site.browser.newContext({ ...phone, serviceWorkers: "block" }), page = await context.newPage();
    const client = await context.newCDPSession(page);
    await client.send("Network.enable");
    await client.send("Network.emulateNetworkConditions", { offline: false, latency: 40, downloadThroughput: 10e6 / 8, uploadThroughput: 10e6 / 8 });
    await client.send("Emulation.setCPUThrottlingRate", { rate: 4 });
    await page.addInitScript(() => {
        const look = () => {
            if (window.sinew?.stage?.player.state().step > 0) window.shownAt = performance.now();
            else requestAnimationFrame(look);
        };
        requestAnimationFrame(look);
    });
    site.server.sent.length = 0;
    await page.goto(site.address + address);
    await page.waitForFunction(() => window.shownAt, null, { timeout: 60_000 });
    times.push(await page.evaluate(() => window.shownAt));
    await context.close();
}
const loaded = site.server.sent.toSorted((a, b) => b.bytes - a.bytes);
for (const { name, bytes } of loaded) console.log(`${(bytes / 1024).toFixed(1).padStart(7)} KB  ${name.replace(/.*\//, "")}`);
console.log(`${(loaded.reduce((sum, { bytes }) => sum + bytes, 0) / 1024).toFixed(0)} KB; scene on the screen after ${times.map((time) => Math.round(time)).sort((a, b) => a - b).join(", ")} ms`);
await site.end();
