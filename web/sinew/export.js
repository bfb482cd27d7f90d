// Files of other programs, written by a module of its own: sinew-export.wasm. See bindings/c/sinew.h, "export".
import { status } from "./errors.js";
import { exportSpec } from "./layout.js";

/** Writes scenes as models and moving vectors. */
export class Exporter {
    constructor(engine) {
        this.engine = engine;
    }

    /** Steps a scene from its start; gives the files, and notes about what the format could not take. */
    async write(scene, name, { seconds, fps = 30, figures = [], error = 0, size = [0, 0], background = "", follow = "", caption = "", onProgress = () => {}, ...options } = {}) {
        const simulation = this.engine.open(scene, options);
        let handle = 0;
        try {
            handle = this.begin(name, { fps, figures, error, size, background, follow, caption });
            const isMoment = /\.(obj|ply)$/i.test(name) && !/%\d*d/.test(name);
            const frames = isMoment ? 1 : Math.max(1, Math.round((seconds ?? simulation.seconds) * fps));
            await this.addFrames(handle, simulation, { frames, fps, begin: isMoment ? seconds ?? 0 : 0, onProgress });
            return this.finish(handle);
        } finally {
            if (handle !== 0) this.engine.call("sinew_export_close", handle);
            simulation.dispose();
        }
    }

    begin(name, { fps, figures, error, size, background, follow, caption }) {
        const { data } = this.engine;
        return data.within((arena) => {
            const spec = arena.struct(exportSpec, { figureCount: figures.length, figures: arena.uints(figures.map((figure) => arena.text(figure))),
                fps, error, width: size[0], height: size[1], background, follow, caption });
            this.engine.call("sinew_export_begin", arena.text(name), spec, data.result);
            return data.uint(data.result);
        });
    }

    /** Lets the page live between frames. */
    async addFrames(handle, simulation, { frames, fps, begin, onProgress }) {
        const longest = 30; // milliseconds
        let step = 0, since = performance.now();
        for (let frame = 0; frame < frames; ++frame) {
            const due = Math.round((begin + frame / fps) * simulation.rate);
            if (due > step) simulation.step(due - step);
            step = due;
            this.engine.call("sinew_export_frame", handle, simulation.handle);
            if (performance.now() - since < longest) continue;
            onProgress((frame + 1) / frames);
            await new Promise((resolve) => setTimeout(resolve));
            since = performance.now();
        }
    }

    finish(handle) {
        const { data } = this.engine;
        this.engine.call("sinew_export_finish", handle, data.result);
        const count = data.uint(data.result), files = [], notes = [];
        for (let i = 0; i < count; ++i) {
            this.engine.call("sinew_export_file", handle, i, data.result, data.result + 4, data.result + 8);
            const [at, length] = [data.uint(data.result + 4), data.uint(data.result + 8)];
            files.push({ name: data.textFrom(data.result), bytes: data.bytes.slice(at, at + length) });
        }
        while (this.engine.exports.sinew_export_note(handle, notes.length, data.result) === status.ok)
            notes.push(data.textFrom(data.result));
        return { files, notes };
    }
}
