// make_catalogue.mjs SCENES PACKAGE: writes PACKAGE/catalogue.js and PACKAGE/images/ from the folder of scenes, as the
// module in PACKAGE reads them.
import { copyFile, mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [scenesFolder, packageFolder] = process.argv.slice(2).map((folder) => path.resolve(folder));
const { load } = await import(pathToFileURL(path.join(packageFolder, "index.js")));
const engine = await load(await readFile(path.join(packageFolder, "sinew.wasm")));

const categories = ["basics", "ropes", "cloth", "bodies", "characters", "machines", "other"];

/** Values of a document under any key of this name. */
function under(document, key) {
    if (document === null || typeof document !== "object") return [];
    return Object.entries(document).flatMap(([name, value]) => (name === key ? [value] : []).concat(under(value, key)));
}

/** Width and height of a PNG file, from its header. */
function sizeOfPng(bytes) {
    return { width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20) };
}

async function imagesOf(document) {
    const names = under(document, "image").map((image) => (typeof image === "string" ? image : image.file));
    const sizes = {};
    for (const name of new Set(names)) {
        const target = path.join(packageFolder, "images", name);
        await mkdir(path.dirname(target), { recursive: true });
        await copyFile(path.join(scenesFolder, name), target);
        sizes[name] = sizeOfPng(await readFile(target));
    }
    return sizes;
}

async function modelsOf(document) {
    const names = under(document, "figures").flat().filter((figure) => figure?.prefab === "mesh" && figure.file);
    const texts = {};
    for (const { file } of names) texts[file] = await readFile(path.join(scenesFolder, file), "utf8");
    return texts;
}

/** True if the document states a value at a path: "figures.0.length". */
function states(document, steps) {
    let value = document;
    for (const step of steps.split(".")) {
        if (value === null || typeof value !== "object" || !(step in value)) return false;
        value = value[step];
    }
    return true;
}

/** Names in a path are clearer than numbers: "figures.bob.height". */
function namedPath(document, steps) {
    const [list, number, ...rest] = steps.split(".");
    const name = list === "figures" && document.figures[number].name;
    return name ? [list, name, ...rest].join(".") : steps;
}

function titleOf(name) {
    const words = name.replaceAll("_", " ").replace(/3d$/, " 3D");
    return words[0].toUpperCase() + words.slice(1);
}

async function sceneOf(file) {
    const text = await readFile(path.join(scenesFolder, file), "utf8");
    const name = path.basename(file, ".json");
    const document = JSON.parse(text.replace(/^\s*\/\/.*$/gm, ""));
    const [images, models] = [await imagesOf(document), await modelsOf(document)];
    const simulation = engine.open(text, { name: file, images, models });
    const { dimension, seconds, size } = simulation;
    const parameters = simulation.parameters().filter(({ path: steps }) => states(document, steps))
        .map((parameter) => ({ ...parameter, path: namedPath(document, parameter.path) }));
    simulation.dispose();
    const { about = "", source = "", category = "other" } = document;
    const modes = Object.keys(document.modes ?? {});
    return { name, title: titleOf(name), about, source, category, dimension, seconds, size, parameters, modes, images, models, text };
}

const files = (await readdir(scenesFolder)).filter((file) => file.endsWith(".json")).sort();
const scenes = [];
for (const file of files) scenes.push(await sceneOf(file));
scenes.sort((a, b) => categories.indexOf(a.category) - categories.indexOf(b.category)); // stable: by name within
await writeFile(path.join(packageFolder, "catalogue.js"),
    `// Made from the folder scenes/ by tools/make_catalogue.mjs.\nexport const scenes = ${JSON.stringify(scenes, null, 1)};\n`);
console.log(`${scenes.length} scenes`);
