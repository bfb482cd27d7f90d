import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { extname, join, resolve } from "node:path";
import { promisify } from "node:util";
import { brotliCompress, constants } from "node:zlib";
import { createServer, defineConfig, type Plugin } from "vite";
import { picture } from "./learn/program/picture.mjs";

/** Modules of the site, loaded in Node. */
async function loaded<Module>(path: string): Promise<Module> {
    const server = await createServer({ root: import.meta.dirname, configFile: false, logLevel: "error", server: { middlewareMode: true, ws: false }, optimizeDeps: { noDiscovery: true } });
    try {
        return (await server.ssrLoadModule(path)) as Module;
    } finally {
        await server.close();
    }
}

/** Pages of the lessons that need no program: all of them on one page, and the files to take home, in each language. */
async function staticPages(): Promise<[address: string, content: string][]> {
    const { texts, printed, files } = await loaded<typeof import("./learn/print.js")>("/learn/print.ts");
    const draw = await picture();
    return Object.keys(texts).flatMap((language) => [[`learn/print.${language}.html`, printed(language, draw)], ...files(language)] as [string, string][]);
}

function lessonPages(): Plugin {
    return {
        name: "lesson-pages",
        async generateBundle() {
            if (this.environment.name !== "client") return;
            for (const [fileName, source] of await staticPages()) this.emitFile({ type: "asset", fileName, source });
        },
        configureServer(server) {
            server.middlewares.use((request, response, next) => {
                const address = (request.url ?? "").replace(/^\/|\?.*$/g, "");
                if (!/^(take_home\/|learn\/print\.)/.test(address)) return next();
                void staticPages().then((pages) => {
                    const found = pages.find(([name]) => name === address);
                    if (found) response.setHeader("content-type", "text/html").end(found[1]);
                    else next();
                });
            });
        },
    };
}

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
            const files = [...new Set(["./", "learn/", "rollback/", ...readdirSync(directory), ...Object.keys(bundle)])].filter((name) => !name.endsWith("index.html")).sort();
            const isForLater = (name: string): boolean => /sinew-(float|export|import)[^/]*\.wasm$/.test(name);
            const list = (isOfThreads: boolean): string => JSON.stringify(files.filter((name) => !isForLater(name) && name.includes("-threads") === isOfThreads));
            const source = readFileSync(resolve(import.meta.dirname, "common/service_worker.js"), "utf8")
                .replace("[/* files */]", list(false))
                .replace("[/* modules of threads */]", list(true))
                .replace("/* version */", hash.digest("hex").slice(0, 16));
            this.emitFile({ type: "asset", fileName: "sw.js", source });
        },
    };
}

const types: Record<string, string> = { ".html": "text/html", ".js": "text/javascript", ".json": "application/json", ".obj": "text/plain", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".webmanifest": "application/manifest+json" };

/** Writes beside every file of text or code the same under Brotli, for hosts that serve such; kept by content, as it takes a while. */
function compressed(): Plugin {
    const output = resolve(import.meta.dirname, "dist"), kept = resolve(import.meta.dirname, "node_modules/.cache/brotli");
    const compress = promisify(brotliCompress);
    return {
        name: "compressed",
        apply: "build",
        async closeBundle() {
            mkdirSync(kept, { recursive: true });
            const names = (readdirSync(output, { recursive: true }) as string[]).filter((name) => extname(name) in types);
            await Promise.all(names.map(async (name) => {
                const bytes = readFileSync(join(output, name)), copy = join(kept, createHash("sha256").update(bytes).digest("hex"));
                if (!existsSync(copy)) writeFileSync(copy, await compress(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }));
                writeFileSync(join(output, `${name}.br`), readFileSync(copy));
            }));
        },
        configurePreviewServer(server) {
            server.middlewares.use((request, response, next) => {
                const address = (request.url ?? "/").replace(/[?#].*$/, ""), name = join(output, address.endsWith("/") ? `${address}index.html` : address);
                const accepts = /\bbr\b/.test(String(request.headers["accept-encoding"] ?? ""));
                if (!accepts || !name.startsWith(output) || !existsSync(`${name}.br`) || !statSync(`${name}.br`).isFile()) return next();
                response.writeHead(200, { "content-type": types[extname(name)]!, "content-encoding": "br", vary: "accept-encoding", ...headers }).end(readFileSync(`${name}.br`));
            });
        },
    };
}

/** With these a page may share memory with workers; without them the site has one thread. */
const headers = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };

/** Relative addresses, so that the site opens from any static host under any path. */
export default defineConfig({
    root: import.meta.dirname,
    base: "./",
    plugins: [lessonPages(), offline(), compressed()],
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
            input: { playground: resolve(import.meta.dirname, "index.html"), learn: resolve(import.meta.dirname, "learn/index.html"), rollback: resolve(import.meta.dirname, "rollback/index.html") },
        },
    },
});
