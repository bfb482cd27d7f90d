// A server of the built site, and Chromium to visit it with.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { createServer } from "node:http";
import os from "node:os";
import path from "node:path";
import { chromium } from "playwright-core";

const dist = path.resolve(import.meta.dirname, "../dist");
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".png": "image/png", ".svg": "image/svg+xml", ".woff2": "font/woff2", ".webmanifest": "application/manifest+json" };
const flags = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export const desktop = { viewport: { width: 1280, height: 800 } };
export const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 };

/** Serves a folder below a path of its own, as a host of many sites would. A folder without index.html gets an empty page. */
async function serve(root, headers) {
    const base = "/some/where/", sent = [];
    const server = createServer(async (request, response) => {
        const { pathname } = new URL(request.url, "http://host");
        const name = pathname.endsWith("/") ? `${pathname}index.html` : pathname;
        try {
            assert.ok(name.startsWith(base));
            const file = path.join(root, path.normalize(name.slice(base.length)));
            const isCompressed = /\bbr\b/.test(request.headers["accept-encoding"] ?? "") && existsSync(`${file}.br`);
            const body = pathname === base && !existsSync(file) ? "<!doctype html><link rel=icon href=data:,>" : await readFile(isCompressed ? `${file}.br` : file);
            const type = types[path.extname(name)] ?? "application/octet-stream";
            sent.push({ name, bytes: body.length });
            response.writeHead(200, { "content-type": type, ...(isCompressed ? { "content-encoding": "br" } : {}), ...headers }).end(body);
        } catch {
            response.writeHead(404).end();
        }
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    return { address: `http://127.0.0.1:${server.address().port}${base}`, sent, close: () => { server.closeAllConnections(); server.close(); } };
}

/** A browser and a server for the tests of a file: `using` closes neither, so end it in `after`. */
export async function visit(root = dist, headers = {}) {
    const folder = await mkdtemp(path.join(os.tmpdir(), "sinew-"));
    const [server, browser] = await Promise.all([serve(root, headers), chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: flags })]);
    return {
        address: server.address,
        server,
        browser,
        folder,
        /** Runs `work` on a page, which may neither complain nor ask another host for anything; `script` runs in it first. */
        async on({ script = () => {}, ...options }, where, work) {
            const context = await browser.newContext({ colorScheme: "light", acceptDownloads: true, ...options });
            await context.addInitScript(script);
            const page = await context.newPage();
            const complaints = [];
            page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(`${message.type()}: ${message.text()}`));
            page.on("pageerror", (error) => complaints.push(String(error)));
            page.on("request", (request) => /^(blob|data):/.test(request.url()) || request.url().startsWith(server.address) || complaints.push(`asks for ${request.url()}`));
            try {
                await page.goto(server.address + where);
                await work(page);
                assert.deepEqual(complaints, []);
            } finally {
                await context.close();
            }
        },
        async end() {
            await browser.close();
            server.close();
            await rm(folder, { recursive: true, force: true });
        },
    };
}

/** Waits until the player of a page runs a scene. */
export async function playing(page) {
    await page.waitForFunction(() => window.sinew?.stage?.player.state().step > 3, null, { timeout: 60_000 });
}

/** Waits until every figure of a lesson runs. */
export async function moving(page) {
    await page.waitForFunction(() => window.sinew?.views?.length > 0 && window.sinew.views.every((view) => view.state.steps > 3), null, { timeout: 60_000 });
}

/** Pixel of a particle on the page. */
export function pixelOf(page, name) {
    return page.evaluate((particle) => {
        const { stage } = window.sinew, { simulation } = stage.player;
        const box = stage.canvas.getBoundingClientRect();
        const [x, y] = simulation.toPixel(simulation.stateOf(particle).position, stage.canvas.width, stage.canvas.height);
        const density = stage.canvas.width / box.width;
        return [box.left + x / density, box.top + y / density];
    }, name);
}
