import type { Figure } from "../lesson.js";

/** A function that draws figures as SVG. */
export function picture(): Promise<(figure: Figure, text: string) => string>;
