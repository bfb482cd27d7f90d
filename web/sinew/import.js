// Files of other programs as scenes, read by a module of its own: sinew-import.wasm. See bindings/c/sinew.h, "import".
import { SinewError, status } from "./errors.js";
import { importSpec } from "./layout.js";
import { Memory } from "./memory.js";

/** Makes scenes of drawings, models, maps and pictures. */
export class Importer {
    constructor(module) {
        this.module = module;
    }

    /** Reads a file in an instance of its own, whose memory goes with it. */
    async read(name, bytes, options = {}) {
        const reader = new Reader((await WebAssembly.instantiate(this.module, {})).exports);
        try {
            return reader.read(name, bytesOf(bytes), options);
        } catch (error) {
            if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
            throw new SinewError(status.badArgument, `${name}: it needs more memory than a page may have`);
        }
    }
}

/** One import. */
class Reader {
    constructor(exports) {
        exports._initialize?.();
        this.exports = exports;
        this.data = new Memory(exports, exports.memory);
    }

    call(name, ...given) {
        const result = this.exports[name](...given);
        if (result !== status.ok) throw new SinewError(result, this.data.textAt(this.exports.sinew_message()));
    }

    read(name, bytes, { role = "", error = 0, scale = 0, files = {} }) {
        const { data } = this;
        const handle = data.within((arena) => {
            const beside = Object.entries(files).map(([called, content]) => [called, bytesOf(content)]);
            const spec = arena.struct(importSpec, { fileCount: beside.length, fileNames: arena.uints(beside.map(([called]) => arena.text(called))),
                fileBytes: arena.uints(beside.map(([, content]) => arena.bytes(content))), fileSizes: arena.uints(beside.map(([, content]) => content.length)), role, error, scale });
            this.call("sinew_import_open", arena.text(name), arena.bytes(bytes), bytes.length, spec, data.result);
            return data.uint(data.result);
        });
        this.call("sinew_import_scene", handle, data.result);
        return { scene: data.textFrom(data.result), files: this.files(handle), notes: this.notes(handle) };
    }

    files(handle) {
        const { data } = this, files = [];
        while (this.exports.sinew_import_file(handle, files.length, data.result, data.result + 4, data.result + 8) === status.ok) {
            const [at, length] = [data.uint(data.result + 4), data.uint(data.result + 8)];
            files.push({ name: data.textFrom(data.result), bytes: data.bytes.slice(at, at + length) });
        }
        return files;
    }

    notes(handle) {
        const { data } = this, notes = [];
        while (this.exports.sinew_import_note(handle, notes.length, data.result, data.result + 4) === status.ok)
            notes.push({ place: data.textFrom(data.result), message: data.textFrom(data.result + 4) });
        return notes;
    }
}

/** Bytes of a text, a buffer or a view. */
function bytesOf(content) {
    if (typeof content === "string") return new TextEncoder().encode(content);
    if (content instanceof ArrayBuffer) return new Uint8Array(content);
    return new Uint8Array(content.buffer, content.byteOffset, content.byteLength);
}
