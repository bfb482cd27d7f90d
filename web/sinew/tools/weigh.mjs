// weigh.mjs MODULE MAP [QUALITY]: what each object of the module weighs, raw and by itself under Brotli. The map is the
// linker's, bin/sinew.map of the build. Functions of one object are compressed together; the sum exceeds the module's own
// size a little. An object of a unity build is called by its rooms.
import { readFile } from "node:fs/promises";
import path from "node:path";
import { brotliCompressSync, constants } from "node:zlib";

const [modulePath, mapPath, quality = "9"] = process.argv.slice(2);
const bytes = await readFile(modulePath);
const map = (await readFile(mapPath, "utf8")).split("\n");

/** Rooms of the sources of an object: of a unity build, those of its includes. */
async function roomsOf(object) {
    const [, folder, source] = /(CMakeFiles\/.*?\.dir)\/(.*)\.obj/.exec(object) ?? [];
    if (!source) return path.basename(object).replace(/\(.*/, "");
    if (!source.startsWith("Unity/")) return source;
    const text = await readFile(path.join(path.dirname(mapPath), "..", folder, source), "utf8");
    const rooms = [...text.matchAll(/#include ".*?\/((?:sinew|player|bindings|canvas|files)\/[^"]*)\/[^/"]*"/g)].map(([, room]) => room);
    return [...new Set(rooms)].join(", ");
}

const line = /^\s*\S+\s+([0-9a-f]+)\s+([0-9a-f]+)\s{9}(\S[^:]*):/;
const parts = new Map();
for (const found of map.map((text) => line.exec(text)).filter(Boolean)) {
    const [offset, size] = [parseInt(found[1], 16), parseInt(found[2], 16)];
    const room = await roomsOf(found[3]);
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
