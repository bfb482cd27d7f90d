const key = "sinew.reloaded", gone = "sinew:gone";
const soon = 10_000; // milliseconds: a file that is missing after a reload is missing for another reason

/** A page that was open while the site was replaced asks for files that are gone: it is loaded again, once. */
export function stayFresh(): void {
    const loadAgain = (event: Event): void => {
        const last = Number(sessionStorage.getItem(key) ?? 0);
        if (Date.now() - last < soon) return;
        event.preventDefault();
        sessionStorage.setItem(key, String(Date.now()));
        location.reload();
    };
    for (const name of ["vite:preloadError", gone]) addEventListener(name, loadAgain);
}

/** Tells the page that a file of the site is gone. */
export function tellGone(): void {
    dispatchEvent(new Event(gone, { cancelable: true }));
}

export const isGone = (answer: unknown): boolean => answer instanceof Response && (answer.status === 404 || answer.status === 410);

/** Fetches a file of the site. */
export async function fetchOwn(address: string): Promise<Response> {
    const answer = await fetch(address);
    if (answer.ok) return answer;
    if (isGone(answer)) tellGone();
    throw new Error(`${answer.url}: ${answer.status} ${answer.statusText}`);
}

/** A module that the package loads from the site. */
export async function loadOwn<Loaded>(loading: Promise<Loaded>): Promise<Loaded> {
    try {
        return await loading;
    } catch (error) {
        if (error instanceof Error && isGone(error.cause)) tellGone();
        throw error;
    }
}

/** A worker whose script is gone says no more than that it failed. */
export function watchWorker(worker: Worker): Worker {
    worker.addEventListener("error", (event) => event instanceof ErrorEvent || tellGone());
    return worker;
}
