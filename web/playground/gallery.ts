import type { CatalogueScene } from "../sinew/index.js";
import { byId, el, words } from "../common/dom.js";
import { icon } from "../common/icons.js";
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

/** Shown first: what a newcomer should see. */
const best = ["ragdoll_pose", "spiderweb", "tree", "polygons", "curtain", "hammock"];

export interface GalleryActions {
    /** Opens a scene with nearly nothing in it. */
    blank(): void;
    file(): void;
}

/** All scenes of the catalogue with live thumbnails and a search. */
export class Gallery {
    private readonly root = byId("gallery");
    private readonly search = el("input", { type: "search", placeholder: "search scenes", "aria-label": "Search scenes", oninput: () => this.filter() });
    private readonly none = el("p", { class: "none", hidden: true }, "nothing is called so");
    private readonly cards = new Map<HTMLElement, { text: string; kind: string; name: string }>();
    private readonly kinds = new Map<string, HTMLButtonElement>();
    private kind = "";
    /** The element that had the focus last; the first button before. */
    private last: HTMLElement | null = null;
    private readonly thumbnails: Thumbnails;

    constructor(scenes: CatalogueScene[], module: WebAssembly.Module, { blank, file }: GalleryActions) {
        this.thumbnails = new Thumbnails(scenes, module);
        const kinds = [...new Set(scenes.map((scene) => scene.category))], first = best.flatMap((name) => scenes.find((scene) => scene.name === name) ?? []);
        const rest = scenes.filter((scene) => !first.includes(scene));
        for (const kind of ["", ...kinds]) this.kinds.set(kind, el("button", { type: "button", "aria-pressed": String(kind === ""), onclick: () => this.choose(kind) }, kind || "all"));
        this.root.addEventListener("focusin", ({ target }) => (this.last = target as HTMLElement));
        this.root.append(
            el("div", { class: "hero" },
                el("h1", {}, "Ropes, cloth, ragdolls: drag anything"),
                el("p", {}, "Pick one. Drag it, throw it, cut it, and change what it is made of. ",
                    el("a", { href: "./learn/" }, "How does it work?")),
                el("p", { class: "begin" },
                    el("button", { type: "button", onclick: blank }, icon("spawn"), "new scene"),
                    el("button", { type: "button", onclick: file }, "open a file…"))),
            el("div", { class: "search", role: "search" }, this.search, el("div", { class: "kinds", role: "group", "aria-label": "Kinds" }, ...this.kinds.values())),
            this.section("begin here", "Six to begin with", first, "cards few"),
            ...kinds.map((kind) => this.section(kind, about[kind] ?? "", rest.filter((scene) => scene.category === kind))),
            this.none);
        this.last = this.root.querySelector("button");
    }

    private section(name: string, words: string, scenes: CatalogueScene[], look = "cards"): HTMLElement {
        return el("section", { "aria-label": name }, el("h2", {}, name, el("span", {}, words)), el("div", { class: look }, ...scenes.map((scene) => this.card(scene))));
    }

    /** Shows scenes of one kind, or of all. */
    private choose(kind: string): void {
        this.kind = kind;
        for (const [own, button] of this.kinds) button.setAttribute("aria-pressed", String(own === kind));
        this.filter();
    }

    /** Puts the focus on the card of a scene; without a name, or one that is not here, on what had it last. */
    focus(name: string | undefined): void {
        const card = [...this.cards].find(([, one]) => one.name === name)?.[0];
        (card ?? this.last)?.focus();
    }

    private card(scene: CatalogueScene): HTMLElement {
        const canvas = el("canvas", { "aria-hidden": "true" });
        const card = el("a", { class: "card", href: `#scene=${scene.name}`, title: scene.about.split(". ")[0] ?? "" },
            el("span", { class: "picture" }, canvas, scene.dimension === 3 && el("span", { class: "badge" }, "3D")),
            el("span", { class: "name" }, words(scene.name)));
        this.thumbnails.add(canvas, scene.name);
        for (const [event, on] of [["pointerenter", true], ["focus", true], ["pointerleave", false], ["blur", false]] as const)
            card.addEventListener(event, () => (event !== "focus" || card.matches(":focus-visible")) && this.thumbnails.prefer(scene.name, on));
        const text = [scene.name, words(scene.name), scene.category, scene.about, scene.source].join(" ").toLowerCase();
        this.cards.set(card, { text, kind: scene.category, name: scene.name });
        return card;
    }

    private filter(): void {
        const wanted = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
        for (const [card, { text, kind }] of this.cards)
            card.hidden = !wanted.every((word) => text.includes(word)) || (this.kind !== "" && kind !== this.kind);
        for (const section of this.root.querySelectorAll("section"))
            section.hidden = !section.querySelector(".card:not([hidden])");
        this.none.hidden = this.root.querySelector(".card:not([hidden])") !== null;
    }

    show(on: boolean): void {
        this.root.hidden = !on;
        this.thumbnails.run(on, theme());
    }
}
