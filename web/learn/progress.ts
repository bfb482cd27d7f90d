/** What a reader has done, kept in this browser. */
interface Progress {
    seen: string[];
    solved: string[];
    /** Smallest value of the slider that solved a challenge. */
    best: Record<string, number>;
}

const key = "sinew.lessons";

function read(): Progress {
    try {
        return { seen: [], solved: [], best: {}, ...(JSON.parse(localStorage.getItem(key) ?? "{}") as Partial<Progress>) };
    } catch {
        return { seen: [], solved: [], best: {} };
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
