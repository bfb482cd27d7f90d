// Runs of small opaque polygons, such as the tiles of cloth, as one image: a canvas needs microseconds for each path.
import { itemWords, Shape } from "../picture.js";
import { TileRaster } from "./tile_raster.js";

/** Tiles in succession that are worth an image of their own. */
export const leastRun = 64;
const largest = 64; // pixels, of a tile's longer side

export class Mesh {
    /** Paints a run of tiles; the context's transform is the identity. */
    paint(context, picture, first, end) {
        this.resize(picture.width, picture.height);
        const { left, right, top, bottom } = boxOf(picture, first, end);
        if (right <= left || bottom <= top) return;
        const { pixels, width } = this.raster;
        for (let y = top; y < bottom; ++y) pixels.fill(0, y * width + left, y * width + right);
        for (let i = first; i < end; ++i) this.raster.fillItem(picture, i);
        const [wide, high] = [right - left, bottom - top];
        this.context.putImageData(this.image, 0, 0, left, top, wide, high);
        context.drawImage(this.canvas, left, top, wide, high, left, top, wide, high);
    }

    resize(width, height) {
        if (this.raster?.width === width && this.raster.height === height) return;
        this.canvas = typeof OffscreenCanvas !== "undefined" ? new OffscreenCanvas(width, height)
            : Object.assign(document.createElement("canvas"), { width, height });
        this.context = this.canvas.getContext("2d", { willReadFrequently: true }); // in the processor's memory
        this.image = this.context.createImageData(width, height);
        this.raster = new TileRaster(width, height, new Int32Array(this.image.data.buffer));
    }
}

/** Pixels that a run touches. */
function boxOf({ words, points, width, height }, first, end) {
    let left = width, right = 0, top = height, bottom = 0;
    for (let i = first; i < end; ++i) {
        const from = 2 * words[i * itemWords + 1], to = from + 2 * words[i * itemWords + 2];
        for (let k = from; k < to; k += 2) {
            left = Math.min(left, points[k]), right = Math.max(right, points[k]);
            top = Math.min(top, points[k + 1]), bottom = Math.max(bottom, points[k + 1]);
        }
    }
    return {
        left: Math.max(Math.floor(left) - 1, 0), right: Math.min(Math.ceil(right) + 1, width),
        top: Math.max(Math.floor(top) - 1, 0), bottom: Math.min(Math.ceil(bottom) + 1, height),
    };
}

/** Index after the tiles that begin at an item. */
export function endOfTiles(picture, first) {
    const { length } = picture;
    let end = first;
    while (end < length && isTile(picture, end)) ++end;
    return end;
}

/** Polygons that may be in a run: triangles and quadrangles, small and opaque. */
function isTile({ words, floats, points }, index) {
    const at = index * itemWords, count = words[at + 2];
    if (words[at] !== Shape.polygon || count < 3 || count > 4 || !(floats[at + 7] >= 1)) return false;
    const from = 2 * words[at + 1];
    for (let k = from + 2; k < from + 2 * count; k += 2) {
        const isNear = Math.abs(points[k] - points[from]) < largest && Math.abs(points[k + 1] - points[from + 1]) < largest;
        if (!isNear) return false; // so is what is not finite
    }
    return true;
}
