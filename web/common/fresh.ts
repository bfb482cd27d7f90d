const key = "sinew.reloaded";
const soon = 10_000; // milliseconds: a chunk that is missing after a reload is missing for another reason

/** A page that was open while the site was replaced asks for chunks that are gone: it is loaded again, once. */
export function stayFresh(): void {
    addEventListener("vite:preloadError", (event) => {
        const last = Number(sessionStorage.getItem(key) ?? 0);
        if (Date.now() - last < soon) return;
        event.preventDefault();
        sessionStorage.setItem(key, String(Date.now()));
        location.reload();
    });
}
