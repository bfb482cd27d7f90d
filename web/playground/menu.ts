import { byId, el } from "../common/dom.js";
import { icon } from "../common/icons.js";

export interface MenuItem {
    name: string;
    icon: string;
    tip: string;
    /** Shown only while a scene is open. */
    ofScene?: boolean;
    press?: () => void;
    href?: string;
    items?: { name: string; press: () => void }[];
}

/** The bar at the top. */
export class Menu {
    private readonly root = byId("menu");

    constructor(items: MenuItem[]) {
        for (const item of items) {
            const own = item.items ? this.list(item) : item.href !== undefined
                ? el("a", { class: "button quiet", href: item.href, title: item.tip, "aria-label": item.name }, icon(item.icon), el("span", {}, item.name))
                : el("button", { class: "quiet", type: "button", title: item.tip, "aria-label": item.name, onclick: item.press ?? (() => {}) }, icon(item.icon), el("span", {}, item.name));
            own.classList.toggle("of-scene", item.ofScene === true);
            own.classList.add(`menu-${item.icon}`);
            this.root.append(own);
        }
        document.addEventListener("click", (event) => {
            for (const open of this.root.querySelectorAll("details[open]"))
                if (!open.contains(event.target as Node)) open.removeAttribute("open");
        });
    }

    private list(item: MenuItem): HTMLElement {
        const details = el("details", { class: "list" },
            el("summary", { class: "button quiet", title: item.tip, "aria-label": item.name }, icon(item.icon), el("span", {}, item.name)),
            el("div", {}, ...item.items!.map(({ name, press }) => el("button", { class: "quiet", type: "button", onclick: () => {
                details.querySelector("summary")!.focus(); // else the focus is lost with the list
                details.removeAttribute("open");
                press();
            } }, name))));
        details.addEventListener("keydown", (event) => {
            if (event.key !== "Escape" || !details.open) return;
            details.removeAttribute("open");
            details.querySelector("summary")?.focus();
            event.stopPropagation();
        });
        return details;
    }
}
