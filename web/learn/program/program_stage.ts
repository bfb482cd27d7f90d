import { Pointer, type Hands } from "../../common/pointer.js";
import type { Live } from "../lesson.js";
import { paint, size } from "./paint.js";
import { ProgramRunner, type Command, type Problem } from "./runner.js";

const rate = 60;      // steps a second
const mostSteps = 6;  // in a frame: a slow page falls behind instead of halting
const mostDense = 2;  // device pixels per CSS pixel that are worth painting

/** A canvas on which a reader's program runs: the loop of frames, the size, the pointer. */
export class ProgramStage implements Hands {
    readonly pointer: Pointer;
    onframe: () => void = () => {};
    onproblem: (problem: Problem | "too long" | null) => void = () => {};
    live: Live = {};
    said = "";
    steps = 0;
    isPaused = false;
    private runner: ProgramRunner | null = null;
    private text = "";
    private sets = "";
    private readonly hand = { x: 320, y: 200, isDown: false };
    private finger: number | null = null;
    private values: Record<string, number> = {};
    private commands: Command[] = [];
    private request = 0;
    private last = 0;
    private due = 0;
    private isVisible = true;
    private readonly pen: CanvasRenderingContext2D;
    private readonly observers: (ResizeObserver | IntersectionObserver)[];

    constructor(private readonly canvas: HTMLCanvasElement) {
        this.pen = canvas.getContext("2d")!;
        this.pointer = new Pointer(canvas, () => this, () => this.wake(), false);
        this.observers = [new ResizeObserver(() => this.resize()), new IntersectionObserver((entries) => {
            this.isVisible = entries.at(-1)?.isIntersecting ?? true;
            this.wake();
        })];
        for (const observer of this.observers) observer.observe(canvas);
        this.resize();
    }

    /** Starts a program from its beginning. */
    run(text: string, sets: string): void {
        this.runner?.end();
        [this.text, this.sets, this.steps, this.due, this.values] = [text, sets, 0, 1 / rate, {}];
        this.onproblem(null);
        this.runner = new ProgramRunner(text, sets, (answer) => {
            ({ commands: this.commands, live: this.live, reading: this.said } = answer);
            this.paint();
            this.onframe();
        }, (problem) => {
            this.runner = null;
            this.onproblem(problem);
        });
        this.wake();
    }

    restart(): void {
        this.run(this.text, this.sets);
    }

    /** Sets a variable of the running program. */
    set(name: string, value: number): void {
        this.values[name] = value;
        this.wake();
    }

    pause(on: boolean): void {
        this.isPaused = on;
        this.wake();
    }

    /** Takes steps while it is paused. */
    step(count: number): void {
        this.due += count / rate;
        this.wake();
    }

    get isHolding(): boolean {
        return this.hand.isDown;
    }

    wake(): void {
        if (this.request || !this.runner) return;
        this.last = performance.now();
        this.request = requestAnimationFrame(this.frame);
    }

    dispose(): void {
        cancelAnimationFrame(this.request);
        this.runner?.end();
        this.runner = null;
        for (const observer of this.observers) observer.disconnect();
    }

    private readonly frame = (now: number): void => {
        this.request = 0;
        if (!this.runner || (!this.isVisible && this.steps > 0)) return; // the first step is taken unseen: it may have an error
        if (!this.isPaused) this.due = Math.min(this.due + Math.max(now - this.last, 0) / 1000, mostSteps / rate);
        this.last = now;
        const steps = Math.min(Math.floor(this.due * rate + 1e-9), mostSteps);
        if (this.runner.isFree && (steps > 0 || !this.isPaused)) {
            this.due -= steps / rate;
            this.steps += steps;
            this.runner.ask(steps, this.hand, this.values);
        }
        this.request = requestAnimationFrame(this.frame);
    };

    private resize(): void {
        const density = Math.min(devicePixelRatio || 1, mostDense);
        const [width, height] = [Math.max(Math.round(this.canvas.clientWidth * density), 1), Math.max(Math.round(this.canvas.clientHeight * density), 1)];
        if (this.canvas.width !== width || this.canvas.height !== height) [this.canvas.width, this.canvas.height] = [width, height];
        this.paint();
    }

    paint(): void {
        const style = getComputedStyle(document.documentElement);
        const color = (name: string): string => style.getPropertyValue(name).trim();
        paint(this.pen, this.commands, { text: color("--text"), line: color("--line"), background: color("--picture") });
        if (!this.pointer.cross) return;
        const { x, y, pressed } = this.pointer.cross, scale = size.width / Math.max(this.canvas.clientWidth, 1);
        this.pen.strokeStyle = color("--accent");
        this.pen.lineWidth = 2;
        this.pen.beginPath();
        this.pen.arc(x * scale, y * scale, pressed ? 8 : 12, 0, 7);
        this.pen.stroke();
    }

    // --- hands ------------------------------------------------------------------------------------------------------

    pointerMove(x: number, y: number): void {
        const scale = size.width / Math.max(this.canvas.width, 1);
        [this.hand.x, this.hand.y] = [x * scale, y * scale];
    }
    pointerDown(): void { this.hand.isDown = true; }
    pointerUp(): void { this.hand.isDown = false; }
    pointerLeave(): void {}
    wheel(): void {}
    zoom(): void {}

    touch(finger: number, phase: "down" | "move" | "up", x: number, y: number): void {
        if (phase === "down") this.finger ??= finger;
        if (finger !== this.finger) return;
        this.pointerMove(x, y);
        this.hand.isDown = phase !== "up";
        if (phase === "up") this.finger = null;
    }
}
