// An engine on shared memory, and the workers that compute with it.
import { Engine } from "./engine.js";
import { isNode, nodeModule } from "./platform.js";

const page = 65536; // bytes
const initialBytes = 32 * 2 ** 20, mostBytes = 2 ** 30; // as the module was linked: cmake/wasm.cmake
const stackBytes = 256 * 2 ** 10;

export async function startThreads(module, threads) {
    const memory = new WebAssembly.Memory({ initial: initialBytes / page, maximum: mostBytes / page, shared: true });
    const engine = new Engine(await WebAssembly.instantiate(module, { env: { memory } }), memory);
    const Worker = isNode ? (await nodeModule("worker_threads")).Worker : globalThis.Worker;
    const ready = [];
    for (let number = 1; number < threads; ++number) {
        const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        ready.push(once(worker));
        worker.postMessage({ module, memory, number, stack: engine.data.allocate(stackBytes) + stackBytes });
        engine.workers.push(worker);
    }
    await Promise.all(ready);
    for (const worker of engine.workers) worker.unref?.(); // Node may end while they wait
    return engine;
}

/** Waits for the first message of a worker. */
function once(worker) {
    return new Promise((resolve, reject) => {
        if (isNode) {
            worker.once("message", resolve);
            worker.once("error", reject);
        } else {
            worker.addEventListener("message", resolve, { once: true });
            worker.addEventListener("error", reject, { once: true });
        }
    });
}
