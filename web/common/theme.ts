export type Theme = "light" | "dark";
const key = "sinew.theme";

function chosen(): Theme | undefined {
    const kept = localStorage.getItem(key);
    return kept === "light" || kept === "dark" ? kept : undefined;
}

/** The theme the user chose, else that of the system. */
export function theme(): Theme {
    return chosen() ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

/** The theme of a scene, for a player: its own, "", on a page that is light because nobody chose. A web at night is dark there, as in the gallery. */
export function themeOfScene(): Theme | "" {
    return chosen() ?? (theme() === "dark" ? "dark" : "");
}

export function setTheme(value: Theme): void {
    localStorage.setItem(key, value);
    applyTheme();
}

export function applyTheme(): void {
    document.documentElement.dataset.theme = theme();
    document.querySelector('meta[name="theme-color"]')?.setAttribute("content", theme() === "dark" ? "#20242f" : "#fdfaf3");
}
