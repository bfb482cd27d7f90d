// The memory of a module: texts and structs in and out, as layout.js has them. Typed arrays are made anew when the memory has grown.
import { point as pointLayout } from "./layout.js";

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** Bytes for the results of one call: the largest struct that is one has 216. */
const resultBytes = 256;

export class Memory {
    constructor(exports, memory) {
        this.exports = exports;
        this.memory = memory;
        this.result = this.allocate(resultBytes);
    }

    get buffer() {
        return this.memory.buffer;
    }

    get view() {
        if (this.cachedView?.buffer !== this.buffer) this.cachedView = new DataView(this.buffer);
        return this.cachedView;
    }

    get bytes() {
        if (this.cachedBytes?.buffer !== this.buffer) this.cachedBytes = new Uint8Array(this.buffer);
        return this.cachedBytes;
    }

    allocate(bytes) {
        const at = this.exports.sinew_allocate(bytes);
        if (at === 0) throw new RangeError(`no memory for ${bytes} bytes`);
        return at;
    }

    /** The room for a result, which begins with its size as a struct does. */
    sizeResult() { this.view.setUint32(this.result, resultBytes, true); }

    uint(at) { return this.view.getUint32(at, true); }
    float(at) { return this.view.getFloat32(at, true); }
    double(at) { return this.view.getFloat64(at, true); }
    id(at) { return this.view.getBigUint64(at, true); }

    /** A value of a kind of layout.js; a point is an array of three numbers. */
    value(kind, at) {
        switch (kind) {
        case "double": return this.double(at);
        case "float": return this.float(at);
        case "id": return this.id(at);
        case "text": return this.textFrom(at);
        case pointLayout: return [0, 8, 16].map((from) => this.double(at + from));
        default: return typeof kind === "string" ? this.uint(at) : this.read(kind, at);
        }
    }

    /** The fields of a struct but its size; several numbers are an array. */
    read(struct, at) {
        const fields = {};
        for (const [name, from, kind, count] of struct.fields)
            if (name !== "structSize") fields[name] = count === undefined ? this.value(kind, at + from) : this.values(kind, at + from, count);
        return fields;
    }

    values(kind, at, count) {
        const bytes = kind === "double" || kind === "id" ? 8 : 4;
        return Array.from({ length: count }, (_, i) => this.value(kind, at + bytes * i));
    }

    /** Writes fields of a struct; texts are addresses already. */
    write(struct, at, values) {
        for (const [name, from, kind] of struct.fields) {
            const value = values[name];
            if (value === undefined) continue;
            if (kind === "double") this.view.setFloat64(at + from, value, true);
            else if (kind === "float") this.view.setFloat32(at + from, value, true);
            else if (kind === "id") this.view.setBigUint64(at + from, value, true);
            else if (kind === pointLayout) value.forEach((number, i) => this.view.setFloat64(at + from + 8 * i, number, true));
            else this.view.setUint32(at + from, Number(value), true);
        }
    }

    /** The text at an address, up to its zero byte. */
    textAt(at) {
        const bytes = this.bytes;
        return decoder.decode(bytes.slice(at, bytes.indexOf(0, at))); // a copy: shared memory cannot be decoded
    }

    /** The text whose address is at an address; a null pointer is an empty one. */
    textFrom(at) {
        const address = this.uint(at);
        return address === 0 ? "" : this.textAt(address);
    }

    /** Calls `work` with an arena, whose memory is freed afterwards. */
    within(work) {
        const arena = new Arena(this);
        try {
            return work(arena);
        } finally {
            arena.free();
        }
    }
}

/** Arguments of one call. */
class Arena {
    constructor(memory) {
        this.memory = memory;
        this.taken = [];
    }

    allocate(bytes) {
        const at = this.memory.allocate(bytes);
        this.taken.push(at);
        return at;
    }

    text(text) {
        const bytes = encoder.encode(text);
        const at = this.allocate(bytes.length + 1);
        this.memory.bytes.set(bytes, at);
        this.memory.bytes[at + bytes.length] = 0;
        return at;
    }

    bytes(bytes) {
        const at = this.allocate(bytes.length);
        this.memory.bytes.set(bytes, at);
        return at;
    }

    doubles(numbers) {
        const at = this.allocate(8 * numbers.length);
        numbers.forEach((number, i) => this.memory.view.setFloat64(at + 8 * i, number, true));
        return at;
    }

    ids(ids) {
        const at = this.allocate(8 * ids.length);
        ids.forEach((id, i) => this.memory.view.setBigUint64(at + 8 * i, id, true));
        return at;
    }

    uints(numbers) {
        const at = this.allocate(4 * numbers.length);
        numbers.forEach((number, i) => this.memory.view.setUint32(at + 4 * i, number, true));
        return at;
    }

    /** A struct with these fields, and zeros: texts as texts, its size as its first field asks for. */
    struct(struct, values) {
        return this.structs(struct, [values]);
    }

    structs(struct, list) {
        const { size, fields } = struct, at = this.allocate(size * list.length);
        this.memory.bytes.fill(0, at, at + size * list.length);
        list.forEach((values, i) => {
            const own = { structSize: size, ...values };
            for (const [name, , kind] of fields)
                if (kind === "text" && typeof own[name] === "string") own[name] = own[name] === "" ? 0 : this.text(own[name]);
            this.memory.write(struct, at + size * i, own);
        });
        return at;
    }

    point([x, y, z = 0]) {
        return this.doubles([x, y, z]);
    }

    free() {
        for (const at of this.taken) this.memory.exports.sinew_free(at);
    }
}
