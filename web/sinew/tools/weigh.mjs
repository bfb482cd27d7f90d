// weigh.mjs MODULE MAP: what each object of the module weighs, raw and by itself under Brotli. The map is the linker's:
// -Wl,-Map=FILE. Functions of one object are compressed together; the sum exceeds the module's own size a little.
import { readFile } from "node:fs/promises";
import { brotliCompressSync, constants } from "node:zlib";

const [modulePath, mapPath, quality = "9"] = process.argv.slice(2);
const bytes = await readFile(modulePath);
const map = (await readFile(mapPath, "utf8")).split("\n");

const line = /^\s*\S+\s+([0-9a-f]+)\s+([0-9a-f]+)\s{9}(\S[^:]*):/;
const parts = new Map();
for (const found of map.map((text) => line.exec(text)).filter(Boolean)) {
    const [offset, size] = [parseInt(found[1], 16), parseInt(found[2], 16)];
    const name = found[3].replace(/^.*\/(?=[^/]*$)/, "").replace(/\(.*/, "");
    const room = found[3].includes("wasm_") ? found[3].replace(/^.*?wasm_/, "").replace(/\.dir|_cxx\.cxx\.obj|\.cpp\.obj/g, "") : name;
    parts.set(room, [...(parts.get(room) ?? []), bytes.subarray(offset, offset + size)]);
}

const packed = (data) => brotliCompressSync(data, {
    params: { [constants.BROTLI_PARAM_QUALITY]: Number(quality), [constants.BROTLI_PARAM_LGWIN]: 24 },
}).length;
const rows = [...parts].map(([room, pieces]) => {
    const data = Buffer.concat(pieces);
    return { room, KB: Math.round(data.length / 1024), brotli: Math.round(packed(data) / 1024) };
});
console.table(rows.sort((a, b) => b.brotli - a.brotli).filter(({ KB }) => KB >= 5));
