// The packed package in the bundlers that games have, and in Deno: each makes a page, which Chromium opens.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cp, mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { visit } from "./browser.mjs";

const web = path.resolve(import.meta.dirname, "..");
const answer = "the weight hangs at -2.000";
let folder;
const run = (command, ...words) => execFileSync(command, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
const own = async (name) => import(pathToFileURL(createRequire(path.join(folder, "package.json")).resolve(name)));

before(async () => {
    folder = await mkdtemp(path.join(tmpdir(), "sinew-bundlers-"));
    await cp(path.join(import.meta.dirname, "bundlers"), folder, { recursive: true, filter: (name) => !name.includes("node_modules") });
    run("npm", "ci", "--no-audit", "--no-fund", "--loglevel=error");
    const packed = run("npm", "pack", path.join(web, "sinew"), "--silent").trim();
    run("npm", "install", "--no-save", "--no-audit", "--no-fund", "--loglevel=error", `./${packed}`);
});
after(() => rm(folder, { recursive: true, force: true }));

/** Opens a page with a script of a folder, and compares what it says. */
async function answers(made, script = "page.js", type = 'type="module"') {
    await writeFile(path.join(made, "index.html"), `<!doctype html><link rel="icon" href="data:,"><title>rope</title><body><script ${type} src="${script}"></script>`);
    const site = await visit(made);
    try {
        await site.on({}, "index.html", async (page) => {
            await page.waitForFunction(() => document.body.textContent.trim() !== "", undefined, { timeout: 60_000 });
            assert.equal((await page.textContent("body")).trim(), answer);
        });
    } finally {
        await site.end();
    }
}

test("vite: a page, and a worker", async () => {
    const { build } = await own("vite");
    for (const name of ["page", "worker_page"]) {
        const made = path.join(folder, `vite-${name}`);
        const options = { root: folder, base: "./", logLevel: "warn", worker: { format: "es" } };
        await build({ ...options, build: { outDir: made, target: "es2022", rolldownOptions: { input: path.join(folder, `${name}.js`), output: { entryFileNames: "page.js" } } } });
        await answers(made);
    }
});

test("webpack: a page, and a worker", async () => {
    const webpack = (await own("webpack")).default;
    for (const name of ["page", "worker_page"]) {
        const made = path.join(folder, `webpack-${name}`);
        const stats = await new Promise((resolve, reject) => webpack({ mode: "production", context: folder, entry: `./${name}.js`,
            output: { path: made, filename: "page.js" }, performance: { hints: false } }, (error, result) => (error ? reject(error) : resolve(result))));
        assert.ok(!stats.hasErrors(), stats.toString("errors-only"));
        await answers(made);
    }
});

test("esbuild: everything in one file", async () => {
    const { build } = await own("esbuild");
    const made = path.join(folder, "esbuild");
    await build({ absWorkingDir: folder, entryPoints: ["inline_page.js"], bundle: true, format: "esm", outfile: path.join(made, "page.js") });
    await answers(made);
});

test("esbuild: the module is a file that the loader names", async () => {
    const { build } = await own("esbuild");
    const made = path.join(folder, "esbuild-file");
    const page = (await readFile(path.join(folder, "page.js"), "utf8")).replace("load()", "load(module)").replace("\nimport", '\nimport module from "sinew/sinew.wasm";\nimport');
    await writeFile(path.join(folder, "file_page.js"), page);
    await build({ absWorkingDir: folder, entryPoints: ["file_page.js"], bundle: true, format: "esm", loader: { ".wasm": "file" }, outfile: path.join(made, "page.js") });
    await answers(made);
});

test("a script from a folder, without a server", async () => {
    const made = path.join(folder, "no-server");
    await mkdir(made);
    await cp(path.join(folder, "node_modules/sinew/sinew-inline.global.js"), path.join(made, "sinew.js"));
    const page = (await readFile(path.join(folder, "page.js"), "utf8")).replace(/import .*;/, "").replace("await load()", "await sinew.load()");
    await writeFile(path.join(made, "index.html"), `<!doctype html><title>rope</title><body><script src="sinew.js"></script><script>(async () => {${page}})();</script>`);
    const site = await visit(made);
    try {
        const page = await site.browser.newPage();
        await page.goto(pathToFileURL(path.join(made, "index.html")).href);
        await page.waitForFunction((wanted) => document.body.innerText.includes(wanted), answer, { timeout: 60_000 });
    } finally {
        await site.end();
    }
});

const program = `const engine = await load();
const simulation = engine.open({ sinew: 1, world: { gravity: [0, -9.81] } });
simulation.addFigure("rope", { length: 2, segments: 20, weight: 5 });
simulation.runUntil(10);
console.log(\`the weight hangs at \${simulation.stateOf("rope/end").position[1].toFixed(3)}\`);
`;
test("Node: one file", async () => {
    await writeFile(path.join(folder, "one_file.mjs"), `import { load } from "sinew/inline";\n${program}`);
    assert.equal(run("node", "one_file.mjs").trim(), answer);
});

test("Deno: the package, and one file", async () => {
    const deno = path.join(folder, "node_modules/.bin/deno");
    for (const name of ["sinew", "sinew/inline"]) {
        await writeFile(path.join(folder, "deno.mjs"), `import { load } from "${name}";\n${program}`);
        assert.equal(run(deno, "run", "--no-prompt", "--allow-read", "deno.mjs").trim(), answer);
    }
});
