/** Attributes by name; `on...` are listeners, true is an empty attribute, false and undefined leave it out. */
export type Attributes = Record<string, string | number | boolean | undefined | ((event: never) => void)>;
export type Child = Node | string | null | undefined | false;

export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
        else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : String(value));
    }
    for (const child of children) if (child) element.append(child);
    return element;
}

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
    const found = document.getElementById(id);
    if (!found) throw new Error(`no element #${id}`);
    return found as T;
}

/** "wrecking_ball" in words. */
export const words = (name: string): string => name.replaceAll("_", " ");

/** Four digits that matter, without trailing zeros. */
export function number(value: number): string {
    if (value === 0 || !Number.isFinite(value)) return String(value);
    const size = Math.abs(value);
    return size >= 1e6 || size < 1e-4 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
}

/** Calls `action` once, `milliseconds` after the last call. */
export function debounced(milliseconds: number, action: () => void): () => void {
    let timer = 0;
    return () => {
        clearTimeout(timer);
        timer = window.setTimeout(action, milliseconds);
    };
}

const readingTime = 70; // milliseconds a letter

/** Shows a line over the page for four seconds, a long one until it can be read; screen readers say it. */
export function announce(text: string): void {
    const line = byId("message");
    line.textContent = text;
    line.classList.toggle("shown", text !== "");
    clearTimeout(Number(line.dataset.timer));
    line.dataset.timer = String(window.setTimeout(() => line.classList.remove("shown"), Math.max(4000, readingTime * text.length)));
}
