import type { Scene } from "./lesson.js";

const usual = 84; // characters of a line

/** A scene as people write it: short things on one line, of at most `widest` characters where that is possible. */
export function sceneText(scene: Scene, widest = usual): string {
    return written(scene, "", widest, widest);
}

/** `taken`: characters of the line before the value. */
function written(value: unknown, indent: string, widest: number, taken = indent.length): string {
    const short = oneLine(value);
    if (taken + short.length < widest || typeof value !== "object" || value === null) return short;
    if (Array.isArray(value) && value.length === 1) return `[${written(value[0], indent, widest, taken)}]`;
    const deeper = `${indent}  `;
    const parts = Array.isArray(value)
        ? value.map((item) => written(item, deeper, widest))
        : Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${written(item, deeper, widest, deeper.length + key.length + 4)}`);
    const [open, close] = Array.isArray(value) ? ["[", "]"] : ["{", "}"];
    return parts.length === 0 ? open + close : `${open}\n${packed(parts, deeper, widest)}\n${indent}${close}`;
}

/** Short neighbours share a line. */
function packed(parts: string[], indent: string, widest: number): string {
    const lines: string[] = [];
    for (const part of parts) {
        const last = lines.at(-1);
        const fits = last !== undefined && !last.includes("\n") && !part.includes("\n") && indent.length + last.length + part.length + 3 <= widest;
        if (fits) lines[lines.length - 1] = `${last}, ${part}`;
        else lines.push(part);
    }
    return lines.map((line) => indent + line).join(",\n");
}

function oneLine(value: unknown): string {
    if (Array.isArray(value)) return `[${value.map(oneLine).join(", ")}]`;
    if (typeof value === "object" && value !== null) return `{${Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${oneLine(item)}`).join(", ")}}`;
    return JSON.stringify(value);
}

/** Lines of a text, with a mark on those that differ from another text. */
export function markedLines(text: string, other: string): { line: string; isMarked: boolean }[] {
    const others = new Set(other.split("\n"));
    return text.split("\n").map((line) => ({ line, isMarked: !others.has(line) }));
}
