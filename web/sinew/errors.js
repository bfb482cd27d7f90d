/** A failed call: a closed object, an unknown name, a number out of range. */
export class SinewError extends Error {
    constructor(status, message) {
        super(message);
        this.name = "SinewError";
        this.status = status;
    }
}

/** A scene with errors, each with its place. */
export class SceneErrors extends Error {
    constructor(errors, message) {
        super(message);
        this.name = "SceneErrors";
        this.errors = errors;
    }

    /** The scene's numbers are of the precision of another module. */
    get isOfOtherPrecision() {
        return this.errors.some(({ path }) => path === "/solver/precision");
    }
}

/** Values of sinew_status in bindings/c/sinew.h. */
export const status = { ok: 0, badHandle: 1, badId: 2, badScene: 3, badArgument: 4, notFound: 5, readOnly: 6, full: 7 };
