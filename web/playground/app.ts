import { SceneErrors, type CatalogueScene, type Engine, type SceneError } from "../sinew/index.js";
import { readAddress, writeAddress, type Address } from "../common/address.js";
import { announce, byId, debounced, el, words } from "../common/dom.js";
import { loadScenes, provide, sceneText, type Assets } from "../common/engine.js";
import { Stage } from "../common/stage.js";
import { applyTheme, setTheme, theme, themeOfScene } from "../common/theme.js";
import { exportKinds, exportScene } from "./exports.js";
import { Films } from "./films.js";
import { offer, sceneFile } from "./files.js";
import type { Gallery } from "./gallery.js";
import { helpDialog } from "./help.js";
import { connectKeys } from "./keys.js";
import { Menu } from "./menu.js";
import { isForeign, mainOf, readForeign } from "./imports.js";
import { NotesList } from "./notes.js";
import { Panel } from "./panel.js";
import { addressOf, isBoth, unnamed } from "./share.js";
import { SteeringPad } from "./steering.js";
import { TimeBar } from "./timebar.js";
import { Toolbar } from "./toolbar.js";

/** Text and name of the scene that is open, as it was opened. */
export interface Opened {
    name: string;
    text: string;
    isOfCatalogue: boolean;
    pairs: string[];
    about: string;
    source: string;
}

/** The playground: a gallery, and a player with its bars. */
export class App {
    stage: Stage | null = null;
    opened: Opened | null = null;
    /** The catalogue, once the gallery has been shown. */
    scenes: CatalogueScene[] | undefined;
    private gallery: Gallery | undefined;
    private readonly help: HTMLDialogElement;
    private readonly films = new Films();
    readonly notes = new NotesList();
    private readonly pad = new SteeringPad(this);
    private toolbar: Toolbar | null = null;
    private timebar: TimeBar | null = null;
    private panel: Panel | null = null;
    private shownAddress = "";
    private lastMessage = "";
    private refreshedAt = 0;

    constructor(readonly engine: Engine, readonly assets: Assets) {
        this.help = helpDialog(engine);
        new Menu([
            { name: "scenes", icon: "scenes", tip: "all scenes", href: "#" },
            { name: "lessons", icon: "lessons", tip: "how it works, step by step", href: "./learn/" },
            { name: "share", icon: "share", tip: "copy the address of this scene as it is now", ofScene: true, press: () => void this.share() },
            { name: "save", icon: "save", tip: "save the scene, a picture or a film", ofScene: true, items: [
                { name: "scene (JSON)", press: () => this.saveScene() },
                { name: "picture (PNG)", press: () => void this.savePicture() },
                { name: "film (WebM)", press: () => this.films.toggle(this.stage!, "video", this.fileName) },
                { name: "film (GIF)", press: () => this.films.toggle(this.stage!, "gif", this.fileName) },
                ...exportKinds.map(({ name, ending }) => ({ name, press: () => void this.exportAs(ending) })),
                { name: "open a file…", press: () => this.chooseFile() }] },
            { name: "theme", icon: "theme", tip: "light or dark  (t)", press: () => this.switchTheme() },
            { name: "keys", icon: "help", tip: "keys and buttons  (F1)", ofScene: true, press: () => this.help.showModal() },
            { name: "panel", icon: "panel", tip: "the panel", ofScene: true, press: () => this.openPanel() },
        ]);
        addEventListener("hashchange", () => void this.follow(location.hash));
        connectKeys(this, this.help);
        this.takeDrops();
    }

    /** Shows what an address names. */
    async follow(fragment: string): Promise<void> {
        if (fragment !== "" && fragment === this.shownAddress) return;
        try {
            const address = await readAddress(fragment);
            if (address.scene === undefined && address.text === undefined) return await this.showGallery();
            await this.open(address, () => location.hash === fragment);
        } catch (error) {
            if (!this.opened) await this.showGallery();
            announce(messageOf(error));
        }
    }

    private async showGallery(): Promise<void> {
        this.shownAddress = "";
        document.body.classList.remove("playing", "drawer");
        document.title = "Sinew playground";
        this.stage?.player.pause();
        const hadFocus = byId("player").contains(document.activeElement) || document.activeElement === document.body;
        byId("player").hidden = true;
        const gallery = await this.loadGallery();
        if (!byId("player").hidden) return; // a scene was opened meanwhile
        gallery.show(true);
        if (hadFocus && this.opened) gallery.focus(this.opened.isOfCatalogue ? this.opened.name : undefined);
    }

    /** The gallery and the catalogue come when they are first shown. */
    private async loadGallery(): Promise<Gallery> {
        const [{ Gallery }, scenes] = await Promise.all([import("./gallery.js"), loadScenes()]);
        this.gallery ??= new Gallery(scenes, this.engine.module, {
            blank: () => void this.openText(blankScene, "new scene"),
            file: () => this.chooseFile(),
        });
        this.scenes = scenes;
        return this.gallery;
    }

    /** `isWanted` is false once the reader has gone elsewhere while the scene was loaded. */
    private async open({ scene, text, name, pairs }: Address, isWanted: () => boolean): Promise<void> {
        const own = text ?? await sceneText(scene!);
        if (own === undefined) throw new Error(`No scene is called "${scene}".`);
        const isSplit = pairs.some(isBoth), overrides = pairs.filter((pair) => !isBoth(pair));
        await provide(this, own, overrides);
        if (!isWanted()) return;
        this.show({ name: text === undefined ? scene! : name ?? unnamed, text: own, isOfCatalogue: text === undefined, pairs: overrides, ...aboutOf(own) });
        this.shownAddress = location.hash;
        this.split(isSplit);
    }

    /** Opens a scene from a text that is not in the address: a file, the clipboard. */
    async openText(text: string, name: string): Promise<void> {
        try {
            await provide(this, text);
            const opened = { name: name.replace(/\.json$/i, ""), text, isOfCatalogue: false, pairs: [], ...aboutOf(text) };
            const address = await writeAddress({ text, name: opened.name, pairs: [] });
            this.show(opened);
            this.shownAddress = address;
            history.pushState(null, "", address);
        } catch (error) {
            announce(messageOf(error));
        }
    }

    private show(opened: Opened): void {
        const fromGallery = byId("gallery").contains(document.activeElement);
        this.gallery?.show(false);
        byId("player").hidden = false;
        if (fromGallery) byId("stage").focus({ preventScroll: true }); // else the focus is lost with the card
        document.body.classList.add("playing");
        const options = { name: `${opened.name}.json`, overrides: opened.pairs };
        try {
            if (this.stage) this.stage.show(opened.text, options);
            else this.begin(Stage.open(byId<HTMLCanvasElement>("stage"), this.engine, this.assets, opened.text, options));
        } catch (error) {
            if (!this.stage) this.showGallery();
            throw error;
        }
        this.opened = opened;
        document.title = `${words(opened.name)} – Sinew`;
        byId("stage").setAttribute("aria-label", `The scene: ${words(opened.name)}`);
        byId("scene").dataset.name = words(opened.name);
        this.applyTheme();
        this.stage!.player.pause(false);
        this.panel!.text.opened(opened.text);
        this.rescan();
        this.panel!.introduce(opened);
        this.refresh();
        this.hint();
    }

    private begin(stage: Stage): void {
        this.stage = stage;
        const changed = (): void => this.changed();
        this.toolbar = new Toolbar(this.engine, stage, changed);
        this.timebar = new TimeBar(stage, changed);
        this.panel = new Panel(this.engine, stage, {
            setMode: (mode) => this.setMode(mode),
            themeChanged: () => this.applyTheme(),
            changed,
            textChanged: () => this.changed(),
        });
        // With shift, the tool select chooses more.
        stage.canvas.addEventListener("pointerdown", (event) => stage.player.key("shift", event.shiftKey), { capture: true });
        stage.onframe = () => this.afterFrame();
    }

    mode = "physical";

    /** Reads the scene again, after a change of it. */
    private rescan(): void {
        const parameters = this.stage!.player.parameters();
        this.mode = parameters.find(({ path }) => path === "solver.mode")?.value === "classic" ? "classic" : "physical";
        this.panel!.showParameters(parameters);
        this.pad.show(this.stage!.player);
    }

    /** Shows both modes beside each other, or one. */
    private split(on: boolean): void {
        const { player } = this.stage!;
        if (on === player.state().panes > 1) return;
        player.do("split");
        this.changed();
    }

    private setMode(mode: string): void {
        const { player } = this.stage!;
        this.split(mode === "both");
        if (mode !== "both" && mode !== this.mode) player.do("mode");
        this.changed();
    }

    /** Opens or closes the drawer of a narrow page. */
    openPanel(on?: boolean): void {
        this.panel?.open(on);
    }

    switchTheme(): void {
        setTheme(theme() === "dark" ? "light" : "dark");
        this.applyTheme();
    }

    private applyTheme(): void {
        applyTheme();
        if (!byId("gallery").hidden) this.gallery?.show(true);
        this.stage?.player.setTheme(themeOfScene());
        this.stage?.wake();
        if (this.panel) this.refresh();
    }

    /** Something was done to the player: bars, text and address follow. */
    changed(): void {
        if (!this.stage) return;
        this.stage.wake();
        this.rescan();
        this.refresh();
        this.settled();
    }

    private readonly settled = debounced(400, () => {
        this.panel?.text.follow();
        void this.writeAddress();
    });

    private refresh(): void {
        const state = this.stage!.player.state();
        this.toolbar!.show(state);
        this.timebar!.show(state, this.stage!.player.simulation.report().seconds);
        this.panel!.show(state, this.mode);
        byId("scene").classList.toggle("split", state.panes > 1);
        byId("scene").dataset.theme = state.theme;
        if (state.message && state.message !== this.lastMessage) announce(state.message);
        this.lastMessage = state.message;
    }

    private afterFrame(): void {
        const now = performance.now();
        this.panel!.sample(now);
        if (now - this.refreshedAt < 100) return;
        this.refreshedAt = now;
        if (this.stage!.player.events().some(({ what }) => what !== "moved")) this.settled();
        this.refresh();
    }

    // --- addresses and files ------------------------------------------------------------------------------------

    private async address(): Promise<string> {
        return addressOf(this.engine, this.stage!, this.opened!, this.panel!.text.text);
    }

    /** Keeps the address that of the scene as it is, unless the reader goes elsewhere meanwhile. */
    private async writeAddress(): Promise<void> {
        if (byId("player").hidden || !this.opened) return;
        const from = location.href, address = await this.address();
        if (address === this.shownAddress || location.href !== from) return;
        this.shownAddress = address;
        history.replaceState(null, "", address);
    }

    private async share(): Promise<void> {
        await this.writeAddress();
        const data = { title: document.title, url: location.href };
        if (matchMedia("(pointer: coarse)").matches && navigator.canShare?.(data)) return navigator.share(data).catch(() => {});
        try {
            await navigator.clipboard.writeText(location.href);
            announce("The address is copied: whoever opens it has this scene.");
        } catch {
            announce("The address of the page is that of this scene: copy it from above.");
        }
    }

    private get fileName(): string {
        return this.opened?.name ?? "scene";
    }

    saveScene(): void {
        this.panel!.text.follow();
        offer(sceneFile(this.panel!.text.text), `${this.fileName}.json`);
    }

    async savePicture(): Promise<void> {
        offer(await this.stage!.png(), `${this.fileName}.png`);
    }

    private async exportAs(ending: string): Promise<void> {
        this.panel!.text.follow();
        try {
            await exportScene(this.panel!.text.text, [], this.assets, this.fileName, ending);
        } catch (error) {
            announce(messageOf(error));
        }
    }

    toggleFilm(): void {
        this.films.toggle(this.stage!, "video", this.fileName);
    }

    chooseFile(): void {
        const accept = ".json,.svg,.png,.obj,.glb,.gltf,.bin,.tmj,.tsj,.tsx,application/json";
        const input = el("input", { type: "file", multiple: true, accept, onchange: () => void this.openFiles([...(input.files ?? [])]) });
        input.click();
    }

    /** Opens a scene, or a file of another program with those that it refers to. */
    private async openFiles(files: File[]): Promise<void> {
        const file = mainOf(files);
        if (!file) return;
        this.notes.show(file.name, []);
        try {
            if (!(await isForeign(file))) return await this.openText(await file.text(), file.name);
            announce(`Reading ${file.name}…`);
            const { scene, notes } = await readForeign(file, files, this.assets);
            await this.openText(scene, file.name.replace(/\.\w+$/, ""));
            this.notes.show(file.name, notes);
        } catch (error) {
            announce(messageOf(error));
        }
    }

    private takeDrops(): void {
        addEventListener("dragover", (event) => event.preventDefault());
        addEventListener("drop", (event) => {
            event.preventDefault();
            void this.openFiles([...(event.dataTransfer?.files ?? [])]);
        });
        addEventListener("paste", (event) => {
            const text = event.clipboardData?.getData("text") ?? "";
            const isTyping = event.target instanceof Element && event.target.closest("input, textarea, .cm-editor");
            if (!isTyping && text.trimStart().startsWith("{")) void this.openText(text, "pasted scene");
        });
    }

    /** Opens the neighbour in the catalogue. */
    async openNeighbour(by: number): Promise<void> {
        const scenes = await loadScenes(), index = scenes.findIndex(({ name }) => name === this.opened?.name);
        const next = scenes[(index + by + scenes.length) % scenes.length];
        if (next) location.hash = `#scene=${next.name}`;
    }

    /** Tells newcomers what can be done, until they do it. */
    private hint(): void {
        const key = "sinew.dragged", hint = byId("hint");
        if (localStorage.getItem(key)) return;
        hint.textContent = matchMedia("(pointer: coarse)").matches
            ? "Drag anything. Two fingers move and zoom."
            : "Drag anything. The right button cuts, the wheel zooms, F1 shows the keys.";
        hint.hidden = false;
        const hide = (): void => {
            hint.hidden = true;
        };
        byId("stage").addEventListener("pointerdown", () => (localStorage.setItem(key, "1"), hide()), { once: true });
        setTimeout(hide, 10_000);
    }
}

const blankScene = `{
  "sinew": 1,
  "about": "A room with a box in it: draw a rope, a polygon or a cloth, spawn a figure, or write one here.",
  "units": {"length": "px", "time": "s", "up": "-y"},
  "view": {"size": [640, 480], "center": [320, 240], "height": 480},
  "world": {"gravity": [0, 700], "bounds": {"box": [[10, 10], [630, 470]], "bounce": 0.4, "friction": 0.4}},
  "figures": [
    {"prefab": "box", "name": "box", "at": [280, 200], "width": 80, "height": 80, "braces": "one", "mass": 4, "thickness": 10}
  ]
}
`;

function aboutOf(text: string): { about: string; source: string } {
    const field = (name: string): string => new RegExp(`"${name}"\\s*:\\s*("(?:[^"\\\\]|\\\\.)*")`).exec(text)?.[1] ?? '""';
    try {
        return { about: JSON.parse(field("about")), source: JSON.parse(field("source")) };
    } catch {
        return { about: "", source: "" };
    }
}

function messageOf(error: unknown): string {
    if (error instanceof SceneErrors) return error.errors.slice(0, 3).map(placed).join("; ");
    return error instanceof Error ? error.message : String(error);
}

/** A mistake with its place: a line of the file, or a pair of the address; with the nearest name where one is meant. */
function placed({ line, message, help, isOverride, text }: SceneError): string {
    const meant = /^did you mean "[^"]*"\?/.exec(help)?.[0], pair = /^ *1 \| (.*)$/m.exec(text)?.[1] ?? "";
    return `${isOverride ? `in the address, ${pair}` : `line ${line}`}: ${message}${meant ? `; ${meant}` : ""}`;
}
