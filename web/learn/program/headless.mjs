// A lesson's program outside of the browser: the same words before it, called by whoever wants a picture of it.
import { readFileSync } from "node:fs";
import vm from "node:vm";

const kit = readFileSync(new URL("./kit.js", import.meta.url), "utf8");

/** Runs a program; `run(steps)` returns what there is to paint and the numbers shown. */
export function programOf(text) {
    const context = vm.createContext({ Math, console });
    vm.runInContext("self = globalThis;", context);
    vm.runInContext(kit, context);
    vm.runInContext(`${text}\n;self.lessonProgram = {step: typeof step === "function" ? step : null, draw: typeof draw === "function" ? draw : null};`, context, { timeout: 5000 });
    return {
        pointer: context.lessonPointer,
        run: (steps = 0) => vm.runInContext(`lessonFrame(lessonProgram, ${steps})`, context, { timeout: 20_000 }),
    };
}
