import type { Command } from "./runner.js";

export const size = { width: 640, height: 400 };

interface Colors {
    text: string;
    line: string;
    background: string;
}

/** Paints what a program drew; colors that it left open are those of the page. */
export function paint(pen: CanvasRenderingContext2D, commands: Command[], colors: Colors): void {
    const scale = pen.canvas.width / size.width;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = colors.background;
    pen.fillRect(0, 0, pen.canvas.width, pen.canvas.height);
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.lineCap = pen.lineJoin = "round";
    for (const command of commands) painters[command[0]]?.(pen, command.slice(1), colors);
}

type Paint = (pen: CanvasRenderingContext2D, given: any[], colors: Colors) => void;

function stroke(pen: CanvasRenderingContext2D, points: number[], width: number, color: string): void {
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.beginPath();
    for (let i = 0; i + 1 < points.length; i += 2) pen.lineTo(points[i]!, points[i + 1]!);
    pen.stroke();
}

const painters: Record<string, Paint> = {
    disc(pen, [x, y, radius, color], { text }) {
        pen.fillStyle = color || text;
        pen.beginPath();
        pen.arc(x, y, Math.max(radius, 0), 0, 7);
        pen.fill();
    },
    path: (pen, [points, width, color], { text }) => stroke(pen, points, width, color || text),
    /** Fades towards its beginning. */
    trail(pen, [points, width, color], { text }) {
        const part = Math.max(Math.ceil(points.length / 16), 2) & ~1;
        for (let i = 0; i + 2 < points.length; i += part) {
            pen.globalAlpha = (0.75 * (i + part)) / points.length;
            stroke(pen, points.slice(i, i + part + 2), width, color || text);
        }
        pen.globalAlpha = 1;
    },
    arrow(pen, [x, y, dx, dy, color], { text }) {
        const length = Math.hypot(dx, dy);
        if (length < 2) return;
        const [head, ux, uy] = [Math.min(10, 0.6 * length), dx / length, dy / length];
        const [tipX, tipY] = [x + dx, y + dy];
        stroke(pen, [x, y, tipX - head * ux, tipY - head * uy], 3, color || text);
        pen.fillStyle = color || text;
        pen.beginPath();
        pen.moveTo(tipX, tipY);
        pen.lineTo(tipX - head * ux - 0.5 * head * uy, tipY - head * uy + 0.5 * head * ux);
        pen.lineTo(tipX - head * ux + 0.5 * head * uy, tipY - head * uy - 0.5 * head * ux);
        pen.fill();
    },
    square(pen, [x, y, width, color], { text }) {
        pen.fillStyle = color || text;
        pen.fillRect(x - width / 2, y - width / 2, width, width);
    },
    text(pen, [words, x, y, color], { text }) {
        pen.fillStyle = color || text;
        pen.font = "600 14px 'Inter Variable', system-ui, sans-serif";
        pen.textAlign = "center";
        pen.textBaseline = "middle";
        pen.fillText(words, x, y);
    },
    graph(pen, [numbers, low, high, x, y, width, height, color, label], colors) {
        const across = (i: number): number => x + (width * i) / Math.max(numbers.length - 1, 1);
        const down = (value: number): number => y + height * (1 - (Math.min(Math.max(value, low), high) - low) / (high - low));
        if (label) {
            const levels = high - low <= 10 ? Array.from({ length: Math.floor(high - low) + 1 }, (_, i) => low + i) : [low, high];
            for (const level of levels) stroke(pen, [x, down(level), x + width, down(level)], 1, colors.line);
            painters.text!(pen, [label, x + width / 2, y - 11, ""], colors);
        }
        stroke(pen, numbers.flatMap((value: number, i: number) => [across(i), down(value)]), 2.2, color || colors.text);
    },
};
