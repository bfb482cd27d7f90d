import type { Simulation } from "../sinew/index.js";
import type { FigureText, LessonText, Ui } from "./text/text.js";

/** A scene as its file would say it. */
export type Scene = Record<string, unknown>;

/** Numbers of a running figure, by the names that texts and challenges use. */
export type Live = Record<string, number>;

/** The slider of a figure. */
export interface Slider {
    unit?: string;
    low: number;
    high: number;
    step: number;
    value: number;
    /** Moves through tenths, ones, tens ... evenly; `low` is above 0. */
    logarithmic?: boolean;
    /** In place of the number; `choices` are those of the text. */
    words?: (value: number, choices: string[]) => string;
}

interface FigureBase {
    slider: Slider;
    /** Starts again after so many seconds, unless something is held. */
    repeats?: number;
    /** The line below the figure. */
    reading?: (live: Live, text: FigureText) => string;
    /** True while the reader's figure is what the challenge of the text asks for. */
    challenge?: (live: Live, value: number) => boolean;
    /** The challenge must hold for a while. */
    rests?: boolean;
    /** Of several solutions the one with the smaller value of the slider counts. */
    isFewestBest?: boolean;
    /** Shares of a whole, drawn as bars. */
    bars?: (live: Live) => number[];
}

/** A program of the reader's own: text that defines step(dt) and draw(). */
export interface ProgramFigure extends FigureBase {
    program: string;
    /** The number of the program that the slider sets: "let gravity = 700" goes on, "const ..." starts again. */
    sets: string;
}

/** A scene that the engine runs. */
export interface SceneFigure extends FigureBase {
    scene: (value: number, text: FigureText) => Scene;
    /** Starts again when the slider moves; else what did not change goes on. */
    restarts?: boolean;
    /** Classic and physical mode side by side. */
    split?: boolean;
    /** A knife is worth having. */
    cuts?: boolean;
    /** Numbers of the running scene; `right` is the other side of a split figure. */
    live?: (simulation: Simulation, value: number, right?: Simulation) => Live;
}

export type Figure = ProgramFigure | SceneFigure;

export const isProgram = (figure: Figure): figure is ProgramFigure => "program" in figure;

/** One page: what moves. Its words are in text/, one file a language. */
export interface Lesson {
    id: string;
    figures: [Figure, ...Figure[]];
    /** Files to take home, of the folder take_home. */
    files?: string[];
}

/** Text of a figure with the slider at a value: the program, or the scene's file. */
export const textOf = (figure: Figure, value: number, text: FigureText, print: (scene: Scene) => string): string =>
    isProgram(figure) ? withValue(withComments(figure.program, text.comments ?? {}), figure.sets, value) : print(figure.scene(value, text));

/** A program whose words in braces, {before}, are those of a language. */
export function withComments(program: string, comments: Record<string, string>): string {
    return program.replace(/(?<!\$)\{([a-z][A-Za-z0-9]*)\}/g, (whole, name: string) => comments[name] ?? whole);
}

const statement = (name: string): RegExp => new RegExp(`^((?:let|const) ${name} = )[-0-9.e+]+;`, "m");

export const withValue = (program: string, name: string, value: number): string => program.replace(statement(name), `$1${value};`);

/** True if a program, maybe edited, still states the slider's number. */
export const states = (program: string, name: string): boolean => statement(name).test(program);

/** Pixels and seconds, y down, as on a screen. */
export const pixels = { sinew: 1, units: { length: "px", time: "s", up: "-y" }, view: { size: [640, 400], center: [320, 200], height: 400 } };

/** Walls around the picture. */
export const room = { box: [[14, 14], [626, 386]], bounce: 0.5, friction: 0.4 };

/** Less than a millionth of a hundredth is nothing. */
export const percent = (share: number): string => (Math.abs(share) < 1e-8 ? "0 %" : `${(share * 100).toPrecision(Math.abs(share) >= 0.1 ? 3 : 2)} %`);

/** A text with the decimal signs of a language. */
export const inLanguage = (text: string, { decimal }: Ui): string => text.replace(/(\d)\.(?=\d)/g, `$1${decimal}`);

/** The stretch of the worst distance. */
export const stretchOf = (simulation: Simulation): Live => ({ stretch: simulation.report().stretchMax });

/** Puts numbers into a text: "{stretch} too long". */
export const filled = (text: string, numbers: Record<string, string>): string => text.replace(/\{(\w+)\}/g, (whole, name: string) => numbers[name] ?? whole);

/** The stretch in words of the text. */
export const stretchReading = (live: Live, text: FigureText): string =>
    filled(text.reading ?? "", Object.fromEntries(Object.entries(live).map(([name, value]) => [name, value < 1e-6 ? (text.choices?.[0] ?? "0 %") : percent(value)])));

export type { FigureText, LessonText, Ui };
