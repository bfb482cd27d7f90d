/** Images mapped onto grids of points in a 2D context. */

/** Enlargement of every triangle under its neighbours, in pixels: hides antialiased edges. */
const seam = 0.7;

/** A copy of an image with a colour blended over its opaque pixels; the latest few of each image are kept. */
const tinted = new WeakMap();
const most = 8; // colours of an image: some of text, some of shadows

function withColor(image, [red, green, blue, alpha]) {
    if (alpha <= 0) return image;
    const key = [red, green, blue, alpha].map((channel) => Math.round(channel * 255)).join();
    let known = tinted.get(image);
    if (!known) tinted.set(image, (known = new Map()));
    const found = known.get(key);
    if (found) return found;
    const canvas = blank(image.width, image.height);
    const context = canvas.getContext("2d", { willReadFrequently: true }); // drawn by the processor, without an upload
    context.drawImage(image, 0, 0);
    context.globalCompositeOperation = "source-atop";
    context.fillStyle = `rgba(${red * 255}, ${green * 255}, ${blue * 255}, ${alpha})`;
    context.fillRect(0, 0, image.width, image.height);
    if (known.size === most) known.delete(known.keys().next().value);
    known.set(key, canvas);
    return canvas;
}

function blank(width, height) {
    if (typeof OffscreenCanvas !== "undefined") return new OffscreenCanvas(width, height);
    return Object.assign(document.createElement("canvas"), { width, height });
}

/** Maps the image so that the pixels (u, v), (u + du, v), (u, v + dv) come to lie on a, b, c; clips to the corners. */
function drawFacet(context, image, [u, v, du, dv], a, b, c, corners) {
    context.save();
    context.beginPath();
    for (const [x, y] of corners) context.lineTo(x, y);
    context.closePath();
    context.clip();
    const right = [(b[0] - a[0]) / du, (b[1] - a[1]) / du];
    const below = [(c[0] - a[0]) / dv, (c[1] - a[1]) / dv];
    context.transform(right[0], right[1], below[0], below[1], a[0] - right[0] * u - below[0] * v, a[1] - right[1] * u - below[1] * v);
    context.drawImage(image, 0, 0);
    context.restore();
}

/** The corners of a triangle, moved outwards from their middle. */
function enlarged(corners) {
    const x = (corners[0][0] + corners[1][0] + corners[2][0]) / 3;
    const y = (corners[0][1] + corners[1][1] + corners[2][1]) / 3;
    return corners.map(([cx, cy]) => {
        const length = Math.hypot(cx - x, cy - y) || 1;
        return [cx + ((cx - x) / length) * seam, cy + ((cy - y) / length) * seam];
    });
}

/** Four corners of a parallelogram need one map. */
function isFlat(a, b, c, d) {
    return Math.hypot(d[0] - c[0] - b[0] + a[0], d[1] - c[1] - b[1] + a[1]) < 0.05;
}

export function drawImageGrid(context, source, { points, across, color }) {
    const down = points.length / 2 / across;
    if (across < 2 || down < 2) return;
    const image = withColor(source, color);
    const [du, dv] = [image.width / (across - 1), image.height / (down - 1)];
    const at = (row, column) => points.subarray(2 * (row * across + column));
    for (let row = 0; row + 1 < down; ++row)
        for (let column = 0; column + 1 < across; ++column) {
            const [a, b, c, d] = [at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)];
            const [u, v] = [column * du, row * dv];
            if (isFlat(a, b, c, d)) {
                drawFacet(context, image, [u, v, du, dv], a, b, c, [a, b, d, c]);
                continue;
            }
            drawFacet(context, image, [u, v, du, dv], a, b, c, enlarged([a, b, c]));
            drawFacet(context, image, [u + du, v + dv, -du, -dv], d, c, b, enlarged([d, c, b]));
        }
}
