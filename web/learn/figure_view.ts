import { writeAddress } from "../common/address.js";
import { el, number } from "../common/dom.js";
import type { Loaded } from "../common/engine.js";
import { icon } from "../common/icons.js";
import { CodeBox } from "./code_box.js";
import { filled, inLanguage, isProgram, states, textOf, withValue, type Figure, type Live, type Slider, type Ui } from "./lesson.js";
import { bestOf, isSolved, keepText, keptText, markSolved } from "./progress.js";
import { ProgramRun, SceneRun, type Run } from "./runs.js";
import { sceneText } from "./scene_text.js";
import type { FigureText } from "./text/text.js";
import { html, react } from "./words.js";

const readingEvery = 120;    // milliseconds
const letterWidth = 7.85;    // pixels of a letter of code
const narrowest = 40;        // letters of a line
const gutter = 40;           // pixels of the numbers of lines
const heldFor = 2000;        // milliseconds that a figure must stay as a challenge of rest wants it

/** A live figure with its slider, its reading, its challenge, and the text that makes it, to be changed. */
export class FigureView {
    readonly canvas: HTMLCanvasElement;
    private readonly range: HTMLInputElement;
    private readonly value = el("output", {});
    private readonly reading = el("p", { class: "reading", "aria-live": "off" });
    private readonly bars: HTMLElement[];
    private readonly pause: HTMLButtonElement;
    private readonly challenge: HTMLElement | null;
    private readonly box: CodeBox;
    readonly root: HTMLElement;
    private run: Run | null = null;
    private readAt = 0;
    private fulfilledSince = 0;
    private isAwaited = false;
    private columns = 84;

    constructor(private readonly id: string, private readonly figure: Figure, private readonly text: FigureText, private readonly ui: Ui, private readonly terms: Record<string, string>, title: string, private readonly loaded: Loaded | null) {
        const { slider } = figure, isScene = !isProgram(figure);
        this.canvas = el("canvas", { tabindex: 0, role: "application", "aria-label": filled(ui.figure, { title }) });
        this.range = el("input", { type: "range", id: `slider-${id}`, class: "slider", ...ends(slider), value: shown(slider, slider.value), oninput: () => this.changed() });
        this.pause = el("button", { type: "button", class: "quiet", onclick: () => this.togglePause() });
        this.bars = (text.bars ?? []).map(() => el("i"));
        this.challenge = text.challenge ? el("p", { class: "challenge" }) : null;
        this.box = new CodeBox(isScene ? "json" : "javascript", ui, (edited) => this.begun(edited), () => this.undone());
        this.root = el("figure", { class: "live" },
            el("div", { class: "canvas" }, this.canvas),
            el("div", { class: "controls" },
                el("label", { for: `slider-${id}` }, text.slider), this.range, this.value,
                isScene && figure.cuts && this.knife(),
                el("button", { type: "button", class: "quiet", "aria-label": ui.restart, title: ui.restart, onclick: () => this.run?.restart() }, icon("restart")),
                this.pause),
            this.bars.length > 0 && el("div", { class: "bars" }, ...this.bars.map((bar, i) => el("div", {}, el("span", {}, text.bars![i]!), el("div", { class: "bar" }, bar)))),
            text.reading !== undefined && this.reading,
            el("figcaption", {}, el("b", {}, `${ui.try} `), spoken(text.task, terms)),
            this.challenge, this.box.root);
        this.showPause(false);
        this.showChallenge();
        this.showText();
    }

    begin(): void {
        const { figure } = this;
        this.columns = Math.max(Math.floor((this.root.clientWidth - 32 - gutter) / letterWidth), narrowest);
        this.showText();
        this.run = isProgram(figure) ? new ProgramRun(this.canvas, figure) : new SceneRun(this.canvas, figure, this.loaded!);
        this.run.onframe = () => this.afterFrame();
        this.run.onproblems = (problems) => {
            if (problems.length > 0) this.isAwaited = false;
            this.box.tell(problems.map((problem) => (problem === "too long" ? { line: 0, message: this.ui.tooLong } : problem)));
        };
        const kept = keptText(this.id);
        if (kept !== undefined && kept !== this.box.text) this.box.take(kept);
        this.start(this.box.text);
        this.box.begin();
    }

    end(): void {
        this.box.end();
        this.run?.dispose();
        this.run = null;
    }

    setTheme(): void {
        this.run?.setTheme();
    }

    /** For the console and the tests: what runs, its text, its numbers. */
    get state(): { steps: number; live: Live; text: string; isPaused: boolean } {
        return { steps: this.run?.steps ?? 0, live: this.run?.live ?? {}, text: this.box.text, isPaused: this.run?.isPaused ?? true };
    }
    get player(): unknown {
        return this.run instanceof SceneRun ? this.run.stage?.player : undefined;
    }
    /** Stands still after so many steps from the start. */
    standStill(steps: number): void {
        this.run?.standStill(steps);
        this.showPause(true);
    }

    private get current(): number {
        return meant(this.figure.slider, Number(this.range.value));
    }

    private own(value: number): string {
        return textOf(this.figure, value, this.text, (scene) => sceneText(scene, this.columns));
    }

    private begun(text: string): void {
        keepText(this.id, this.box.isEdited ? text : undefined);
        this.startInSight(text);
    }

    private undone(): void {
        keepText(this.id);
        this.startInSight(this.own(this.current));
    }

    /** Starts a text that the reader wants to see running: the figure comes into sight once it does. */
    private startInSight(text: string): void {
        this.isAwaited = true;
        this.readAt = 0;
        this.start(text);
    }

    private start(text: string): void {
        this.fulfilledSince = 0;
        this.range.disabled = this.box.isEdited && !(isProgram(this.figure) && states(text, this.figure.sets));
        this.run?.open(text);
        this.linkTo(text);
    }

    private changed(): void {
        const { figure, run, current } = this;
        this.fulfilledSince = 0;
        if (this.box.isEdited && isProgram(figure)) {
            this.showValue();
            run?.become(withValue(this.box.text, figure.sets, current), current);
            return;
        }
        this.showText();
        run?.become(this.box.text, current);
    }

    private showText(): void {
        const { slider } = this.figure, elsewhere = this.current === slider.high ? slider.low : slider.high;
        const text = this.own(this.current);
        this.box.show(text, this.own(elsewhere));
        this.linkTo(text);
        this.showValue();
    }

    private showValue(): void {
        const { slider } = this.figure, { current } = this;
        this.value.textContent = inLanguage(slider.words ? slider.words(current, this.text.choices ?? []) : `${number(current)}${slider.unit === "°" ? "°" : slider.unit ? ` ${slider.unit}` : ""}`, this.ui);
        this.range.setAttribute("aria-valuetext", this.value.textContent);
        const { min, max, value } = this.range;
        this.range.style.setProperty("--share", `${(100 * (Number(value) - Number(min))) / (Number(max) - Number(min))}%`);
    }

    private linkTo(text: string): void {
        if (!isProgram(this.figure)) void writeAddress({ text, pairs: [] }).then((fragment) => (this.box.link.href = `../${fragment}`));
    }

    private afterFrame(): void {
        const { run, figure, text } = this, now = performance.now();
        if (!run || now - this.readAt < readingEvery) return;
        this.readAt = now;
        if (this.isAwaited) this.canvas.scrollIntoView({ block: "nearest", behavior: "smooth" });
        this.isAwaited = false;
        const { live } = run;
        if (text.reading !== undefined) this.reading.textContent = inLanguage(filled(figure.reading?.(live, text) ?? "", { hash: run.hash }), this.ui);
        figure.bars?.(live).forEach((share, i) => this.bars[i]?.style.setProperty("width", `${100 * Math.min(Math.max(share, 0), 1)}%`));
        react(document, live, this.ui);
        this.judge(live, now);
        if (figure.repeats && run.seconds > figure.repeats && !run.isHolding && !run.isPaused) run.restart();
    }

    private judge(live: Live, now: number): void {
        const { figure } = this;
        if (!this.challenge || !figure.challenge) return;
        if (!figure.challenge(live, this.current)) this.fulfilledSince = 0;
        else if (this.fulfilledSince === 0) this.fulfilledSince = now;
        const wanted = figure.rests ? heldFor : 0;
        if (this.fulfilledSince === 0 || now - this.fulfilledSince < wanted) return;
        markSolved(this.id, this.current, figure.isFewestBest ?? false);
        this.showChallenge();
    }

    private showChallenge(): void {
        if (!this.challenge) return;
        const { ui, id } = this, best = bestOf(id), solved = isSolved(id);
        this.challenge.classList.toggle("solved", solved);
        this.challenge.replaceChildren(el("b", {}, `${solved ? "✓" : "☐"} ${ui.challenge}`), " ", spoken(this.text.challenge!, this.terms), " ",
            solved ? el("em", {}, best === undefined ? ui.solved : `${ui.solved}, ${filled(ui.best, { value: number(best) })}`) : "");
    }

    private knife(): HTMLElement {
        const button = el("button", { type: "button", class: "quiet", "aria-label": this.ui.knife, title: this.ui.knife, "aria-pressed": "false", onclick: () => {
            const cuts = button.getAttribute("aria-pressed") === "false";
            button.setAttribute("aria-pressed", String(cuts));
            this.run?.setTool(cuts ? "cut" : "grab");
        } }, icon("cut"));
        return button;
    }

    private togglePause(): void {
        if (!this.run) return;
        this.run.pause(!this.run.isPaused);
        this.showPause(this.run.isPaused);
    }

    private showPause(paused: boolean): void {
        const word = paused ? this.ui.goOn : this.ui.pause;
        this.pause.replaceChildren(icon(paused ? "play" : "pause"));
        this.pause.title = word;
        this.pause.setAttribute("aria-label", word);
    }
}

/** A text of a lesson's own HTML. */
function spoken(words: string, terms: Record<string, string>): HTMLElement {
    const text = el("span");
    text.innerHTML = html(words, terms);
    return text;
}

/** A logarithmic slider moves through exponents. */
const shown = ({ logarithmic }: Slider, value: number): number => (logarithmic ? Math.log10(value) : value);

function meant({ logarithmic, step, low, high }: Slider, position: number): number {
    if (!logarithmic) return Number(position.toFixed(6));
    const twoDigits = Number((10 ** position).toPrecision(2));
    return Math.min(Math.max(Number((Math.round(twoDigits / step) * step).toFixed(6)), low), high);
}

function ends(slider: Slider): { min: number; max: number; step: number } {
    const [min, max] = [shown(slider, slider.low), shown(slider, slider.high)];
    return { min, max, step: slider.logarithmic ? (max - min) / 400 : slider.step };
}
