// A picture of a figure from its text, made in Node: of a program by running it, of a scene by the engine.
import { load, Shape } from "../../sinew/index.js";
import { programOf } from "./headless.mjs";
import { ofPicture, ofProgram } from "./svg.mjs";

const seconds = 1.2; // after the start

/** A function that draws figures as SVG. */
export async function picture() {
    const engine = await load();
    return (figure, text) => {
        if ("program" in figure) return ofProgram(programOf(text).run(Math.round(60 * seconds)).commands);
        const simulation = engine.open(text);
        try {
            simulation.runUntil(seconds);
            return ofPicture(simulation.draw(640, 400), Shape);
        } finally {
            simulation.dispose();
        }
    };
}
