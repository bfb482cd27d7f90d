// make_inline.mjs: writes sinew-inline.js, all of the package and the module of worlds of double in one ES module, and
// sinew-inline.global.js, the same as a script that sets `sinew`: a page may have it from a folder, without a server.
import { readFile } from "node:fs/promises";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const folder = path.resolve(import.meta.dirname, "..");

const module = {
    name: "module",
    setup(to) {
        to.onResolve({ filter: /^sinew-module$/ }, () => ({ path: path.join(folder, "sinew.wasm"), namespace: "packed" }));
        to.onLoad({ filter: /.*/, namespace: "packed" }, async ({ path: file }) => ({
            contents: gzipSync(await readFile(file), { level: 9 }).toString("base64"),
            loader: "text",
        }));
    },
};

const banner = { js: "// Sinew, MIT licence: the files of the npm package in one, made by its tools/make_inline.mjs." };
const common = { entryPoints: [path.join(folder, "inline.js")], bundle: true, minify: true, target: "es2022", plugins: [module], banner, legalComments: "none" };
await build({ ...common, format: "esm", outfile: path.join(folder, "sinew-inline.js") });
await build({ ...common, format: "iife", globalName: "sinew", outfile: path.join(folder, "sinew-inline.global.js"),
    define: { "import.meta.url": "document.baseURI" } });
