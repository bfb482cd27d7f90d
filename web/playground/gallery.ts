import type { CatalogueScene } from "../sinew/index.js";
import { byId, el, words } from "../common/dom.js";
import { theme } from "../common/theme.js";
import { Thumbnails } from "./thumbnails.js";

const about: Record<string, string> = {
    basics: "Points, sticks and the boxes that hold them",
    ropes: "What hangs, swings and cracks",
    cloth: "What folds, flutters and tears",
    bodies: "What keeps its shape, more or less",
    characters: "What has arms and legs",
    machines: "What is built to hold or to move",
    other: "All the rest",
};

/** All scenes of the catalogue with live thumbnails and a search. */
export class Gallery {
    private readonly root = byId("gallery");
    private readonly search = el("input", { type: "search", placeholder: "search scenes", "aria-label": "Search scenes", oninput: () => this.filter() });
    private readonly none = el("p", { class: "none", hidden: true }, "nothing is called so");
    private readonly cards = new Map<HTMLElement, string>();
    private readonly thumbnails = new Thumbnails();

    constructor(scenes: CatalogueScene[]) {
        this.root.append(
            el("div", { class: "hero" },
                el("h1", {}, "Ropes, cloth, ragdolls: drag anything"),
                el("p", {}, "Pick one. Drag it, throw it, cut it, and change what it is made of. ",
                    el("a", { href: "./learn/" }, "How does it work?"))),
            el("div", { class: "search", role: "search" }, this.search),
            ...[...new Set(scenes.map((scene) => scene.category))].map((category) => this.section(category, scenes)),
            this.none);
    }

    private section(category: string, scenes: CatalogueScene[]): HTMLElement {
        const cards = scenes.filter((scene) => scene.category === category).map((scene) => this.card(scene));
        return el("section", { "aria-label": category },
            el("h2", {}, category, el("span", {}, about[category] ?? "")),
            el("div", { class: "cards" }, ...cards));
    }

    private card(scene: CatalogueScene): HTMLElement {
        const canvas = el("canvas", { "aria-hidden": "true" });
        const card = el("a", { class: "card", href: `#scene=${scene.name}`, title: scene.about.split(". ")[0] ?? "" },
            el("span", { class: "picture" }, canvas, scene.dimension === 3 && el("span", { class: "badge" }, "3D")),
            el("span", { class: "name" }, words(scene.name)));
        this.thumbnails.add(canvas, scene.name);
        for (const [event, on] of [["pointerenter", true], ["focus", true], ["pointerleave", false], ["blur", false]] as const)
            card.addEventListener(event, () => this.thumbnails.prefer(scene.name, on));
        this.cards.set(card, [scene.name, words(scene.name), scene.category, scene.about, scene.source].join(" ").toLowerCase());
        return card;
    }

    private filter(): void {
        const wanted = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
        for (const [card, text] of this.cards) card.hidden = !wanted.every((word) => text.includes(word));
        for (const section of this.root.querySelectorAll("section"))
            section.hidden = !section.querySelector(".card:not([hidden])");
        this.none.hidden = this.root.querySelector(".card:not([hidden])") !== null;
    }

    show(on: boolean): void {
        this.root.hidden = !on;
        this.thumbnails.run(on, theme());
    }
}
