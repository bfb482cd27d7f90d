/** What a reader has done, kept in this browser. */
interface Progress {
    seen: string[];
    solved: string[];
    /** Smallest value of the slider that solved a challenge. */
    best: Record<string, number>;
    /** Texts of figures that the reader changed and ran. */
    texts: Record<string, string>;
}

const none = (): Progress => ({ seen: [], solved: [], best: {}, texts: {} });

const key = "sinew.lessons";

function read(): Progress {
    try {
        return { ...none(), ...(JSON.parse(localStorage.getItem(key) ?? "{}") as Partial<Progress>) };
    } catch {
        return none();
    }
}

const progress = read();

function keep(): void {
    localStorage.setItem(key, JSON.stringify(progress));
    document.dispatchEvent(new Event("progress"));
}

export const isSeen = (id: string): boolean => progress.seen.includes(id);
export const isSolved = (id: string): boolean => progress.solved.includes(id);
export const bestOf = (id: string): number | undefined => progress.best[id];

export function markSeen(id: string): void {
    if (isSeen(id)) return;
    progress.seen.push(id);
    keep();
}

/** A challenge is solved with a value of the slider; of several the smallest is kept. */
export function markSolved(id: string, value: number, isFewestBest: boolean): void {
    const best = bestOf(id);
    if (isSolved(id) && (!isFewestBest || (best !== undefined && best <= value))) return;
    if (!isSolved(id)) progress.solved.push(id);
    if (isFewestBest) progress.best[id] = value;
    keep();
}

export const keptText = (id: string): string | undefined => progress.texts[id];

/** Keeps a reader's own text of a figure; without one the figure's is back. */
export function keepText(id: string, text?: string): void {
    if (text === keptText(id)) return;
    if (text === undefined) delete progress.texts[id];
    else progress.texts[id] = text;
    keep();
}
