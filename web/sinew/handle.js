/** Something of the engine's that has a handle: a simulation, a player. */
export class Handle {
    constructor(engine, handle) {
        this.engine = engine;
        this.handle = handle;
        this.isClosed = false;
    }

    /** Calls a function with this handle; texts and structs are passed as addresses. */
    call(name, ...given) {
        this.engine.call(name, this.handle, ...given);
    }

    /** Calls a function that gives its result at the engine's result address, which is returned. */
    ask(name, ...given) {
        const { result } = this.engine.data;
        this.call(name, ...given, result);
        return result;
    }
}
