// The packed package installs without a network, and its README's examples run as they stand.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { after, test } from "node:test";
import { brotliCompressSync, constants } from "node:zlib";

const packageFolder = fileURLToPath(new URL("..", import.meta.url));
const folder = await mkdtemp(path.join(tmpdir(), "sinew-pack-"));
after(() => rm(folder, { recursive: true }));

const hasNpm = spawnSync("npm", ["--version"]).status === 0;
const npm = (...words) => execFileSync("npm", words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

test("the packed package installs offline", { skip: !hasNpm }, async () => {
    const [{ filename, files }] = JSON.parse(npm("pack", packageFolder, "--json"));
    const names = files.map((file) => file.path);
    for (const wanted of ["index.js", "index.d.ts", "sinew.wasm", "sinew-float.wasm", "sinew-threads.wasm", "sinew-export.wasm", "sinew-import.wasm", "worker.js", "catalogue.js", "README.md", "painters/webgl2.js"])
        assert.ok(names.includes(wanted), wanted);
    assert.ok(!names.some((name) => name.startsWith("test/") || name.startsWith("tools/")));
    await writeFile(path.join(folder, "package.json"), '{"type": "module"}');
    npm("install", "--offline", "--no-audit", "--no-fund", `./${filename}`);
});

test("the example of the README runs and prints what it says", { skip: !hasNpm }, async () => {
    const readme = await readFile(path.join(packageFolder, "README.md"), "utf8");
    const [, code, printed] = /```js\n(import[^]*?)```\n[^]*?```\n([^]*?)```/.exec(readme);
    assert.ok(code.trim().split("\n").length <= 10, "ten lines");
    await writeFile(path.join(folder, "example.js"), code);
    assert.equal(execFileSync("node", ["example.js"], { cwd: folder, encoding: "utf8" }), printed);
});

test("every example of the README that prints says true", async () => {
    const readme = await readFile(path.join(packageFolder, "README.md"), "utf8");
    const examples = [...readme.matchAll(/```js\n([^]*?)```/g)].map(([, code]) => code).filter((code) => code.includes("console.log"));
    assert.ok(examples.length >= 5);
    for (const code of examples) {
        const said = [];
        const own = code.replace(/ from "sinew";/, ` from ${JSON.stringify(new URL("../index.js", import.meta.url).href)};`).replaceAll("console.log", "globalThis.said");
        globalThis.said = (...words) => said.push(...words);
        await import(`data:text/javascript,${encodeURIComponent(own)}`);
        assert.ok(said.length > 0 && said.every((word) => word === true || word === 101), `${said}\n${code}`);
    }
});

// The goal of 250 KB is not met: the page tells what weighs how much. A module that gains or loses 3 % changes it there, too.
test("modules weigh what docs/measured/web.md says", async () => {
    const page = await readFile(new URL("../../../docs/measured/web.md", import.meta.url), "utf8");
    const rows = [...page.matchAll(/^\| `(sinew[\w-]*\.wasm)` \| [\d,]+ \| ([\d,]+) \|/gm)].map(([, name, bytes]) => [name, Number(bytes.replaceAll(",", ""))]);
    assert.deepEqual(rows.map(([name]) => name), ["sinew.wasm", "sinew-import.wasm"]);
    for (const [name, told] of rows) {
        const { length } = brotliCompressSync(await readFile(path.join(packageFolder, name)), { params: { [constants.BROTLI_PARAM_QUALITY]: 9 } });
        assert.ok(Math.abs(length - told) <= 0.03 * told, `${name} weighs ${length} bytes, ${told} by the page`);
    }
});
