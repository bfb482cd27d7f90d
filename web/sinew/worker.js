// A thread of an engine: serves on the engine's memory until it is ended.
import { isNode, nodeModule } from "./platform.js";

const port = isNode ? (await nodeModule("worker_threads")).parentPort : globalThis;

function serve({ module, memory, number, stack }) {
    const { exports } = new WebAssembly.Instance(module, { env: { memory } });
    exports.__stack_pointer.value = stack & ~15;
    port.postMessage("serving");
    exports.sinew_serve(number);
}

if (isNode) port.once("message", serve);
else globalThis.onmessage = ({ data }) => serve(data);
