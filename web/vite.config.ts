import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { defineConfig, type Plugin } from "vite";

/** Writes sw.js: public/sw.js with the list of all files and a version that changes with any of them. */
function offline(): Plugin {
    return {
        name: "offline",
        apply: "build",
        generateBundle(_, bundle) {
            const directory = resolve(import.meta.dirname, "public");
            const hash = createHash("sha256");
            for (const file of Object.values(bundle)) hash.update(file.type === "asset" ? file.source : file.code);
            for (const name of readdirSync(directory)) hash.update(readFileSync(join(directory, name)));
            const files = [...new Set(["./", "learn/", ...readdirSync(directory), ...Object.keys(bundle)])].filter((name) => !name.endsWith(".html")).sort();
            const list = (isOfThreads: boolean): string => JSON.stringify(files.filter((name) => name.includes("-threads") === isOfThreads));
            const source = readFileSync(resolve(import.meta.dirname, "common/service_worker.js"), "utf8")
                .replace("[/* files */]", list(false))
                .replace("[/* modules of threads */]", list(true))
                .replace("/* version */", hash.digest("hex").slice(0, 16));
            this.emitFile({ type: "asset", fileName: "sw.js", source });
        },
    };
}

/** With these a page may share memory with workers; without them the site has one thread. */
const headers = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };

/** Relative addresses, so that the site opens from any static host under any path. */
export default defineConfig({
    root: import.meta.dirname,
    base: "./",
    plugins: [offline()],
    worker: { format: "es" },
    server: { headers, fs: { allow: [resolve(import.meta.dirname, "..")] } },
    preview: { headers },
    build: {
        outDir: "dist",
        emptyOutDir: true,
        target: "es2022",
        assetsInlineLimit: 0,
        chunkSizeWarningLimit: 900,
        rolldownOptions: {
            input: { playground: resolve(import.meta.dirname, "index.html"), learn: resolve(import.meta.dirname, "learn/index.html") },
        },
    },
});
