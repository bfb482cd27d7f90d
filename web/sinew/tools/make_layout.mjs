// make_layout.mjs [--check]: writes web/sinew/layout.js, the structs of bindings/c/sinew.h as wasm32 lays them out, and
// bindings/wasm/layout.cpp, which asks the compiler whether they are laid out so. --check: fails if one is out of date.
import { readFile, writeFile } from "node:fs/promises";
import path from "node:path";

const root = path.resolve(import.meta.dirname, "../../..");
const header = (await readFile(path.join(root, "bindings/c/sinew.h"), "utf8")).replace(/\/\*[^]*?\*\//g, "").replace(/^#.*$/gm, "");

/** Bytes and alignment of a type on wasm32; a text and an address are pointers. */
const sizes = { double: 8, id: 8, float: 4, uint: 4, text: 4, address: 4 };
const scalars = { double: "double", float: "float", uint32_t: "uint", size_t: "uint", uint64_t: "id" };
for (const [, of, name] of header.matchAll(/typedef (uint\w+) (sinew_\w+);/g)) scalars[name] = scalars[of];

const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const structs = new Map();

/** Name, kind and number of the members of a declaration: "uint32_t width, height", "float color[4]". */
function members(declaration) {
    if (/\(\s*\*\s*(\w+)\s*\)/.test(declaration)) return [[/\(\s*\*\s*(\w+)\s*\)/.exec(declaration)[1], "address", 1]];
    const isAddress = declaration.includes("*");
    const [, type, names] = /^(?:const )?(\w+)([^]*)$/.exec(declaration.trim());
    const kind = isAddress ? (/^const char\s*\*\s*\w+$/.test(declaration.trim()) ? "text" : "address") : scalars[type] ?? type;
    if (!isAddress && !(kind in sizes) && !structs.has(kind)) throw new Error(`no layout of ${type}: ${declaration.trim()}`);
    return names.split(",").map((name) => {
        const [, own, count = "1"] = /(\w+)\s*(?:\[(\d+)\])?\s*$/.exec(name.replace(/\bconst\b/, ""));
        return [own, kind, Number(count)];
    });
}

for (const [, body, name] of header.matchAll(/typedef struct \w+ \{([^}]*)\} (sinew_\w+);/g)) {
    let size = 0, most = 1;
    const fields = body.split(";").filter((part) => part.trim()).flatMap(members).map(([field, kind, count]) => {
        const known = structs.get(kind), bytes = known?.size ?? sizes[kind], alignment = known?.most ?? bytes;
        const at = Math.ceil(size / alignment) * alignment;
        size = at + bytes * count;
        most = Math.max(most, alignment);
        return { field, kind, count, at };
    });
    structs.set(name, { size: Math.ceil(size / most) * most, most, fields });
}

const short = (name) => camel(name.replace(/^sinew_/, ""));
const kindText = (kind) => (structs.has(kind) ? short(kind) : JSON.stringify(kind));
/** Handles are numbers. */
const isHandle = ({ fields }) => fields.length === 1 && fields[0].field === "id";
const lines = [...structs].filter(([, struct]) => !isHandle(struct)).map(([name, { size, fields }]) => {
    const list = fields.map(({ field, kind, count, at }) => `["${camel(field)}", ${at}, ${kindText(kind)}${count > 1 ? `, ${count}` : ""}]`);
    return `export const ${short(name)} = { size: ${size}, fields: [${list.join(", ")}] };\n`;
});
const script = "// Structs of bindings/c/sinew.h as wasm32 lays them out: name, offset, kind, number. By tools/make_layout.mjs.\n" + lines.join("");

const checks = [...structs].flatMap(([name, { size, fields }]) => [`static_assert(sizeof(${name}) == ${size});\n`,
    ...fields.map(({ field, at }) => `static_assert(offsetof(${name}, ${field}) == ${at});\n`)]);
const source = `#include "bindings/c/sinew.h"

#include <cstddef>

/// Layout of the structs that web/sinew/layout.js reads and writes. By web/sinew/tools/make_layout.mjs.
${checks.join("")}`;

for (const [file, text] of [["web/sinew/layout.js", script], ["bindings/wasm/layout.cpp", source]]) {
    const target = path.join(root, file);
    if (!process.argv.includes("--check")) await writeFile(target, text);
    else if ((await readFile(target, "utf8").catch(() => "")) !== text) {
        console.error(`${file} is not that of sinew.h: run node web/sinew/tools/make_layout.mjs`);
        process.exitCode = 1;
    }
}
