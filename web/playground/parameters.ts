import type { SceneParameter } from "../sinew/index.js";
import { el, number, words } from "../common/dom.js";

export type SetParameter = (path: string, value: unknown, goesOn: boolean) => void;

/** Values of the scene as sliders, grouped by what they belong to: world, solver, figures. */
export class ParameterForm {
    readonly root = el("div", { class: "parameters" });
    private shown = "";
    private figures: string[] = [];
    private readonly all = el("input", { type: "checkbox", id: "all-parameters", onchange: () => this.again() });

    constructor(private readonly set: SetParameter, private readonly again: () => void) {}

    /** Shows the values that the scene states, or all; builds the form again only where there are others than shown, and
     * never under a hand. `figures`: names by number. */
    show(everything: SceneParameter[], stated: (path: string) => boolean, figures: string[]): void {
        this.figures = figures;
        const parameters = this.all.checked ? everything : everything.filter(({ path }) => stated(path));
        const now = JSON.stringify(parameters);
        if (now === this.shown || this.root.matches(":active, :focus-within") && this.sameFields(now)) return;
        this.shown = now;
        const groups = new Map<string, SceneParameter[]>();
        for (const one of parameters) {
            const group = this.groupOf(one.path);
            groups.set(group, [...(groups.get(group) ?? []), one]);
        }
        this.root.replaceChildren(...[...groups].map(([name, fields]) =>
            el("fieldset", {}, el("legend", {}, words(name)), ...fields.map((one) => this.field(one)))),
            el("label", { class: "all", for: this.all.id }, this.all, "values that the scene leaves out, too"));
    }

    private sameFields(now: string): boolean {
        const paths = (json: string): string => json === "" ? "" : (JSON.parse(json) as SceneParameter[]).map((one) => one.path).join();
        return paths(now) === paths(this.shown);
    }

    /** "figures.0.height" belongs to bob, "world.gravity" to the world. */
    private groupOf(path: string): string {
        const [first = "", second = ""] = path.split(".");
        return first === "figures" ? this.figures[Number(second)] ?? second : first;
    }

    private field(parameter: SceneParameter): HTMLElement {
        const { unit, help, type } = parameter;
        const label = el("span", { class: "label", title: help }, labelOf(parameter), unit && el("small", {}, unit));
        return el("div", { class: `field ${type}` }, label, this.control(parameter));
    }

    private control(parameter: SceneParameter): HTMLElement {
        const { path, value, type, choices, help } = parameter, name = labelOf(parameter);
        const tip = { title: help, "aria-label": `${words(this.groupOf(path))} ${name}` };
        if (type === "truth") {
            const box = el("input", { ...tip, type: "checkbox", onchange: () => this.set(path, box.checked, false) });
            box.checked = value === true;
            return box;
        }
        if (type === "text" && choices) {
            const list = el("select", { ...tip, onchange: () => this.set(path, list.value, false) },
                ...choices.map((choice) => el("option", { value: choice, selected: choice === value }, choice)));
            return list;
        }
        if (type === "point" && Array.isArray(value)) {
            const now = [...value];
            return el("div", { class: "point" }, ...now.map((one, i) => this.slider({ ...parameter, value: one }, `${name} ${"xyz"[i]}`, Math.max(...now.map(Math.abs)),
                (next, goesOn) => {
                    now[i] = next;
                    this.set(path, [...now], goesOn);
                })));
        }
        if (typeof value === "number") return this.slider(parameter, name, Math.abs(value), (next, goesOn) => this.set(path, next, goesOn));
        const text = el("input", { ...tip, type: "text", value: String(value), onchange: () => this.set(path, text.value, false) });
        return text;
    }

    /** A slider and the same number as text. */
    private slider(parameter: SceneParameter, name: string, size: number, set: (value: number, goesOn: boolean) => void): HTMLElement {
        const [low, high] = rangeOf(parameter, size);
        const whole = parameter.type === "integer";
        const step = whole ? 1 : niceStep((high - low) / 200);
        const label = `${words(this.groupOf(parameter.path))} ${name}`;
        const range = el("input", { type: "range", min: low, max: high, step, value: parameter.value as number, "aria-label": label, title: parameter.help });
        const text = el("input", { type: "number", step: "any", value: number(parameter.value as number), "aria-label": `${label}, exact`, min: parameter.low, max: parameter.high });
        const shade = (): void => range.style.setProperty("--share", `${(100 * (Number(range.value) - low)) / (high - low)}%`);
        let isMoving = false;
        range.addEventListener("input", () => {
            text.value = number(Number(range.value));
            shade();
            set(Number(range.value), isMoving);
            isMoving = true;
        });
        range.addEventListener("change", () => (isMoving = false));
        text.addEventListener("change", () => {
            const next = Number(text.value);
            if (text.value === "" || !Number.isFinite(next)) return;
            range.value = String(next);
            shade();
            set(whole ? Math.round(next) : next, false);
        });
        shade();
        return el("span", { class: "slider" }, range, text);
    }
}

/** "contact figures" of "figures.bob.contact.figures": the name, and the section of the group that it is in. */
function labelOf({ path, name }: SceneParameter): string {
    const [first, ...rest] = path.split("."), sections = rest.slice(first === "figures" ? 1 : 0, -1).filter((one) => !/^\d+$/.test(one));
    return words([...sections, name].join(" "));
}

/** Ends of a slider: the declared range where it is narrow, else around the value of `size`. */
function rangeOf({ low, high, type, value }: SceneParameter, size: number): [number, number] {
    const declared: [number, number] = [low ?? -Infinity, high ?? Infinity];
    const width = declared[1] - declared[0];
    const isNarrow = width > 0 && width <= 1000 && (size === 0 ? width <= 200 : width <= 20 * size);
    if (isNarrow) return declared;
    const reach = size > 0 ? roundUp(size * 3) : type === "integer" ? 64 : 1;
    const isSigned = type === "point" || (typeof value === "number" && value < 0);
    return [Math.max(declared[0], isSigned ? -reach : 0), Math.min(declared[1], reach)];
}

const roundUp = (value: number): number => {
    const ten = 10 ** Math.floor(Math.log10(value));
    return Math.ceil(value / ten) * ten;
};
const niceStep = (value: number): number => 10 ** Math.floor(Math.log10(value));
