import { catalogue, load, loadFloat, type CatalogueScene, type Engine, type OpenOptions, type Painter } from "../sinew/index.js";
import { fetchOwn, loadOwn } from "./fresh.js";

const files = import.meta.glob<string>("../sinew/images/**/*.png", { query: "?url", import: "default", eager: true });
const addresses = new Map(Object.entries(files).map(([path, address]) => [path.replace("../sinew/images/", ""), address]));
const models = import.meta.glob<string>("../../scenes/models/*.obj", { query: "?url", import: "default", eager: true });
const modelAddresses = new Map(Object.entries(models).map(([path, address]) => [path.replace("../../scenes/", ""), address]));
const isIn = (text: string, name: string): boolean => text.includes(`"${name}"`);
const bitmaps = new Map<string, Promise<ImageBitmap>>();

function bitmap(name: string): Promise<ImageBitmap> | undefined {
    const address = addresses.get(name);
    if (!address) return undefined;
    let found = bitmaps.get(name);
    if (!found) bitmaps.set(name, (found = fetchOwn(address).then((answer) => answer.blob()).then((blob) => createImageBitmap(blob))));
    found.catch(() => bitmaps.delete(name)); // without a network: another time
    return found;
}

let loading: Promise<CatalogueScene[]> | undefined;

/** The catalogue, loaded when it is first asked for: a page that opens one scene does without. */
export function loadScenes(): Promise<CatalogueScene[]> {
    loading ??= catalogue();
    loading.catch(() => (loading = undefined)); // without a network: another time
    return loading;
}

const texts = import.meta.glob<string>("../../scenes/*.json", { query: "?url", import: "default", eager: true });

/** The text of a scene of the catalogue; undefined if none is called so. */
export async function sceneText(name: string): Promise<string | undefined> {
    const address = texts[`../../scenes/${name}.json`];
    return address && (await fetchOwn(address)).text();
}

/** Images and models of the catalogue, for any scene that names them. */
export class Assets {
    private readonly images = new Map<string, { width: number; height: number }>();
    private readonly models = new Map<string, string>();
    /** Images that somebody brings, until the page is left. */
    private readonly brought = new Map<string, ImageBitmap>();

    /** Whether a text names an image or a model that `prepare` loads. */
    static areIn(text: string): boolean {
        return [...addresses.keys(), ...modelAddresses.keys()].some((name) => isIn(text, name));
    }

    /** Loads what a text names, for its scene to open with. */
    async prepare(text: string): Promise<void> {
        const loadImage = async (name: string): Promise<void> => {
            const image = await bitmap(name);
            if (image) this.images.set(name, { width: image.width, height: image.height });
        };
        const loadModel = async (name: string, address: string): Promise<void> => {
            if (!this.models.has(name)) this.models.set(name, await (await fetchOwn(address)).text());
        };
        await Promise.all([
            ...[...addresses.keys()].filter((name) => isIn(text, name)).map(loadImage),
            ...[...modelAddresses].filter(([name]) => isIn(text, name)).map(([name, address]) => loadModel(name, address))]);
    }

    /** A model that somebody brings, until the page is left. */
    addModel(name: string, text: string): void {
        this.models.set(name, text);
    }

    async addImage(name: string, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
        const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        this.brought.set(name, image);
        this.images.set(name, { width: image.width, height: image.height });
    }

    optionsOf(text: string): Pick<OpenOptions, "images" | "models"> {
        const named = <Value>(all: Map<string, Value>): Record<string, Value> =>
            Object.fromEntries([...all].filter(([name]) => isIn(text, name)));
        return { images: named(this.images), models: named(this.models) };
    }

    /** Loads the images that a text names. */
    async giveTo(painter: Painter, text: string): Promise<void> {
        const names = Object.keys(this.optionsOf(text).images ?? {});
        await Promise.all(names.map(async (name) => {
            const image = this.brought.get(name) ?? (await bitmap(name));
            if (image) painter.setImage(name, image);
        }));
    }
}

export interface Loaded {
    engine: Engine;
    assets: Assets;
}

const mostThreads = 4; // a step of a large world gains little from more

/** Threads that large worlds are worth: all processors but one, which paints. */
export const usefulThreads = (): number => Math.min(Math.max((navigator.hardwareConcurrency || 1) - 1, 1), mostThreads);

/** Several threads need a page that is cross-origin isolated; elsewhere the engine has one. */
export async function loadEngine(threads = 1): Promise<Loaded> {
    return { engine: await load(undefined, { threads }), assets: new Assets() };
}

/** Loads what a scene, or a pair of an address, asks for: the module of float worlds, images, models. */
export async function provide({ engine, assets }: Loaded, text: string, pairs: string[] = []): Promise<void> {
    const isFloat = asksForFloat(text) || pairs.some((pair) => /^(solver\.)?precision=float$/.test(pair));
    await Promise.all([isFloat ? loadOwn(loadFloat(engine)) : undefined, assets.prepare(text)]);
}

const asksForFloat = (text: string): boolean => /"precision"\s*:\s*"float"/.test(text);

/** Whether `provide` has something to load for a text. */
export const asksForMore = (text: string): boolean => asksForFloat(text) || Assets.areIn(text);
