// Triangles of a picture, in typed arrays that grow and are used again.
import { triangulate, signedArea } from "./triangles.js";

const words = 7;      // of a vertex: place, local, shape (two floats each), colour
const flat = -1;      // shape.x of plain triangles; >= 0: half the length of a rounded line
const textured = -2;
const fade = 0.75;    // pixels of a polygon's soft rim

function rgba([red, green, blue, alpha]) {
    const byte = (channel) => (Math.min(Math.max(channel, 0), 1) * 255 + 0.5) | 0;
    return (byte(red) | (byte(green) << 8) | (byte(blue) << 16) | (byte(alpha) << 24)) >>> 0;
}

function grown(array, wanted) {
    const larger = new array.constructor(Math.max(wanted, 2 * array.length));
    larger.set(array);
    return larger;
}

export class Geometry {
    constructor() {
        this.floats = new Float32Array(words * 4096);
        this.colors = new Uint32Array(this.floats.buffer);
        this.indices = new Uint32Array(8192);
        this.clear();
    }

    clear() {
        this.vertexCount = 0;
        this.indexCount = 0;
        this.batches = [{ texture: null, first: 0, count: 0, pane: null }];
    }

    vertexBytes() { return new Uint8Array(this.floats.buffer, 0, 4 * words * this.vertexCount); }
    indexList() { return this.indices.subarray(0, this.indexCount); }

    put(x, y, u, v, form, radius, color) {
        const at = words * this.vertexCount;
        if (at + words > this.floats.length) {
            this.floats = grown(this.floats, at + words);
            this.colors = new Uint32Array(this.floats.buffer);
        }
        this.floats[at] = x;
        this.floats[at + 1] = y;
        this.floats[at + 2] = u;
        this.floats[at + 3] = v;
        this.floats[at + 4] = form;
        this.floats[at + 5] = radius;
        this.colors[at + 6] = color;
        return this.vertexCount++;
    }

    triangle(a, b, c) {
        if (this.indexCount + 3 > this.indices.length) this.indices = grown(this.indices, this.indexCount + 3);
        this.indices[this.indexCount++] = a;
        this.indices[this.indexCount++] = b;
        this.indices[this.indexCount++] = c;
        this.batches[this.batches.length - 1].count += 3;
    }

    /** Texture of the following triangles. Plain triangles join any batch. */
    use(texture) {
        const last = this.batches[this.batches.length - 1];
        if (last.texture !== texture) this.batches.push({ texture, first: this.indexCount, count: 0, pane: last.pane });
    }

    beginPane([x, y, right, bottom], color) {
        const [left, top] = [Math.floor(Math.min(x, right)), Math.floor(Math.min(y, bottom))];
        const [wide, high] = [Math.ceil(Math.max(x, right)) - left, Math.ceil(Math.max(y, bottom)) - top];
        const { texture } = this.batches[this.batches.length - 1];
        this.batches.push({ texture, first: this.indexCount, count: 0, pane: [left, top, wide, high] });
        this.addPolygon(new Float32Array([left, top, left + wide, top, left + wide, top + high, left, top + high]), color);
    }

    // --- lines ----------------------------------------------------------------------------------------------------

    /** A line with round ends; a disc where both ends are the same. */
    addLine(ax, ay, bx, by, width, color) {
        const paint = rgba(color);
        const length = Math.hypot(bx - ax, by - ay), half = length / 2, radius = width / 2;
        const [dx, dy] = length > 1e-6 ? [(bx - ax) / length, (by - ay) / length] : [1, 0];
        const [mx, my] = [(ax + bx) / 2, (ay + by) / 2];
        const far = half + radius + 1, wide = radius + 1; // with a pixel for the faded edge
        const corner = (x, y) => this.put(mx + dx * x - dy * y, my + dy * x + dx * y, x, y, half, radius, paint);
        const first = corner(-far, -wide);
        corner(far, -wide), corner(far, wide), corner(-far, wide);
        this.triangle(first, first + 1, first + 2), this.triangle(first, first + 2, first + 3);
    }

    /** A strip of quads that share their corners at gentle turns; at a sharp turn the strip ends and another begins. */
    addStroke(points, isClosed, width, color) {
        const way = wayThrough(points, isClosed);
        const last = way.length - 2;
        if (way.length < 6) return this.addLine(way[0], way[1], way[last], way[last + 1], width, color);
        const strip = new Strip(this, width / 2, rgba(color));
        let along = direction(way, 0);
        strip.begin(way[0], way[1], along);
        for (let i = 2; i < last; i += 2) {
            const next = direction(way, i);
            const straight = 1 + along[0] * next[0] + along[1] * next[1];
            const scale = strip.wide / Math.max(straight, 1e-3);
            const out = [-(along[1] + next[1]) * scale, (along[0] + next[0]) * scale];
            const inwards = Math.abs(out[0] * along[0] + out[1] * along[1]); // length of the corner along its sides
            const turns = straight < 1.5 || inwards > distance(way, i - 2) / 2 || inwards > distance(way, i) / 2;
            if (turns) strip.end(way[i], way[i + 1], along), strip.begin(way[i], way[i + 1], next);
            else strip.goOn(way[i], way[i + 1], out);
            along = next;
        }
        strip.end(way[last], way[last + 1], along);
    }

    // --- areas ----------------------------------------------------------------------------------------------------

    /** Triangles, and a rim around them that fades to transparent. */
    addPolygon(points, color) {
        const count = points.length / 2;
        if (count < 3) return;
        const paint = rgba(color), faded = (paint & 0xffffff) >>> 0;
        const first = this.vertexCount;
        for (let i = 0; i < count; ++i) this.put(points[2 * i], points[2 * i + 1], 0, 0, flat, 0, paint);
        triangulate(points, (a, b, c) => this.triangle(first + a, first + b, first + c));
        const outwards = signedArea(points) < 0 ? fade : -fade;
        const outer = this.vertexCount;
        for (let i = 0; i < count; ++i) {
            const [x, y] = outOf(points, i, count);
            this.put(points[2 * i] + x * outwards, points[2 * i + 1] + y * outwards, 0, 0, flat, 0, faded);
        }
        for (let i = 0; i < count; ++i) {
            const next = (i + 1) % count;
            this.triangle(first + i, first + next, outer + i);
            this.triangle(first + next, outer + next, outer + i);
        }
    }

    addImage({ points, across, color }, texture) {
        const down = points.length / 2 / across;
        if (!texture || across < 2 || down < 2) return;
        this.use(texture);
        const paint = rgba(color), first = this.vertexCount;
        for (let row = 0; row < down; ++row)
            for (let column = 0; column < across; ++column) {
                const at = 2 * (row * across + column);
                this.put(points[at], points[at + 1], column / (across - 1), row / (down - 1), textured, 0, paint);
            }
        for (let row = 0; row + 1 < down; ++row)
            for (let column = 0; column + 1 < across; ++column) {
                const a = first + row * across + column;
                this.triangle(a, a + 1, a + across), this.triangle(a + 1, a + across + 1, a + across);
            }
    }

    /** A sprite of whole pixels around a point: a line of text. */
    addSprite([x, y], sprite) {
        if (!sprite) return;
        const [left, top] = [Math.round(x - sprite.width / 2), Math.round(y - sprite.height / 2)];
        const [right, bottom] = [left + sprite.width, top + sprite.height];
        this.addImage({ points: [left, top, right, top, left, bottom, right, bottom], across: 2, color: [0, 0, 0, 0] }, sprite.texture);
    }
}

/** Quads along a line; the local coordinates are the distances beyond its end and from its middle. */
class Strip {
    constructor(geometry, radius, paint) {
        Object.assign(this, { geometry, radius, paint, wide: radius + 1 }); // with a pixel for the faded edge
    }

    pair(x, y, across, beyond) {
        const { geometry, wide, radius, paint } = this;
        geometry.put(x - across[0], y - across[1], beyond, -wide, 0, radius, paint);
        return geometry.put(x + across[0], y + across[1], beyond, wide, 0, radius, paint);
    }

    quadTo(last) {
        this.geometry.triangle(last - 3, last - 1, last);
        this.geometry.triangle(last - 3, last, last - 2);
    }

    begin(x, y, along) {
        const { wide } = this, across = [-along[1] * wide, along[0] * wide];
        this.pair(x - along[0] * wide, y - along[1] * wide, across, wide);
        this.quadTo(this.pair(x, y, across, 0));
    }

    goOn(x, y, across) {
        this.quadTo(this.pair(x, y, across, 0));
    }

    end(x, y, along) {
        const { wide } = this, across = [-along[1] * wide, along[0] * wide];
        this.quadTo(this.pair(x, y, across, 0));
        this.quadTo(this.pair(x + along[0] * wide, y + along[1] * wide, across, wide));
    }
}

/** The points without repetitions; a closed way ends where it began. */
function wayThrough(points, isClosed) {
    const way = [];
    for (let i = 0; i < points.length; i += 2)
        if (i === 0 || Math.hypot(way.at(-2) - points[i], way.at(-1) - points[i + 1]) > 1e-3) way.push(points[i], points[i + 1]);
    if (isClosed && way.length > 4) way.push(way[0], way[1]);
    return way;
}

function distance(way, i) {
    return Math.hypot(way[i + 2] - way[i], way[i + 3] - way[i + 1]);
}

function direction(way, i) {
    const length = distance(way, i) || 1;
    return [(way[i + 2] - way[i]) / length, (way[i + 3] - way[i + 1]) / length];
}

/** Unit vector to the left of an outline at a corner. */
function outOf(points, i, count) {
    const before = (i + count - 1) % count, after = (i + 1) % count;
    const unit = (from, to) => {
        const [x, y] = [points[2 * to] - points[2 * from], points[2 * to + 1] - points[2 * from + 1]];
        const length = Math.hypot(x, y) || 1;
        return [x / length, y / length];
    };
    const [p, q] = [unit(before, i), unit(i, after)];
    const [x, y] = [-(p[1] + q[1]), p[0] + q[0]];
    const length = Math.hypot(x, y) || 1;
    return [x / length, y / length];
}
