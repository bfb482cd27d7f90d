// Pictures as SVG: of what a program drew, and of the engine's display list.
const rounded = (value) => Number(value.toFixed(1));
const hex = ([red, green, blue]) => `#${[red, green, blue].map((part) => Math.round(255 * part).toString(16).padStart(2, "0")).join("")}`;
const escaped = (text) => text.replace(/[&<>]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[sign]);
const svg = (width, height, shapes) => `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="">${shapes.join("")}</svg>`;

const list = (points) => Array.from(points, rounded).join(" ");
/** An #rrggbbaa in two attributes. */
const inked = (name, color) => (color.length === 9 ? `${name}="${color.slice(0, 7)}" ${name}-opacity="${(parseInt(color.slice(7), 16) / 255).toFixed(2)}"` : `${name}="${color || "#2b2d42"}"`);
const stroke = (points, width, color) => `<polyline points="${list(points)}" fill="none" ${inked("stroke", color)} stroke-width="${rounded(width)}" stroke-linecap="round" stroke-linejoin="round"/>`;
const words = (text, x, y, color, size = 14, anchor = "middle") => `<text x="${rounded(x)}" y="${rounded(y)}" ${inked("fill", color)} font-family="sans-serif" font-size="${size}" text-anchor="${anchor}" dominant-baseline="middle">${escaped(text)}</text>`;

const commands = {
    disc: (x, y, radius, color) => `<circle cx="${rounded(x)}" cy="${rounded(y)}" r="${rounded(Math.max(radius, 0))}" ${inked("fill", color)}/>`,
    path: (points, width, color) => stroke(points, width, color),
    trail: (points, width, color) => stroke(points, width, `${color}80`),
    arrow: (x, y, dx, dy, color) => (Math.hypot(dx, dy) < 2 ? "" : stroke([x, y, x + dx, y + dy], 3, color) + commands.disc(x + dx, y + dy, 4, color)),
    square: (x, y, size, color) => `<rect x="${rounded(x - size / 2)}" y="${rounded(y - size / 2)}" width="${rounded(size)}" height="${rounded(size)}" ${inked("fill", color)}/>`,
    text: (text, x, y, color) => words(text, x, y, color),
    graph(numbers, low, high, x, y, width, height, color, label) {
        const down = (value) => y + height * (1 - (Math.min(Math.max(value, low), high) - low) / (high - low));
        const levels = high - low <= 10 ? Array.from({ length: Math.floor(high - low) + 1 }, (_, i) => low + i) : [low, high];
        const frame = label ? words(label, x + width / 2, y - 11, "") + levels.map((level) => stroke([x, down(level), x + width, down(level)], 1, "#ded4c0")).join("") : "";
        return frame + stroke(numbers.flatMap((value, i) => [x + (width * i) / Math.max(numbers.length - 1, 1), down(value)]), 2.2, color);
    },
};

/** The commands of kit.js. */
export const ofProgram = (drawn) => svg(640, 400, drawn.map(([shape, ...rest]) => commands[shape](...rest)));

/** The engine's picture without its images. */
export function ofPicture(picture, Shape) {
    const shapes = [];
    for (const { shape, points, width, color, number } of picture) {
        const ink = `${hex(color)}${Math.round(255 * color[3]).toString(16).padStart(2, "0")}`;
        if (shape === Shape.polyline) shapes.push(stroke(points, width, ink));
        else if (shape === Shape.loop) shapes.push(stroke([...points, points[0], points[1]], width, ink));
        else if (shape === Shape.disc) for (let i = 0; i < points.length; i += 2) shapes.push(commands.disc(points[i], points[i + 1], width / 2, ink));
        else if (shape === Shape.polygon) shapes.push(`<polygon points="${list(points)}" ${inked("fill", ink)}/>`);
        else if (shape === Shape.text) shapes.push(words(picture.texts[number], points[0], points[1], ink, rounded(width), "start"));
    }
    return svg(picture.width, picture.height, [`<rect width="100%" height="100%" fill="${hex(picture.background)}"/>`, ...shapes]);
}
