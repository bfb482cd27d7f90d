// A page for each example. A game of your own has one, and needs no configuration for sinew: the module is found by its address.
import { defineConfig } from "vite";

const pages = ["index", "three", "pixi", "phaser", "p5", "react"];
export default defineConfig({
    base: "./",
    build: {
        target: "es2022",
        chunkSizeWarningLimit: 2000,
        rolldownOptions: { input: Object.fromEntries(pages.map((page) => [page, `${page}.html`])) },
    },
});
