import { asksForMore, provide, type Loaded } from "../common/engine.js";
import { Stage } from "../common/stage.js";
import { theme } from "../common/theme.js";
import { SceneErrors } from "../sinew/index.js";
import type { Live, ProgramFigure, SceneFigure } from "./lesson.js";
import { ProgramStage } from "./program/program_stage.js";
import type { Problem } from "./program/runner.js";

/** What runs in a figure: a program or a scene. */
export interface Run {
    onframe: () => void;
    onproblems: (problems: (Problem | "too long")[]) => void;
    /** Starts from the beginning of a text. */
    open(text: string): void;
    /** Goes on as a text whose slider has another value. */
    become(text: string, value: number): void;
    restart(): void;
    pause(on: boolean): void;
    standStill(steps: number): void;
    setTool(name: string): void;
    setTheme(): void;
    dispose(): void;
    readonly isPaused: boolean;
    readonly isHolding: boolean;
    readonly steps: number;
    readonly seconds: number;
    readonly live: Live;
    readonly hash: string;
}

export class ProgramRun implements Run {
    private readonly stage: ProgramStage;
    private text = "";
    onframe = (): void => {};
    onproblems: Run["onproblems"] = () => {};

    constructor(canvas: HTMLCanvasElement, private readonly figure: ProgramFigure) {
        this.stage = new ProgramStage(canvas);
        this.stage.onframe = () => this.onframe();
        this.stage.onproblem = (problem) => this.onproblems(problem ? [problem] : []);
    }

    open(text: string): void {
        this.text = text;
        this.stage.run(text, this.figure.sets);
    }

    become(text: string, value: number): void {
        const { sets } = this.figure;
        const goesOn = new RegExp(`^let ${sets}\\b`, "m").test(text) && this.text !== "";
        if (goesOn) this.stage.set(sets, value);
        else this.open(text);
    }

    restart(): void { this.stage.restart(); }
    pause(on: boolean): void { this.stage.pause(on); }
    setTool(): void {}
    setTheme(): void { this.stage.paint(); }
    dispose(): void { this.stage.dispose(); }

    standStill(steps: number): void {
        this.stage.pause(true);
        this.stage.restart();
        this.stage.step(steps - 1);
    }

    get isPaused(): boolean { return this.stage.isPaused; }
    get isHolding(): boolean { return this.stage.isHolding; }
    get steps(): number { return this.stage.steps; }
    get seconds(): number { return this.stage.steps / 60; }
    get live(): Live { return this.stage.live; }
    get hash(): string { return ""; }
}

export class SceneRun implements Run {
    stage: Stage | null = null;
    onframe = (): void => {};
    onproblems: Run["onproblems"] = () => {};
    private value: number;
    private isProvided = false;

    constructor(private readonly canvas: HTMLCanvasElement, private readonly figure: SceneFigure, private readonly loaded: Loaded) {
        this.value = figure.slider.value;
    }

    open(text: string): void {
        if (asksForMore(text) && !this.isProvided) {
            void provide(this.loaded, text).then(() => {
                this.isProvided = true;
                this.open(text);
            });
            return;
        }
        this.tried(() => {
            if (this.stage) this.stage.show(text);
            else this.stage = Stage.open(this.canvas, this.loaded.engine, this.loaded.assets, text, {}, false);
            const { player } = this.stage;
            player.setTheme(theme());
            if (this.figure.split && player.state().panes < 2) player.do("split");
            this.stage.onframe = () => this.onframe();
            this.stage.wake();
        });
    }

    become(text: string, value: number): void {
        this.value = value;
        const { stage } = this;
        if (!stage) return;
        this.tried(() => {
            stage.become(text);
            if (this.figure.restarts) stage.player.restart();
            stage.wake();
        });
    }

    private tried(work: () => void): void {
        try {
            work();
            this.onproblems([]);
            this.onframe(); // a figure out of sight has no frames
        } catch (error) {
            if (!(error instanceof SceneErrors)) throw error;
            this.onproblems(error.errors.map(({ line, message, help }) => ({ line, message: help ? `${message}; ${help}` : message })));
        }
    }

    restart(): void {
        this.stage?.player.restart();
        this.stage?.wake();
    }

    pause(on: boolean): void {
        this.stage?.player.pause(on);
        this.stage?.wake();
    }

    standStill(steps: number): void {
        this.pause(true);
        this.restart();
        for (let i = 0; i < steps; ++i) this.stage?.player.step();
    }

    setTool(name: string): void { this.stage?.player.setTool(name); }

    setTheme(): void {
        this.stage?.player.setTheme(theme());
        this.stage?.wake();
    }

    dispose(): void {
        this.stage?.dispose();
        this.stage = null;
    }

    get isPaused(): boolean { return this.stage?.player.state().isPaused ?? true; }
    get isHolding(): boolean { return this.stage?.player.state().isHolding ?? false; }
    get steps(): number { return this.stage?.player.state().step ?? 0; }
    get seconds(): number { return this.stage?.player.simulation.report().seconds ?? 0; }
    get hash(): string { return this.stage?.player.hash() ?? ""; }

    get live(): Live {
        const { stage, figure } = this;
        if (!stage || !figure.live) return {};
        return figure.live(stage.player.simulation, this.value, figure.split ? stage.player.pane(1) : undefined);
    }
}
