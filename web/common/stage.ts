import { Canvas2DPainter, SceneErrors, type Engine, type OpenOptions, type Player } from "../sinew/index.js";
import { context2d, smooth } from "./context.js";
import type { Assets } from "./engine.js";
import { Pointer } from "./pointer.js";
import { themeOfScene } from "./theme.js";

const longestFrame = 0.1; // seconds; a longer pause of the browser is not made up for
const mostDense = 2; // device pixels per CSS pixel that are worth painting

/** A canvas on which a player runs: the loop of frames, the size, the pointer. */
export class Stage {
    readonly pointer: Pointer;
    readonly painter: Canvas2DPainter;
    readonly context: CanvasRenderingContext2D;
    /** Called after each frame. */
    onframe: (milliseconds: number) => void = () => {};
    /** Time from one frame to the next, milliseconds, smoothed. */
    frameTime = 16.7;
    /** Time that stepping and painting took, milliseconds, smoothed. */
    workTime = 0;

    /** How much the width of the canvas takes a 3D scene away, as a zoom. */
    private fitted = 1;
    private request = 0;
    private last = 0;
    private isStale = true;
    private isVisible = true;
    private isEnded = false;
    private readonly observers: (ResizeObserver | IntersectionObserver)[];
    private readonly onvisibility = (): void => this.wake();

    private constructor(readonly canvas: HTMLCanvasElement, readonly engine: Engine, private current: Player, readonly assets: Assets, text: string, takesWheel: boolean) {
        this.context = context2d(canvas);
        this.painter = new Canvas2DPainter(this.context, { font: "'Inter Variable', system-ui, sans-serif" });
        this.loadImages(text);
        this.pointer = new Pointer(canvas, () => this.player, () => this.wake(), takesWheel);
        this.observers = [new ResizeObserver(() => this.resize()), new IntersectionObserver((entries) => {
            this.isVisible = entries.at(-1)?.isIntersecting ?? true;
            if (this.isVisible) this.wake();
        })];
        for (const observer of this.observers) observer.observe(canvas);
        document.addEventListener("visibilitychange", this.onvisibility);
        this.resize();
    }

    /** Without `takesWheel` the wheel scrolls the page. */
    static open(canvas: HTMLCanvasElement, engine: Engine, assets: Assets, scene: string, options: OpenOptions = {}, takesWheel = true): Stage {
        const player = engine.play(scene, { ...assets.optionsOf(scene), ...options });
        return new Stage(canvas, engine, player, assets, scene, takesWheel);
    }

    /** The player of the scene that is shown: another one after a scene of the other precision. */
    get player(): Player {
        return this.current;
    }

    /** Opens another scene; throws SceneErrors and keeps the old one. */
    show(scene: string, options: OpenOptions = {}): void {
        const all = { ...this.assets.optionsOf(scene), ...options };
        this.orAnew(() => this.player.open(scene, all), scene, all);
        this.fitted = 1;
        this.loadImages(scene);
        this.resize();
    }

    /** Continues as an edited scene; throws SceneErrors. */
    become(scene: string): void {
        const options = this.assets.optionsOf(scene);
        this.orAnew(() => this.player.become(scene, options), scene, options);
        this.loadImages(scene);
        this.wake();
    }

    /** Does what gives the player a scene. The player of one precision cannot have one of the other: a new one begins with it. */
    private orAnew(give: () => void, scene: string, options: OpenOptions): void {
        try {
            give();
        } catch (error) {
            if (!(error instanceof SceneErrors) || !error.isOfOtherPrecision) throw error;
            const before = this.player, { tool, overlays } = before.state();
            this.current = this.engine.play(scene, options);
            before.dispose();
            this.player.setTheme(themeOfScene());
            this.player.setTool(tool);
            this.player.setOverlays(overlays);
            this.fitted = 1;
            this.resize();
        }
    }

    optionsOf(scene: string): OpenOptions {
        return this.assets.optionsOf(scene);
    }

    private loadImages(scene: string): void {
        void this.assets.giveTo(this.painter, scene).then(() => this.wake());
    }

    resize(): void {
        if (this.isEnded) return;
        const density = Math.min(window.devicePixelRatio || 1, mostDense);
        const width = Math.max(Math.round(this.canvas.clientWidth * density), 1);
        const height = Math.max(Math.round(this.canvas.clientHeight * density), 1);
        if (this.canvas.width !== width || this.canvas.height !== height) {
            this.canvas.width = width;
            this.canvas.height = height;
            smooth(this.context);
        }
        this.player.resize(width, height, density);
        this.fitWidth();
        this.paint();
        this.wake();
    }

    /** The camera of a 3D scene fits its height: on a narrow canvas it goes back until the width fits, too. */
    private fitWidth(): void {
        const { simulation } = this.player;
        if (simulation.dimension !== 3) return;
        const [width, height] = simulation.size;
        const wanted = Math.min((this.canvas.width * height) / (this.canvas.height * width), 1);
        if (wanted !== this.fitted) this.player.zoom(wanted / this.fitted);
        this.fitted = wanted;
    }

    /** Everything in sight again. */
    seeAll(): void {
        this.player.do("see_all");
        this.fitted = 1;
        this.resize();
    }

    /** Paints at least one more frame; call after any change. */
    wake(): void {
        this.isStale = true;
        if (this.request || this.isEnded || document.hidden || !this.isVisible) return;
        this.last = performance.now();
        this.request = requestAnimationFrame(this.frame);
    }

    /** Ends the loop and frees the player. */
    dispose(): void {
        cancelAnimationFrame(this.request);
        this.isEnded = true;
        for (const observer of this.observers) observer.disconnect();
        document.removeEventListener("visibilitychange", this.onvisibility);
        this.painter.dispose();
        this.player.dispose();
    }

    private readonly frame = (now: number): void => {
        this.request = 0;
        const elapsed = Math.max(now - this.last, 0);
        const begun = performance.now();
        this.player.advance(Math.min(elapsed / 1000, longestFrame));
        this.paint();
        this.workTime += (performance.now() - begun - this.workTime) * 0.1;
        if (elapsed > 0) this.frameTime += (elapsed - this.frameTime) * 0.1;
        this.last = now;
        this.isStale = false;
        this.onframe(elapsed);
        const goesOn = this.isStale || !this.player.state().isPaused;
        if (goesOn && !document.hidden && this.isVisible && !this.request) this.request = requestAnimationFrame(this.frame);
    };

    paint(): void {
        this.painter.paint(this.player.draw());
        if (this.pointer.cross) this.paintCross(this.pointer.cross);
    }

    /** The keyboard's pointer. */
    private paintCross({ x, y, pressed }: { x: number; y: number; pressed: boolean }): void {
        const scale = this.canvas.width / Math.max(this.canvas.clientWidth, 1);
        const { context } = this;
        context.setTransform(scale, 0, 0, scale, x * scale, y * scale);
        for (const [color, width] of [["#ffffff", 5], ["#d9481f", 2]] as const) {
            context.strokeStyle = color;
            context.lineWidth = width;
            context.beginPath();
            context.arc(0, 0, pressed ? 8 : 12, 0, 7);
            for (const [a, b] of [[1, 0], [-1, 0], [0, 1], [0, -1]] as const) {
                context.moveTo(a * 8, b * 8);
                context.lineTo(a * 18, b * 18);
            }
            context.stroke();
        }
        context.setTransform(1, 0, 0, 1, 0, 0);
    }

    /** Blob of the picture as it is. */
    png(): Promise<Blob> {
        this.paint();
        return new Promise((resolve, reject) =>
            this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture"))), "image/png"));
    }
}
