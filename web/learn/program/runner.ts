import kit from "./kit.js?raw";
import loop from "./loop.js?raw";
import type { Live } from "../lesson.js";

/** What a program wants painted, as kit.js lists it. */
export type Command = [shape: string, ...rest: unknown[]];

export interface Answer {
    commands: Command[];
    live: Live;
    reading: string;
}

/** A mistake in a text, at its line if that is known. */
export interface Problem {
    line: number; // 0: of the whole
    message: string;
}

export interface Hand {
    x: number;
    y: number;
    isDown: boolean;
}

const limit = 2000; // milliseconds that a frame of a program, or its start, may take
const limitOfWorker = 30_000; // that a worker may take to begin, on a busy machine
const linesBefore = kit.split("\n").length;

/** A program of a reader in a worker of its own, made of text; one that does not answer in time is ended. */
export class ProgramRunner {
    private readonly worker: Worker;
    private readonly lines: number;
    private timer = 0;
    private isReady = false;
    private isAsked = false;

    /** `sets` is the variable that setting() changes; one that is constant cannot be. */
    constructor(text: string, sets: string, private readonly answered: (answer: Answer) => void, private readonly failed: (problem: Problem | "too long") => void) {
        this.lines = text.split("\n").length;
        const values = new RegExp(`^let ${sets}\\b`, "m").test(text) ? `{${sets}: (value) => { ${sets} = value; }}` : "{}";
        const whole = `${kit}postMessage({isBegun: true});\n${text}\n;self.lessonProgram = {step: typeof step === "function" ? step : null, draw: typeof draw === "function" ? draw : null, values: ${values}};\n${loop}`;
        const address = URL.createObjectURL(new Blob([whole], { type: "text/javascript" }));
        this.worker = new Worker(address);
        URL.revokeObjectURL(address);
        this.worker.onmessage = ({ data }) => this.hear(data);
        this.worker.onerror = (event) => {
            event.preventDefault();
            this.fail({ line: this.lineOf(event.lineno), message: event.message.replace(/^Uncaught /, "") });
        };
        this.watch(limitOfWorker);
    }

    /** True if a frame may be asked for. */
    get isFree(): boolean {
        return this.isReady && !this.isAsked;
    }

    ask(steps: number, pointer: Hand, values: Record<string, number>): void {
        this.isAsked = true;
        this.watch(limit);
        this.worker.postMessage({ steps, pointer: { ...pointer }, values });
    }

    end(): void {
        clearTimeout(this.timer);
        this.worker.onmessage = this.worker.onerror = null;
        this.worker.terminate();
    }

    private watch(time: number): void {
        clearTimeout(this.timer);
        this.timer = window.setTimeout(() => {
            this.end();
            this.failed("too long");
        }, time);
    }

    private hear(data: Partial<Answer> & { isBegun?: true; isReady?: true; error?: string; stack?: string }): void {
        clearTimeout(this.timer);
        if (data.isBegun) return this.watch(limit);
        if (data.isReady) {
            this.isReady = true;
            return;
        }
        if (data.error !== undefined) return this.fail({ line: this.lineOfStack(data.stack ?? ""), message: data.error });
        this.isAsked = false;
        this.answered(data as Answer);
    }

    private fail(problem: Problem): void {
        this.end();
        this.failed(problem);
    }

    private lineOf(line: number): number {
        return line > linesBefore ? Math.min(line - linesBefore, this.lines) : 0;
    }

    /** The innermost line of the reader's own text. */
    private lineOfStack(stack: string): number {
        for (const [, line] of stack.matchAll(/:(\d+):\d+\)?$/gm)) {
            const own = Number(line) - linesBefore;
            if (own > 0 && own <= this.lines) return own;
        }
        return 0;
    }
}
