import { catalogue, load, type CatalogueScene, type Engine, type OpenOptions, type Painter } from "../sinew/index.js";

const addresses = import.meta.glob<string>("../sinew/images/**/*.png", { query: "?url", import: "default", eager: true });
const images = new Map(Object.entries(addresses).map(([path, address]) => [path.replace("../sinew/images/", ""), address]));

export interface Loaded {
    engine: Engine;
    scenes: CatalogueScene[];
}

export async function loadEngine(): Promise<Loaded> {
    const [engine, scenes] = await Promise.all([load(), catalogue()]);
    return { engine, scenes };
}

const bitmaps = new Map<string, Promise<ImageBitmap>>();

function bitmap(name: string): Promise<ImageBitmap> | undefined {
    const address = images.get(name);
    if (!address) return undefined;
    let found = bitmaps.get(name);
    if (!found) bitmaps.set(name, (found = fetch(address).then((answer) => answer.blob()).then((blob) => createImageBitmap(blob))));
    return found;
}

/** Images that a scene's text names and the package has, with their sizes for the engine. */
export class SceneImages {
    readonly bitmaps = new Map<string, ImageBitmap>();

    static async of(text: string): Promise<SceneImages> {
        const found = new SceneImages();
        for (const name of images.keys()) {
            const pending = text.includes(`"${name}"`) ? bitmap(name) : undefined;
            if (pending) found.bitmaps.set(name, await pending);
        }
        return found;
    }

    options(): Pick<OpenOptions, "images"> {
        return { images: Object.fromEntries([...this.bitmaps].map(([name, { width, height }]) => [name, { width, height }])) };
    }

    giveTo(painter: Painter): void {
        for (const [name, image] of this.bitmaps) painter.setImage(name, image);
    }
}
