export type Theme = "light" | "dark";
const key = "sinew.theme";

/** The theme the user chose, else that of the system. */
export function theme(): Theme {
    const chosen = localStorage.getItem(key);
    if (chosen === "light" || chosen === "dark") return chosen;
    return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

export function setTheme(value: Theme): void {
    localStorage.setItem(key, value);
    applyTheme();
}

export function applyTheme(): void {
    document.documentElement.dataset.theme = theme();
    document.querySelector('meta[name="theme-color"]')?.setAttribute("content", theme() === "dark" ? "#20242f" : "#fdfaf3");
}
