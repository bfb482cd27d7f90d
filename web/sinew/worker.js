// A thread of an engine: serves on the engine's memory until it is ended. No top-level await: bundlers make a classic worker of it.
import { isNode, nodeModule } from "./platform.js";

function serve(port, { module, memory, number, stack }) {
    const { exports } = new WebAssembly.Instance(module, { env: { memory } });
    exports.__stack_pointer.value = stack & ~15;
    port.postMessage("serving");
    exports.sinew_serve(number);
}

if (isNode) void nodeModule("worker_threads").then(({ parentPort }) => parentPort.once("message", (message) => serve(parentPort, message)));
else globalThis.onmessage = ({ data }) => serve(globalThis, data);
