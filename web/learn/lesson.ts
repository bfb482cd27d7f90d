import type { Simulation } from "../sinew/index.js";

/** A scene as its file would say it. */
export type Scene = Record<string, unknown>;

/** The one slider of a figure. */
export interface Slider {
    label: string;
    unit?: string;
    low: number;
    high: number;
    step: number;
    value: number;
    /** Moves through tenths, ones, tens ... evenly; `low` is above 0. */
    logarithmic?: boolean;
    /** In place of the number. */
    words?: (value: number) => string;
}

/** What a lesson is about, alive. */
export interface Figure {
    scene: (value: number) => Scene;
    slider: Slider;
    /** Starts again when the slider moves; else what did not change goes on. */
    restarts?: boolean;
    /** Starts again after so many seconds, unless something is held. */
    repeats?: number;
    /** Classic and physical mode side by side. */
    split?: boolean;
    /** A line about the running scene, in words and numbers; `right` is the other side of a split figure. */
    reading?: (simulation: Simulation, value: number, right?: Simulation) => string;
    /** What to try. */
    task: string;
    /** Lines to show in place of the scene's. */
    code?: (value: number) => string;
}

/** One page. Texts are HTML, written here and nowhere else. */
export interface Lesson {
    id: string;
    title: string;
    /** Before the figure: the idea. */
    before: string[];
    figure: Figure;
    /** After it: why. */
    after: string[];
    /** Questions that readers ask, and answers. */
    questions?: [string, string][];
    source: string;
}

/** Pixels and seconds, y down, as on a screen. */
export const pixels = { sinew: 1, units: { length: "px", time: "s", up: "-y" }, view: { size: [640, 400], center: [320, 200], height: 400 } };

/** Walls around the picture. */
export const room = { box: [[14, 14], [626, 386]], bounce: 0.5, friction: 0.4 };

export const percent = (share: number): string => `${(share * 100).toPrecision(share >= 0.1 ? 3 : 2)} %`;

/** Stretch of the worst distance, in words. */
export const stretch = (simulation: Simulation): string => {
    const { stretchMax } = simulation.report();
    return `most stretched piece: ${stretchMax < 1e-6 ? "not even a millionth" : percent(stretchMax)} too long`;
};
