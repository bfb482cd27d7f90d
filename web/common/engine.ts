import { catalogue, load, loadFloat, type CatalogueScene, type Engine, type OpenOptions, type Painter } from "../sinew/index.js";

const files = import.meta.glob<string>("../sinew/images/**/*.png", { query: "?url", import: "default", eager: true });
const addresses = new Map(Object.entries(files).map(([path, address]) => [path.replace("../sinew/images/", ""), address]));
const bitmaps = new Map<string, Promise<ImageBitmap>>();

function bitmap(name: string): Promise<ImageBitmap> | undefined {
    const address = addresses.get(name);
    if (!address) return undefined;
    let found = bitmaps.get(name);
    if (!found) bitmaps.set(name, (found = fetch(address).then((answer) => answer.blob()).then((blob) => createImageBitmap(blob))));
    return found;
}

/** Images and models of the catalogue, for any scene that names them. */
export class Assets {
    private readonly images: Map<string, { width: number; height: number }>;
    private readonly models: Map<string, string>;

    constructor(scenes: CatalogueScene[]) {
        this.images = new Map(scenes.flatMap((scene) => Object.entries(scene.images)));
        this.models = new Map(scenes.flatMap((scene) => Object.entries(scene.models)));
    }

    /** A model that somebody brings, until the page is left. */
    addModel(name: string, text: string): void {
        this.models.set(name, text);
    }

    optionsOf(text: string): Pick<OpenOptions, "images" | "models"> {
        const named = <Value>(all: Map<string, Value>): Record<string, Value> =>
            Object.fromEntries([...all].filter(([name]) => text.includes(`"${name}"`)));
        return { images: named(this.images), models: named(this.models) };
    }

    /** Loads the images that a text names. */
    async giveTo(painter: Painter, text: string): Promise<void> {
        const names = Object.keys(this.optionsOf(text).images ?? {});
        await Promise.all(names.map(async (name) => {
            const image = await bitmap(name);
            if (image) painter.setImage(name, image);
        }));
    }
}

export interface Loaded {
    engine: Engine;
    scenes: CatalogueScene[];
    assets: Assets;
}

const mostThreads = 4; // a step of a large world gains little from more

/** Threads that large worlds are worth: all processors but one, which paints. */
export const usefulThreads = (): number => Math.min(Math.max((navigator.hardwareConcurrency || 1) - 1, 1), mostThreads);

/** Several threads need a page that is cross-origin isolated; elsewhere the engine has one. */
export async function loadEngine(threads = 1): Promise<Loaded> {
    const [engine, scenes] = await Promise.all([load(undefined, { threads }), catalogue()]);
    return { engine, scenes, assets: new Assets(scenes) };
}

/** Loads the module of float worlds if a scene, or a pair of an address, asks for them. */
export async function provide(engine: Engine, text: string, pairs: string[] = []): Promise<void> {
    if (asksForFloat(text) || pairs.some((pair) => /^(solver\.)?precision=float$/.test(pair))) await loadFloat(engine);
}

export const asksForFloat = (text: string): boolean => /"precision"\s*:\s*"float"/.test(text);
