import { Shape } from "../picture.js";
import { drawImageGrid } from "./image_grid.js";
import { Mesh, endOfTiles, leastRun } from "./mesh.js";

const usualFont = '"Inter", "DejaVu Sans", system-ui, sans-serif';

/** Width of the rim around letters, both sides together, as a fraction of the letters' height. */
const textRim = 0.25;

export function cssColor([red, green, blue, alpha]) {
    const byte = (channel) => Math.round(Math.min(Math.max(channel, 0), 1) * 255);
    return `rgba(${byte(red)}, ${byte(green)}, ${byte(blue)}, ${alpha})`;
}

export function isFinitePath(points) {
    return points.length > 0 && points.every(Number.isFinite);
}

/** Paints pictures with a 2D context, at the context's current transform. */
export class Canvas2DPainter {
    constructor(context, { font = usualFont } = {}) {
        this.context = context;
        this.font = font;
        this.sprites = new Map();
        this.mesh = new Mesh();
    }

    /** Images by the names in the scene. */
    setImage(name, image) {
        this.sprites.set(name, image);
    }

    dispose() {
        this.sprites.clear();
    }

    paint(picture) {
        const { context } = this;
        context.save();
        context.lineCap = context.lineJoin = "round";
        this.paper = cssColor(picture.background);
        context.fillStyle = this.paper;
        context.fillRect(0, 0, picture.width, picture.height);
        context.save();
        this.paintItems(picture);
        context.restore();
        context.restore();
    }

    paintItems(picture) {
        const isPlain = this.context.getTransform()?.isIdentity;
        for (let i = 0; i < picture.length; ) {
            const end = isPlain ? endOfTiles(picture, i) : i;
            if (end - i >= leastRun) this.mesh.paint(this.context, picture, i, end);
            else for (let k = i; k < Math.max(end, i + 1); ++k) this.paintItem(picture, picture.item(k));
            i = Math.max(end, i + 1);
        }
    }

    paintItem(picture, item) {
        if (!isFinitePath(item.points)) return;
        if (item.shape === Shape.image) return this.paintImage(picture, item);
        if (item.color[3] <= 0) return;
        const color = cssColor(item.color);
        this.context.fillStyle = this.context.strokeStyle = color;
        const width = item.width >= 1 ? item.width : 1;
        switch (item.shape) {
        case Shape.disc: return this.paintDisc(item.points, width);
        case Shape.polygon: return this.paintPolygon(item.points);
        case Shape.text: return this.paintText(picture.texts[item.number], item.points, width);
        case Shape.pane: return this.beginPane(item.points, color);
        default: return this.paintStroke(item.points, item.shape === Shape.loop, width);
        }
    }

    paintDisc([x, y], width) {
        this.context.beginPath();
        this.context.arc(x, y, width / 2, 0, 2 * Math.PI);
        this.context.fill();
    }

    trace(points, isClosed) {
        const { context } = this;
        context.beginPath();
        for (let i = 0; i < points.length; i += 2) context.lineTo(points[i], points[i + 1]);
        if (isClosed) context.closePath();
    }

    paintStroke(points, isClosed, width) {
        if (points.length === 2) return this.paintDisc(points, width);
        this.trace(points, isClosed);
        this.context.lineWidth = width;
        this.context.stroke();
    }

    paintPolygon(points) {
        this.trace(points, true);
        this.context.fill("evenodd");
    }

    /** A rectangle of paper between two corners; later items are clipped to it. */
    beginPane([x, y, right, bottom], color) {
        const { context } = this;
        context.restore();
        context.save();
        context.beginPath();
        context.rect(Math.min(x, right), Math.min(y, bottom), Math.abs(right - x), Math.abs(bottom - y));
        context.clip();
        context.fillStyle = this.paper = color;
        context.fill();
    }

    /** Letters rimmed with paper, to be read over lines. */
    paintText(text, [x, y], height) {
        if (!text) return;
        const { context } = this;
        context.font = `${height}px ${this.font}`;
        context.textAlign = "center";
        context.textBaseline = "middle";
        context.strokeStyle = this.paper;
        context.lineWidth = height * textRim;
        context.strokeText(text, x, y);
        context.fillText(text, x, y);
    }

    paintImage(picture, item) {
        const image = this.sprites.get(picture.images[item.number]);
        if (image) drawImageGrid(this.context, image, item);
    }
}
