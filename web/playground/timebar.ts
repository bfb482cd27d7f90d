import type { PlayerState } from "../sinew/index.js";
import { byId, el } from "../common/dom.js";
import { icon } from "../common/icons.js";
import type { Stage } from "../common/stage.js";
import { segments, type Segment, type Segments } from "./segments.js";
import { iconButton, rove } from "./toolbar.js";

const speeds: Segment[] = [
    { value: "0.1", word: "0.1", tip: "a tenth of the speed" },
    { value: "0.25", word: "¼", tip: "a quarter of the speed" },
    { value: "0.5", word: "½", tip: "half the speed" },
    { value: "1", word: "1", tip: "a second takes a second" },
    { value: "2", word: "2", tip: "twice the speed" }];

/** The bar below: restart, a step back, pause, a step; the last minute; the speed of time. */
export class TimeBar {
    private readonly root = byId("time");
    private readonly pause: HTMLButtonElement;
    private readonly clock = el("output", { class: "fixed clock", title: "seconds since the scene's start, minutes before the colon" }, "0:00.00");
    private readonly timeline = el("input", { type: "range", class: "timeline", min: 0, max: 1, step: 1, value: 0, "aria-label": "Step of the last minute" });
    private readonly speed: Segments;
    /** In place of all speeds on a narrow page. */
    private readonly next: HTMLButtonElement;
    private isPlaying = true;
    private isScrubbing = false;
    private timeScale = 1;

    constructor(stage: Stage, changed: () => void) {
        const act = (action: () => void) => (): void => (action(), stage.wake(), changed());
        this.pause = iconButton("pause", "pause  (p)", act(() => stage.player.pause(this.isPlaying)));
        this.pause.classList.add("on");
        this.timeline.addEventListener("input", act(() => stage.player.goTo(Number(this.timeline.value))));
        this.timeline.addEventListener("pointerdown", () => (this.isScrubbing = true));
        for (const end of ["pointerup", "pointercancel"]) this.timeline.addEventListener(end, () => (this.isScrubbing = false));
        this.speed = segments("Speed of time", speeds, (value) => act(() => stage.player.setTimeScale(Number(value)))());
        this.next = el("button", { type: "button", class: "next-speed", title: "speed of time: press for the next",
            onclick: act(() => stage.player.setTimeScale(Number(speeds[(this.speedIndex() + 1) % speeds.length]!.value))) });
        this.root.append(
            iconButton("restart", "restart  (r)", act(() => stage.player.restart())),
            iconButton("back", "one step back  (b)", act(() => stage.player.stepBack())),
            this.pause,
            iconButton("step", "one step  (o)", act(() => stage.player.step())),
            this.clock, this.timeline, this.speed.root, this.next);
        rove(this.root);
    }

    /** `seconds`: simulated, since the scene's start. */
    show(state: PlayerState, seconds: number): void {
        const playing = !state.isPaused;
        if (playing !== this.isPlaying) {
            this.isPlaying = playing;
            const tip = playing ? "pause  (p)" : "go on  (p)";
            this.pause.title = tip;
            this.pause.setAttribute("aria-label", tip);
            this.pause.replaceChildren(icon(playing ? "pause" : "play"));
        }
        this.clock.value = `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(2).padStart(5, "0")}`;
        if (!this.isScrubbing) {
            this.timeline.min = String(state.firstStep);
            this.timeline.max = String(Math.max(state.endStep, state.firstStep + 1));
            this.timeline.value = String(state.step);
        }
        const length = Math.max(state.endStep - state.firstStep, 1);
        this.timeline.style.setProperty("--share", `${(100 * (state.step - state.firstStep)) / length}%`);
        this.timeline.setAttribute("aria-valuetext", `${seconds.toFixed(2)} seconds`);
        this.timeScale = state.timeScale;
        this.speed.choose(String(state.timeScale));
        this.next.textContent = `${speeds[this.speedIndex()]?.word ?? Number(state.timeScale.toPrecision(2))}×`;
    }

    private speedIndex(): number {
        return speeds.findIndex(({ value }) => Number(value) === this.timeScale);
    }
}
