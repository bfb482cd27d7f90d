/** Words of a figure. */
export interface FigureText {
    /** Label of the slider. */
    slider: string;
    /** What to try. HTML, as all longer texts: [[term]] explains a term, «mouse|touch» says it for either. */
    task: string;
    /** The line below the figure; numbers in braces. */
    reading?: string;
    /** Words of the slider or the reading. */
    choices?: string[];
    /** Labels of bars. */
    bars?: string[];
    /** Words in the program, {before}: those behind // and those that it draws. */
    comments?: Record<string, string>;
    challenge?: string;
}

/** Words of a lesson. */
export interface LessonText {
    title: string;
    /** Before the figures: the idea. */
    before: string[];
    figures: FigureText[];
    /** After them: why. */
    after: string[];
    /** Questions that readers ask, and answers. */
    questions?: [string, string][];
    /** A program to read, which the tests run, and what it is. */
    listing?: { about: string; code: string };
    source: string;
}

/** Words of the pages around the lessons. */
export interface Ui {
    title: string;
    coverTitle: string;
    lead: string;
    begin: string;
    lesson: string;       // {number} {count}
    of: string;           // After: ...
    scenes: string;
    lessons: string;
    theme: string;
    lightOrDark: string;
    otherLanguage: string;
    try: string;
    challenge: string;
    solved: string;
    best: string;         // {value}
    restart: string;
    pause: string;
    goOn: string;
    knife: string;
    run: string;
    runKey: string;
    reset: string;
    program: string;
    scene: string;
    edited: string;
    words: string;        // of a program
    line: string;         // {line}
    tooLong: string;
    openInPlayground: string;
    takeHome: string;
    takeHomeAbout: string;
    look: string;
    save: string;
    toPlayground: string;
    neighbours: string;
    figure: string;       // {title}
    code: string;
    decimal: string;      // of numbers, "." or ","
    failed: string;
    printed: string;
    fileTitles: Record<string, string>;
    fileAbouts: Record<string, string>;
    fileComments: Record<string, string>;
    glossary: string;
}

/** Everything that is said, in one language. */
export interface Text {
    language: string;
    ui: Ui;
    /** Terms and their explanations. */
    terms: Record<string, string>;
    lessons: Record<string, LessonText>;
}

const loaders: Record<string, () => Promise<Text>> = {
    en: () => import("./en.js").then(({ en }) => en),
    de: () => import("./de.js").then(({ de }) => de),
};

export const languages = Object.keys(loaders);
const key = "sinew.language";

/** The language chosen in the address, earlier, or in the browser, if it is there. */
export function language(): string {
    const wanted = [new URLSearchParams(location.search).get("language"), localStorage.getItem(key), ...navigator.languages.map((name) => name.slice(0, 2))];
    return wanted.find((name): name is string => name !== null && languages.includes(name)) ?? "en";
}

export function setLanguage(name: string): void {
    localStorage.setItem(key, name);
}

export const loadText = (name: string): Promise<Text> => loaders[name]!();
