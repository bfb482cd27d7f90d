import { writeAddress } from "../common/address.js";
import { el, number } from "../common/dom.js";
import type { Loaded } from "../common/engine.js";
import { icon } from "../common/icons.js";
import { Stage } from "../common/stage.js";
import { theme } from "../common/theme.js";
import type { Lesson, Slider } from "./lesson.js";
import { essence, markedLines, sceneText } from "./scene_text.js";

const readingEvery = 120; // milliseconds
const letterWidth = 7.85; // pixels of a letter of code
const narrowest = 40;     // letters of a line

/** A live figure with its slider, its reading and the lines that make it. */
export class FigureView {
    private readonly canvas: HTMLCanvasElement;
    private readonly range: HTMLInputElement;
    private readonly value = el("output", {});
    private readonly reading = el("p", { class: "reading", "aria-live": "off" });
    private readonly code = el("code", {});
    private readonly link = el("a", { class: "button quiet" }, "open in the playground");
    private readonly pause: HTMLButtonElement;
    readonly root: HTMLElement;
    private stage: Stage | null = null;
    private readAt = 0;

    constructor(private readonly loaded: Loaded, private readonly lesson: Lesson) {
        const { figure } = lesson, { slider } = figure;
        this.canvas = el("canvas", { tabindex: 0, role: "application", "aria-label": `Figure: ${lesson.title}. Arrow keys move a pointer, Enter presses and lets go.` });
        this.range = el("input", { type: "range", id: "slider", ...ends(slider), value: shown(slider, slider.value), oninput: () => this.changed() });
        this.pause = el("button", { type: "button", class: "quiet", onclick: () => this.togglePause() });
        this.root = el("figure", { class: "live" },
            el("div", { class: "canvas" }, this.canvas),
            el("div", { class: "controls" },
                el("label", { for: "slider" }, slider.label), this.range, this.value,
                el("button", { type: "button", class: "quiet", "aria-label": "restart", title: "restart", onclick: () => (this.stage?.player.restart(), this.stage?.wake()) }, icon("restart")),
                this.pause),
            this.reading,
            el("figcaption", {}, el("b", {}, "Try: "), figure.task),
            el("details", { class: "lines", open: true }, el("summary", {}, "The lines that make it"), el("pre", { tabindex: 0, "aria-label": "Code" }, this.code), this.link));
        this.showPause(false);
        this.showLines();
    }

    begin(): void {
        const { figure } = this.lesson, { engine, assets } = this.loaded;
        this.stage = Stage.open(this.canvas, engine, assets, this.text());
        this.stage.player.setTheme(theme());
        if (figure.split) this.stage.player.do("split");
        this.stage.onframe = () => this.afterFrame();
        this.showLines(); // now that their width is known
        this.stage.wake();
    }

    end(): void {
        this.stage?.dispose();
        this.stage = null;
    }

    setTheme(): void {
        this.stage?.player.setTheme(theme());
        this.stage?.wake();
    }

    get player(): Stage["player"] | undefined {
        return this.stage?.player;
    }

    private get current(): number {
        return meant(this.lesson.figure.slider, Number(this.range.value));
    }

    private text(): string {
        return sceneText(this.lesson.figure.scene(this.current));
    }

    private changed(): void {
        this.showLines();
        const { stage } = this;
        if (!stage) return;
        stage.become(this.text());
        if (this.lesson.figure.restarts) stage.player.restart();
        stage.wake();
    }

    private showLines(): void {
        const { figure } = this.lesson, { slider } = figure, { current } = this;
        const elsewhere = current === slider.high ? slider.low : slider.high;
        const lines = (value: number): string => figure.code?.(value) ?? sceneText(essence(figure.scene(value)), this.columns);
        this.code.replaceChildren(...markedLines(lines(current), lines(elsewhere)).map(({ line, isMarked }) => el(isMarked ? "mark" : "span", {}, `${line}\n`)));
        this.value.textContent = slider.words ? slider.words(current) : `${number(current)}${slider.unit === "°" ? "°" : slider.unit ? ` ${slider.unit}` : ""}`;
        this.range.setAttribute("aria-valuetext", this.value.textContent);
        const { min, max, value } = this.range;
        this.range.style.setProperty("--share", `${(100 * (Number(value) - Number(min))) / (Number(max) - Number(min))}%`);
        void writeAddress({ text: this.text(), pairs: [] }).then((fragment) => (this.link.href = `../${fragment}`));
    }

    /** Characters that fit in a line of code. */
    private get columns(): number {
        const { clientWidth } = this.code.parentElement!;
        return Math.max(Math.floor(clientWidth / letterWidth), narrowest);
    }

    private afterFrame(): void {
        const { stage, lesson: { figure } } = this, now = performance.now();
        if (!stage || now - this.readAt < readingEvery) return;
        this.readAt = now;
        const { simulation } = stage.player;
        if (figure.reading) this.reading.textContent = figure.reading(simulation, this.current, figure.split ? stage.player.pane(1) : undefined);
        if (figure.repeats && simulation.report().seconds > figure.repeats && !stage.player.state().isHolding) stage.player.restart();
    }

    private togglePause(): void {
        if (!this.stage) return;
        const paused = !this.stage.player.state().isPaused;
        this.stage.player.pause(paused);
        this.showPause(paused);
        this.stage.wake();
    }

    private showPause(paused: boolean): void {
        const word = paused ? "go on" : "pause";
        this.pause.replaceChildren(icon(paused ? "play" : "pause"));
        this.pause.title = word;
        this.pause.setAttribute("aria-label", word);
    }
}

/** A logarithmic slider moves through exponents. */
const shown = ({ logarithmic }: Slider, value: number): number => (logarithmic ? Math.log10(value) : value);

function meant({ logarithmic, step, low, high }: Slider, position: number): number {
    if (!logarithmic) return position;
    const twoDigits = Number((10 ** position).toPrecision(2));
    return Math.min(Math.max(Number((Math.round(twoDigits / step) * step).toFixed(6)), low), high);
}

function ends(slider: Slider): { min: number; max: number; step: number } {
    const [min, max] = [shown(slider, slider.low), shown(slider, slider.high)];
    return { min, max, step: slider.logarithmic ? (max - min) / 400 : slider.step };
}
