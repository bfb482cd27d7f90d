import type { Button, Player } from "../sinew/index.js";

/** What a pointer moves: a player, or a program of a lesson. */
export type Hands = Pick<Player, "pointerMove" | "pointerDown" | "pointerUp" | "pointerLeave" | "touch" | "wheel" | "zoom">;

const buttons: Button[] = ["left", "middle", "right"];
const step = { fine: 2, usual: 10, coarse: 50 }; // CSS pixels an arrow key moves the pointer by

/** Connects mouse, fingers, wheel and arrow keys of a canvas with a player. */
export class Pointer {
    /** Position of the keyboard's pointer in CSS pixels; null while it is not in use. */
    cross: { x: number; y: number; pressed: boolean } | null = null;

    constructor(private readonly canvas: HTMLCanvasElement, private readonly player: () => Hands, private readonly wake: () => void, takesWheel = true) {
        const on = <K extends keyof HTMLElementEventMap>(name: K, handle: (event: HTMLElementEventMap[K]) => void, passive = false): void =>
            canvas.addEventListener(name, (event) => (handle(event), wake()), { passive });
        on("pointerdown", (event) => this.down(event));
        on("pointermove", (event) => this.move(event));
        on("pointerup", (event) => this.up(event));
        on("pointercancel", (event) => this.up(event));
        on("pointerleave", (event) => event.pointerType !== "touch" && this.player().pointerLeave());
        if (takesWheel) on("wheel", (event) => this.wheel(event));
        on("contextmenu", (event) => event.preventDefault());
        on("keydown", (event) => this.key(event));
        on("blur", () => this.leave());
    }

    private at(x: number, y: number): [number, number] {
        const box = this.canvas.getBoundingClientRect();
        const scale = this.canvas.width / Math.max(box.width, 1);
        return [(x - box.left) * scale, (y - box.top) * scale];
    }

    private down(event: PointerEvent): void {
        this.leave();
        this.canvas.setPointerCapture(event.pointerId);
        const at = this.at(event.clientX, event.clientY);
        if (event.pointerType === "touch") return this.player().touch(event.pointerId, "down", ...at);
        this.player().pointerMove(...at);
        this.player().pointerDown(buttons[event.button] ?? "left");
    }

    private move(event: PointerEvent): void {
        const all = event.getCoalescedEvents?.() ?? [];
        for (const one of all.length > 0 ? all : [event]) {
            const at = this.at(one.clientX, one.clientY);
            if (event.pointerType !== "touch") this.player().pointerMove(...at);
            else if (this.canvas.hasPointerCapture(event.pointerId)) this.player().touch(event.pointerId, "move", ...at);
        }
    }

    private up(event: PointerEvent): void {
        const at = this.at(event.clientX, event.clientY);
        if (event.pointerType === "touch") this.player().touch(event.pointerId, "up", ...at);
        else this.player().pointerUp(buttons[event.button] ?? "left");
    }

    /** Trackpads report a pinch as a wheel with the control key. */
    private wheel(event: WheelEvent): void {
        event.preventDefault();
        const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 33 : 1;
        if (event.ctrlKey) this.player().zoom(Math.exp((-event.deltaY * lines) / 150));
        else this.player().wheel((-event.deltaY * lines) / 100);
    }

    private key(event: KeyboardEvent): void {
        const directions: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
        const direction = directions[event.key];
        if (direction) {
            const box = this.canvas.getBoundingClientRect();
            this.cross ??= { x: box.width / 2, y: box.height / 2, pressed: false };
            const by = event.altKey ? step.fine : event.shiftKey ? step.coarse : step.usual;
            this.cross.x = Math.min(Math.max(this.cross.x + direction[0] * by, 0), box.width);
            this.cross.y = Math.min(Math.max(this.cross.y + direction[1] * by, 0), box.height);
            this.player().pointerMove(...this.at(box.left + this.cross.x, box.top + this.cross.y));
        } else if (event.key === "Enter" && this.cross) {
            this.cross.pressed = !this.cross.pressed;
            if (this.cross.pressed) this.player().pointerDown("left");
            else this.player().pointerUp("left");
        } else {
            return;
        }
        event.preventDefault();
    }

    private leave(): void {
        if (this.cross?.pressed) this.player().pointerUp("left");
        this.cross = null;
        this.wake();
    }
}
