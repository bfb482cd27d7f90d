// Polygons of three or four corners, filled pixel by pixel, with soft rims.
import { itemWords } from "../picture.js";

const opaqueBits = 0xff000000 | 0;

/** Fills polygons of a picture in pixels: alpha, blue, green and red of an Int32Array, not premultiplied. */
export class TileRaster {
    constructor(width, height, pixels) {
        Object.assign(this, { width, height, pixels });
        this.edges = new Float64Array(12); // a, b, c of up to four sides: a x + b y + c pixels inside
    }

    /** A tile that is not convex is filled as two triangles, which may be a little more than the tile. */
    fillItem({ words, floats, points }, index) {
        const at = index * itemWords, from = 2 * words[at + 1], count = words[at + 2];
        const color = opaque(floats[at + 4], floats[at + 5], floats[at + 6]);
        if (count === 3 || isConvex(points, from)) return this.fill(points, from, from + 2, from + 4, count === 4 ? from + 6 : from, color);
        this.fill(points, from, from + 2, from + 4, from, color);
        this.fill(points, from, from + 4, from + 6, from, color);
    }

    /** A convex polygon with corners at four places of the points, of which the last may be the first again. */
    fill(points, a, b, c, d, color) {
        const area = twice(points, a, b, c) + twice(points, a, c, d);
        if (!(Math.abs(area) > 1e-3)) return;
        const side = area > 0 ? 1 : -1;
        this.setEdge(0, points, a, b, side);
        this.setEdge(3, points, b, c, side);
        this.setEdge(6, points, c, d, side);
        this.setEdge(9, points, d, a, side);
        const left = Math.floor(Math.min(points[a], points[b], points[c], points[d]) - 0.5);
        const right = Math.ceil(Math.max(points[a], points[b], points[c], points[d]) + 0.5);
        const top = Math.floor(Math.min(points[a + 1], points[b + 1], points[c + 1], points[d + 1]) - 0.5);
        const bottom = Math.ceil(Math.max(points[a + 1], points[b + 1], points[c + 1], points[d + 1]) + 0.5);
        this.fillPixels(Math.max(left, 0), Math.min(right, this.width), Math.max(top, 0), Math.min(bottom, this.height), color);
    }

    /** Side from p to q; a side without length bounds nothing. */
    setEdge(at, points, p, q, side) {
        const { edges } = this;
        const x = points[q] - points[p], y = points[q + 1] - points[p + 1];
        const length = Math.sqrt(x * x + y * y);
        const scale = length > 1e-6 ? side / length : 0;
        edges[at] = -y * scale;
        edges[at + 1] = x * scale;
        edges[at + 2] = scale === 0 ? 1 : (y * points[p] - x * points[p + 1]) * scale + 0.5; // with half a pixel of soft rim
    }

    /** Cover of a pixel: all of it, without what each side cuts off. */
    fillPixels(left, right, top, bottom, color) {
        const { pixels, width, edges } = this, x = left + 0.5;
        const a0 = edges[0], a1 = edges[3], a2 = edges[6], a3 = edges[9];
        for (let row = top; row < bottom; ++row) {
            const y = row + 0.5;
            let e0 = a0 * x + edges[1] * y + edges[2], e1 = a1 * x + edges[4] * y + edges[5];
            let e2 = a2 * x + edges[7] * y + edges[8], e3 = a3 * x + edges[10] * y + edges[11];
            const end = row * width + right;
            for (let i = row * width + left; i < end; ++i, e0 += a0, e1 += a1, e2 += a2, e3 += a3) {
                if (e0 >= 1 && e1 >= 1 && e2 >= 1 && e3 >= 1) {
                    pixels[i] = color;
                    continue;
                }
                const cover = (e0 < 1 ? e0 : 1) + (e1 < 1 ? e1 : 1) + (e2 < 1 ? e2 : 1) + (e3 < 1 ? e3 : 1) - 3;
                if (cover > 0) pixels[i] = over(pixels[i], color, cover);
            }
        }
    }
}

/** Twice the signed area of a triangle. */
function twice(points, a, b, c) {
    return (points[b] - points[a]) * (points[c + 1] - points[a + 1]) - (points[b + 1] - points[a + 1]) * (points[c] - points[a]);
}

function isConvex(points, a) {
    const b = a + 2, c = a + 4, d = a + 6;
    const atB = twice(points, a, b, c), atC = twice(points, b, c, d), atD = twice(points, c, d, a), atA = twice(points, d, a, b);
    return (atA >= 0 && atB >= 0 && atC >= 0 && atD >= 0) || (atA <= 0 && atB <= 0 && atC <= 0 && atD <= 0);
}

const byte = (channel) => (Math.min(Math.max(channel, 0), 1) * 255 + 0.5) | 0;

function opaque(red, green, blue) {
    return byte(red) | (byte(green) << 8) | (byte(blue) << 16) | opaqueBits;
}

/** A colour over a pixel, covering a part of it. */
function over(below, color, cover) {
    const alpha = below >>> 24;
    if (alpha === 255) return mixed(below, color, (cover * 256) | 0) | opaqueBits;
    const total = 255 * cover + alpha * (1 - cover);
    const shown = alpha === 0 ? color : mixed(below, color, ((65280 * cover) / total) | 0);
    return (shown & 0xffffff) | (((total + 0.5) | 0) << 24);
}

/** Blue, green and red between two colours, at so many 256ths of the way: two channels at once. */
function mixed(from, to, share) {
    const even = (Math.imul(from & 0xff00ff, 256 - share) + Math.imul(to & 0xff00ff, share)) >>> 8;
    const odd = (Math.imul((from >>> 8) & 0xff, 256 - share) + Math.imul((to >>> 8) & 0xff, share)) >>> 8;
    return (even & 0xff00ff) | (odd << 8);
}
