import type { Engine, PlayerState, SceneParameter } from "../sinew/index.js";
import { announce, byId, debounced, el, number, words } from "../common/dom.js";
import { icon } from "../common/icons.js";
import type { Stage } from "../common/stage.js";
import { setTheme, theme } from "../common/theme.js";
import { Graphs } from "./graphs.js";
import { ParameterForm } from "./parameters.js";
import { segments, type Segments } from "./segments.js";
import { TextTab } from "./text_tab.js";

const tabs = { parameters: "numbers of the world, the solver and every figure", text: "the scene as text", statistics: "counts, energies and stretch" };
type Tab = keyof typeof tabs;

export interface PanelActions {
    setMode(mode: string): void;
    themeChanged(): void;
    changed(): void;
    /** The text was edited to a scene without errors. */
    textChanged(text: string): void;
}

/** The panel at the right: title, mode, parameters, overlays, text, statistics. */
export class Panel {
    private readonly root = byId("side");
    private readonly title = el("h1", {});
    private readonly about = el("p", { class: "about", onclick: () => this.about.classList.toggle("whole") });
    private readonly mode: Segments;
    private readonly look: Segments;
    private readonly pages = {} as Record<Tab, HTMLElement>;
    private readonly heads = {} as Record<Tab, HTMLButtonElement>;
    private readonly form: ParameterForm;
    private readonly prefab = el("div", { class: "prefab", hidden: true });
    private prefabDimension = 0;
    private tool = "";
    private readonly joint: HTMLElement;
    private readonly chosen: HTMLElement;
    private readonly overlays = new Map<string, HTMLButtonElement>();
    private readonly facts = el("dl", { class: "facts" });
    private readonly graphs = new Graphs();
    readonly text: TextTab;
    private said: SceneWords = { name: "", about: "", source: "" };
    private saidMode = "";
    private tab: Tab = "parameters";

    constructor(private readonly engine: Engine, private readonly stage: Stage, private readonly actions: PanelActions) {
        this.mode = segments("Mode", [
            { value: "physical", word: "physical", tip: "as it should be: nothing stretches, energy is kept" },
            { value: "classic", word: "classic", tip: "as the original demo behaved, with its faults" },
            { value: "both", word: "both", tip: "classic and physical side by side, from the start" }], actions.setMode);
        this.look = segments("Theme", [
            { value: "light", word: "light", tip: "dark on light" },
            { value: "dark", word: "dark", tip: "light on dark" }], (value) => (setTheme(value === "dark" ? "dark" : "light"), actions.themeChanged()));
        this.form = new ParameterForm((path, value, goesOn) => this.setParameter(path, value, goesOn), () => actions.changed());
        this.text = new TextTab(engine, stage, actions.textChanged);
        this.joint = this.jointChoice();
        this.chosen = this.chosenDeeds();
        this.pages.parameters = el("div", {}, this.prefab, this.joint, this.chosen, this.overlayChips(), this.form.root);
        this.pages.text = this.text.root;
        this.pages.statistics = el("div", { tabindex: 0 }, this.facts, this.graphs.energy.root, this.graphs.stretch.root);
        this.root.append(
            el("button", { class: "quiet close", type: "button", "aria-label": "Close the panel", onclick: () => this.open(false) }, icon("close")),
            el("div", { class: "head" }, this.title, this.about, el("div", { class: "switches" }, this.mode.root, this.look.root)),
            this.tabList(), ...Object.values(this.pages));
        this.choose("parameters");
    }

    private tabList(): HTMLElement {
        const list = el("div", { class: "tabs", role: "tablist", "aria-label": "Panel" });
        for (const [name, tip] of Object.entries(tabs) as [Tab, string][]) {
            const head = el("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `page-${name}`, title: tip, onclick: () => this.choose(name) }, name);
            this.heads[name] = head;
            list.append(head);
            const page = this.pages[name];
            page.id = `page-${name}`;
            page.classList.add("page");
            page.setAttribute("role", "tabpanel");
            page.setAttribute("aria-labelledby", head.id);
        }
        list.addEventListener("keydown", (event) => {
            const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
            const names = Object.keys(tabs) as Tab[];
            if (!by) return;
            const next = names[(names.indexOf(this.tab) + by + names.length) % names.length]!;
            this.choose(next);
            this.heads[next].focus();
            event.stopPropagation();
        });
        return list;
    }

    choose(tab: Tab): void {
        this.tab = tab;
        for (const name of Object.keys(tabs) as Tab[]) {
            this.pages[name].hidden = name !== tab;
            this.heads[name].setAttribute("aria-selected", String(name === tab));
            this.heads[name].tabIndex = name === tab ? 0 : -1;
        }
        this.root.classList.toggle("wide", tab === "text");
        if (tab === "text") void this.text.open();
        this.stage.wake();
    }

    private overlayChips(): HTMLElement {
        const chips = el("div", { class: "chips", role: "group", "aria-label": "Overlays" });
        this.engine.overlays().forEach(({ name, about }, i) => {
            const chip = el("button", { type: "button", "aria-pressed": "false", title: `${about}  (${i + 1})`, onclick: () => {
                const shown = new Set(this.stage.player.state().overlays);
                if (!shown.delete(name)) shown.add(name);
                this.stage.player.setOverlays([...shown]);
                this.actions.changed();
            } }, name);
            this.overlays.set(name, chip);
            chips.append(chip);
        });
        return chips;
    }

    private readonly settled = debounced(250, () => this.actions.changed());

    private setParameter(path: string, value: unknown, goesOn: boolean): void {
        try {
            this.stage.player.set(path, value, goesOn);
            this.problem("");
        } catch (error) {
            this.problem(error instanceof Error ? error.message : String(error));
        }
        this.stage.wake();
        this.settled();
    }

    private problem(message: string): void {
        this.pages.parameters.querySelector(".problem")?.remove();
        if (message) this.pages.parameters.prepend(el("p", { class: "problem", role: "alert" }, message));
    }

    /** What another scene says of itself; `show` tells what belongs to the mode. */
    introduce({ name, about, source }: SceneWords): void {
        this.title.textContent = words(name).replace(/^./, capital);
        this.said = { name, about, source };
        this.saidMode = "";
        this.graphs.clear();
        this.graphs.paint();
        this.problem("");
    }

    show(state: PlayerState, mode: string): void {
        const shown = state.panes > 1 ? "both" : mode;
        this.mode.choose(shown);
        this.say(shown);
        this.look.choose(theme());
        for (const [name, chip] of this.overlays) chip.setAttribute("aria-pressed", String(state.overlays.includes(name)));
        this.prefab.hidden = state.tool !== "spawn";
        this.joint.hidden = state.tool !== "join";
        this.chosen.hidden = state.tool !== "select";
        if (state.tool === "spawn") this.fillPrefab();
        if (state.tool !== this.tool) this.pointToChoices(state.tool);
        this.tool = state.tool;
    }

    /** Tells where the choices of a tool are, if they are out of sight: the panel is a drawer, or shows another page. */
    private pointToChoices(tool: string): void {
        const [choices, hint] = { spawn: [this.prefab, "Press where the figure shall be; the panel has other figures."], join: [this.joint, "Draw from one part to another; the panel has the kinds of joints."] }[tool] ?? [];
        if (choices instanceof HTMLElement && !choices.checkVisibility({ visibilityProperty: true })) announce(String(hint));
    }

    private say(mode: string): void {
        if (mode === this.saidMode) return;
        this.saidMode = mode;
        const { about, source } = this.said, [physical = "", classic = ""] = about.split(/ ?Classic: /);
        const own = mode === "both" ? about : mode === "classic" && classic ? classic.replace(/^./, capital) : physical;
        this.about.replaceChildren(own, source ? el("small", {}, source) : "");
    }

    showParameters(parameters: SceneParameter[]): void {
        const document = readable(this.stage.player.sceneText());
        const figures = (document.figures ?? []).map(({ name, prefab }, i) => name ?? prefab ?? String(i));
        this.form.show(parameters, (path) => states(document, path.split(".")), figures);
    }

    /** Choice of what the spawn tool puts in: what exists in the scene's dimension. */
    private fillPrefab(): void {
        const { dimension } = this.stage.player.simulation;
        if (this.prefabDimension === dimension) return;
        this.prefabDimension = dimension;
        const about = el("small", { class: "faint" });
        const all = this.engine.prefabs().filter(({ dimensions }) => dimensions.includes(dimension));
        const before = this.prefab.querySelector("select")?.value, chosen = all.some(({ name }) => name === before) ? before : "box";
        const list = el("select", { id: "prefab", onchange: () => choose() }, ...all.map(({ name }) => el("option", { value: name, selected: name === chosen }, words(name))));
        const choose = (): void => {
            this.stage.player.setPrefab(list.value);
            about.textContent = all.find(({ name }) => name === list.value)?.about ?? "";
        };
        this.prefab.replaceChildren(el("label", { for: "prefab" }, "prefab "), list, about);
        choose();
    }

    /** Choice of the joint that the tool join makes. */
    private jointChoice(): HTMLElement {
        const about = el("small", { class: "faint" });
        const all = this.engine.joints();
        const choose = (name: string): void => {
            this.stage.player.setJoint(name);
            kinds.choose(name);
            about.textContent = all.find((joint) => joint.name === name)?.about ?? "";
        };
        const kinds = segments("Joint", all.map(({ name, about: tip }) => ({ value: name, word: name, tip })), choose);
        choose(all[0]!.name);
        return el("div", { class: "prefab joint", hidden: true }, kinds.root, about);
    }

    /** Deeds with the figures that the tool select has chosen. */
    private chosenDeeds(): HTMLElement {
        const { actions, stage } = this;
        const deed = (word: string, tip: string, act: () => void): HTMLElement => el("button", { type: "button", title: tip, onclick: () => (act(), actions.changed()) }, word);
        return el("div", { class: "deeds", role: "group", "aria-label": "Chosen figures", hidden: true },
            deed("choose all", "every figure and obstacle  (ctrl+a)", () => stage.player.do("choose_all")),
            deed("copy", "copies lie beside what is chosen  (ctrl+d)", () => stage.player.do("duplicate")),
            deed("delete", "what is chosen  (delete)", () => stage.player.key("delete")));
    }

    /** Called each frame. */
    sample(now: number): void {
        const report = this.graphs.sample(this.stage.player.simulation, now);
        if (!report || this.tab !== "statistics" || this.root.offsetParent === null) return;
        this.graphs.paint();
        const { simulation } = this.stage.player, state = this.stage.player.state();
        this.fact("particles", number(simulation.particleCount));
        this.fact("constraints", number(simulation.constraintCount));
        this.fact("stretch", `${number(report.stretchMax * 100)} %`);
        this.fact("fastest", number(report.maxSpeed));
        this.fact("pointer", state.hovered || state.selected || "–");
        this.fact("frame", `${this.stage.workTime.toFixed(1)} ms of work, ${(1000 / Math.max(this.stage.frameTime, 1)).toFixed(0)} a second`);
        this.fact("hash", simulation.hash(), "one number over the whole state: equal on every machine");
    }

    private readonly values = new Map<string, HTMLElement>();
    private fact(name: string, value: string, help = ""): void {
        let shown = this.values.get(name);
        if (!shown) {
            shown = el("dd", name === "hash" ? { class: "fixed" } : {});
            this.values.set(name, shown);
            this.facts.append(el("dt", { title: help }, name), shown);
        }
        if (shown.textContent !== value) shown.textContent = value;
    }

    /** Opens or closes the drawer of a narrow page. */
    open(on = !document.body.classList.contains("drawer")): void {
        document.body.classList.toggle("drawer", on);
        if (on) this.heads[this.tab].focus();
        else document.querySelector<HTMLElement>(".menu-panel")?.focus();
        this.actions.changed();
    }
}

interface SceneWords {
    name: string;
    about: string;
    source: string;
}

const capital = (letter: string): string => letter.toUpperCase();

interface SceneDocument {
    figures?: { name?: string; prefab?: string }[];
}

function readable(text: string): SceneDocument {
    return JSON.parse(text) as SceneDocument;
}

/** True if a document has a value at a path. */
function states(document: unknown, path: string[]): boolean {
    const [first, ...rest] = path;
    if (first === undefined) return document !== undefined;
    return typeof document === "object" && document !== null && states((document as Record<string, unknown>)[first], rest);
}
