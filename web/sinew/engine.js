import { SceneErrors, SinewError, status } from "./errors.js";
import { diagnostic, imageFile, modelFile, openOptions } from "./layout.js";
import { Memory } from "./memory.js";
import { Player } from "./player.js";
import { Simulation } from "./simulation.js";

/** The ABI of bindings/c/sinew.h that this package is written for. */
export const abi = 4;

/** An instance of the module, with a memory of its own. Worlds of float are in a second one: loadFloat in index.js. */
export class Engine {
    /** The engine whose worlds are of float, once loaded. */
    float = undefined;

    /** The workers that compute with it. */
    workers = [];

    /** @param memory the memory, unless the module has one of its own */
    constructor(instance, memory = instance.exports.memory) {
        this.exports = instance.exports;
        this.memory = memory;
        this.exports._initialize?.();
        const found = this.exports.sinew_abi?.();
        if (found !== abi) throw new Error(`the module has ABI ${found}, the package needs ${abi}: they are of different versions`);
        this.data = new Memory(this.exports, memory);
        this.abi = found;
        this.version = this.data.textAt(this.exports.sinew_version());
        this.simd = this.data.textAt(this.exports.sinew_simd());
        this.overlayNames = this.overlays().map((overlay) => overlay.name);
    }

    get bytes() {
        return this.memory.buffer.byteLength;
    }

    /** Number of threads that share the steps of large worlds. */
    get threads() {
        return 1 + this.workers.length;
    }

    /** Ends the workers. The engine must not be used any more. */
    stop() {
        this.float?.stop();
        for (const worker of this.workers) worker.terminate();
        this.workers = [];
    }

    open(scene, options = {}) {
        return this.ofPrecision((engine) => new Simulation(engine, engine.opened("sinew_world_open", scene, options)));
    }

    /** Opens what Simulation.save() gave, here or on another machine. */
    load(bytes, options = {}) {
        const precisionAt = 13; // in the header: 32 or 64 bits
        const engine = bytes[precisionAt] === 32 && this.float ? this.float : this;
        const { data } = engine;
        const handle = data.within((arena) => {
            engine.call("sinew_world_load", arena.bytes(bytes), bytes.length, optionsIn(arena, options), data.result);
            return data.uint(data.result);
        });
        return new Simulation(engine, handle);
    }

    play(scene, options = {}) {
        return this.ofPrecision((engine) => new Player(engine, engine.opened("sinew_player_create", scene, options)));
    }

    check(scene, options = {}) {
        try {
            this.ofPrecision((engine) =>
                engine.withScene(scene, options, (text, more) => engine.call("sinew_check", text, more)));
            return [];
        } catch (error) {
            if (error instanceof SceneErrors) return error.errors;
            throw error;
        }
    }

    /** Calls work(engine) with this engine, then with the one of float if the scene's precision is the other. */
    ofPrecision(work) {
        try {
            return work(this);
        } catch (error) {
            if (!this.float || !(error instanceof SceneErrors && error.isOfOtherPrecision)) throw error;
            return work(this.float);
        }
    }

    schema() { return this.describe("schema"); }
    prefabs() { return this.describe("prefabs"); }
    overlays() { return this.describe("overlays"); }
    tools() { return this.describe("tools"); }
    joints() { return this.describe("joints"); }
    actions() { return this.describe("actions"); }
    kinds(dimension) { return this.describe("kinds")[dimension]; }

    // --- calls ----------------------------------------------------------------------------------------------------

    /** Calls a function of the C face; throws if it fails. */
    call(name, ...given) {
        this.data.sizeResult();
        const result = this.exports[name](...given);
        if (result !== status.ok) this.fail(result);
    }

    /** The same, but false for status.notFound. */
    finds(name, ...given) {
        this.data.sizeResult();
        const result = this.exports[name](...given);
        if (result !== status.ok && result !== status.notFound) this.fail(result);
        return result === status.ok;
    }

    fail(result) {
        const message = this.data.textAt(this.exports.sinew_message());
        const errors = result === status.badScene ? this.diagnostics() : [];
        throw errors.length > 0 ? new SceneErrors(errors, message) : new SinewError(result, message);
    }

    describe(topic) {
        return this.data.within((arena) => {
            this.call("sinew_describe", arena.text(topic), this.data.result);
            return JSON.parse(this.data.textFrom(this.data.result));
        });
    }

    diagnostics() {
        const { data } = this;
        return Array.from({ length: this.exports.sinew_diagnostic_count() }, (_, i) => {
            this.call("sinew_diagnostic_at", i, data.result);
            const { isOverride, ...error } = data.read(diagnostic, data.result);
            return { ...error, isOverride: isOverride !== 0 };
        });
    }

    opened(name, scene, options) {
        this.withScene(scene, options, (text, more) => this.call(name, text, more, this.data.result));
        return this.data.uint(this.data.result);
    }

    /** Calls work(text, options) with the addresses of a scene's text and its sinew_open_options. */
    withScene(scene, options, work) {
        const text = typeof scene === "string" ? scene : JSON.stringify(scene);
        return this.data.within((arena) => work(arena.text(text), optionsIn(arena, options)));
    }

    overlayBits(overlays = 0) {
        if (typeof overlays === "number") return overlays;
        return overlays.reduce((bits, name) => {
            const number = this.overlayNames.indexOf(name);
            if (number < 0) throw new SinewError(status.badArgument, `no overlay is called "${name}"`);
            return bits | (1 << number);
        }, 0);
    }

    overlaysOf(bits) {
        return this.overlayNames.filter((_, i) => bits & (1 << i));
    }
}

/** Overrides as "path=value": values other than texts are JSON. */
function pairs(overrides) {
    if (Array.isArray(overrides)) return overrides;
    return Object.entries(overrides).map(([path, value]) => `${path}=${valueText(value)}`);
}

/** A value as an override states it. */
export function valueText(value) {
    return typeof value === "string" ? value : JSON.stringify(value);
}

function optionsIn(arena, { name, overrides = [], images = {}, models = {} }) {
    const texts = pairs(overrides).map((pair) => arena.text(pair));
    const sizes = Object.entries(images).map(([file, { width, height }]) => ({ name: arena.text(file), width, height }));
    const files = Object.entries(models).map(([file, text]) => ({ name: arena.text(file), text: arena.text(text) }));
    return arena.struct(openOptions, {
        name: name ?? "",
        overrides: arena.uints(texts), overrideCount: texts.length,
        images: arena.structs(imageFile, sizes), imageCount: sizes.length,
        models: arena.structs(modelFile, files), modelCount: files.length,
    });
}
