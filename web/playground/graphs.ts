import type { Report, Simulation } from "../sinew/index.js";
import { el, number } from "../common/dom.js";

const kept = 300; // samples
const every = 66; // milliseconds between samples

interface Line {
    name: string;
    color: string; // a custom property of the style sheet
    value: (report: Report) => number;
}

/** A line for each of several values over the last samples. */
class Graph {
    readonly root: HTMLElement;
    private readonly canvas: HTMLCanvasElement;
    private readonly range = el("span", {});
    private readonly samples: number[][] = [];

    constructor(private readonly title: string, private readonly lines: Line[], private readonly unit: (high: number) => string) {
        this.canvas = el("canvas", { role: "img", "aria-label": title });
        this.root = el("figure", { class: "graph" },
            el("figcaption", {}, `${title} `, this.range,
                ...lines.map(({ name, color }) => el("span", { class: "key", style: `color: var(${color})` }, name))),
            this.canvas);
    }

    clear(): void {
        this.samples.length = 0;
    }

    add(report: Report): void {
        this.samples.push(this.lines.map((line) => line.value(report)));
        if (this.samples.length > kept) this.samples.shift();
    }

    paint(): void {
        const { canvas } = this, density = Math.min(devicePixelRatio || 1, 2);
        const width = canvas.clientWidth, height = canvas.clientHeight;
        if (width === 0) return;
        canvas.width = width * density;
        canvas.height = height * density;
        const context = canvas.getContext("2d")!;
        context.scale(density, density);
        const all = this.samples.flat().filter(Number.isFinite);
        const low = Math.min(0, ...all), high = Math.max(low + 1e-9, ...all);
        const style = getComputedStyle(canvas);
        context.lineWidth = 1.8;
        context.lineJoin = "round";
        this.lines.forEach((line, index) => {
            context.strokeStyle = style.getPropertyValue(line.color);
            context.beginPath();
            this.samples.forEach((sample, i) => {
                const x = width - (width * (this.samples.length - 1 - i)) / (kept - 1);
                context.lineTo(x, height - 4 - ((height - 8) * (sample[index]! - low)) / (high - low));
            });
            context.stroke();
        });
        this.range.textContent = `to ${this.unit(high)}`;
        const last = this.samples.at(-1);
        if (last) canvas.setAttribute("aria-label", `${this.title}: ${this.lines.map((line, i) => `${line.name} ${this.unit(last[i]!)}`).join(", ")}`);
    }
}

/** Energies and stretch over the last seconds. */
export class Graphs {
    readonly energy = new Graph("energy", [
        { name: "all", color: "--text", value: ({ kinetic, potential, stored }) => kinetic + potential + stored },
        { name: "kinetic", color: "--accent-text", value: (report) => report.kinetic },
        { name: "potential", color: "--cool", value: (report) => report.potential },
        { name: "stored", color: "--good", value: (report) => report.stored }], number);
    readonly stretch = new Graph("stretch", [
        { name: "largest", color: "--accent-text", value: (report) => report.stretchMax * 100 },
        { name: "mean", color: "--cool", value: (report) => report.stretchMean * 100 }], (high) => `${number(high)} %`);
    private sampledAt = 0;
    private step = -1;

    /** True if a new sample was taken. */
    sample(simulation: Simulation, now: number): Report | null {
        if (now - this.sampledAt < every) return null;
        this.sampledAt = now;
        const report = simulation.report();
        if (report.steps === this.step) return report;
        if (report.steps < this.step) this.clear();
        this.step = report.steps;
        this.energy.add(report);
        this.stretch.add(report);
        return report;
    }

    clear(): void {
        this.energy.clear();
        this.stretch.clear();
    }

    paint(): void {
        this.energy.paint();
        this.stretch.paint();
    }
}
