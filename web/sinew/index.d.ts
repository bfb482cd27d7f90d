/**
 * Sinew in JavaScript: an engine of Verlet points and constraints, compiled to WebAssembly. Same core and same bits as
 * the native library. Works in browsers, workers and Node 20.
 *
 * Lengths, times and forces are in the units of the scene, angles in radians, pointer positions in pixels of the picture.
 */

/** The ABI of the module that this package expects; `load` refuses another. */
export const abi: number;

/** Where the module is: an address, its bytes, a compiled module, or the response of a fetch. */
export type ModuleSource = string | URL | ArrayBuffer | ArrayBufferView | WebAssembly.Module | Response | Promise<Response>;

export interface LoadOptions {
    /**
     * Threads that share the steps of large worlds (from 4096 particles); 1 by default. More than one are workers on
     * shared memory, with the module sinew-threads.wasm, in Node and on pages that are cross-origin isolated; elsewhere
     * the engine has one. Results are the same to the last bit. `engine.stop()` ends the workers.
     */
    threads?: number;
}

/**
 * Loads an engine. Without a source: sinew.wasm beside this file, or sinew-threads.wasm for several threads. Each engine
 * has a memory of its own.
 */
export function load(source?: ModuleSource, options?: LoadOptions): Promise<Engine>;

/**
 * Loads the module whose worlds are of float (`"precision": "float"`), sinew-float.wasm beside this file, for an engine
 * whose worlds are of double. From then on the engine opens both; returns the engine.
 */
export function loadFloat(engine: Engine, source?: ModuleSource): Promise<Engine>;

/** Loads the module that writes files of other programs, sinew-export.wasm beside this file: an engine of its own. */
export function loadExporter(source?: ModuleSource): Promise<Exporter>;

export interface ExportOptions extends OpenOptions {
    /** Length of the film; the scene's own if left out. Of an .obj or .ply without a number in its name: the moment. */
    seconds?: number;
    /** Frames per second, 30 if left out. */
    fps?: number;
    /** Names, of those that are written alone; none: everything. */
    figures?: string[];
    /** By which points may be off between keys: pixels of vectors, millimetres of a .glb. */
    error?: number;
    /** Of vectors, pixels; the scene's own if left out. */
    size?: [number, number];
    /** Of vectors: "none", "#fa0". */
    background?: string;
    /** Of vectors: the figure in the middle. */
    follow?: string;
    /** Of vectors: a line at the bottom. */
    caption?: string;
    /** Is told the share of frames that are done. */
    onProgress?: (share: number) => void;
}

export interface ExportedFile {
    name: string;
    bytes: Uint8Array;
}

export class Exporter {
    readonly engine: Engine;
    /**
     * Steps a scene from its start and writes it. The ending says the format: .glb, .pc2, .mdd, .obj, .ply, .svg (moves),
     * .json (Lottie), .csv or .jsonl (a trace). `notes` are about what the format could not take.
     */
    write(scene: string | object, name: string, options?: ExportOptions): Promise<{ files: ExportedFile[]; notes: string[] }>;
}

/** Loads the module that reads files of other programs, sinew-import.wasm beside this file. */
export function loadImporter(source?: ModuleSource): Promise<Importer>;

export type FileContent = string | ArrayBuffer | ArrayBufferView;

export interface ImportOptions {
    /** Of shapes whose names tell nothing: "solid", "jelly", "cloth", "rope", "collider" or "ignore". */
    role?: string;
    /** Largest distance of a simplified outline from the drawn one, pixels. */
    error?: number;
    /** Length in the scene of a unit of the file. */
    scale?: number;
    /** Files that the imported one may refer to (buffers, tilesets), by name. */
    files?: Record<string, FileContent>;
}

export interface Imported {
    /** The scene, complete. */
    scene: string;
    /** Files that the scene refers to: images (.png) and models (.obj), for the options of `engine.open`. */
    files: ExportedFile[];
    /** Whatever a scene cannot hold, with its place in the file ("12:3"; "" for the whole). */
    notes: { place: string; message: string }[];
}

export class Importer {
    /** The module, which a worker can be given. */
    readonly module: WebAssembly.Module;
    /**
     * Makes a scene of an .svg, .png, .obj, .glb, .gltf, .tmj or Coding Math's .json, by content or else by the ending.
     * Throws SinewError with the place in the file.
     */
    read(name: string, bytes: FileContent, options?: ImportOptions): Promise<Imported>;
}

/** The same functions as properties: `import Sinew from "sinew"; await Sinew.load()`. */
declare const Sinew: { load: typeof load; loadFloat: typeof loadFloat; loadExporter: typeof loadExporter; loadImporter: typeof loadImporter; abi: number; catalogue: typeof catalogue; Canvas2DPainter: typeof Canvas2DPainter };
export default Sinew;

// --- scenes -------------------------------------------------------------------------------------------------------

/** The scenes of the catalogue, in the order of lists. Scene texts are part of the package; nothing is fetched. */
export function catalogue(): Promise<CatalogueScene[]>;

export interface CatalogueScene {
    name: string;               // "ragdoll"
    title: string;              // "Ragdoll"
    about: string;              // a sentence or two
    source: string;             // source of the idea
    category: "basics" | "ropes" | "cloth" | "bodies" | "characters" | "machines" | "other";
    dimension: 2 | 3;
    seconds: number;            // how long it is worth watching
    size: [number, number];     // of the picture that the scene asks for, pixels
    /** Values worth a slider: those the file states. */
    parameters: SceneParameter[];
    /** Modes ("classic") for which the file has settings of its own. Every scene runs in both modes: {overrides: {mode: "classic"}}. */
    modes: string[];
    /** The file. */
    text: string;
    /** Images the scene shows, by name ("sprites/head.png"): files of the package under `images/`. */
    images: Record<string, { width: number; height: number }>;
    /** Texts of OBJ files by name. A scene of the catalogue is thus its own options: engine.open(scene.text, scene). */
    models: Record<string, string>;
}

/** A value of a scene that a form can show. */
export interface SceneParameter {
    path: string;               // as in an override: "figures.bob.height"
    name: string;               // last step of the path in words: "height"
    value: number | string | boolean | number[];
    type: "number" | "integer" | "text" | "truth" | "point";
    unit: string;               // "px", "m/s^2"; may be empty
    low?: number;               // range; absent: without limit
    high?: number;
    choices?: string[];         // of a text
    help: string;
}

export interface OpenOptions {
    /** Name of the file in messages; "scene.json" by default. */
    name?: string;
    /** `path=value` as on the command line: ["solver.substeps=16", "mode=classic"], or an object of the same. */
    overrides?: string[] | Record<string, unknown>;
    /** Sizes of images by the names in the scene. Without any, plain shapes are drawn instead. */
    images?: Record<string, { width: number; height: number }>;
    /** Texts of OBJ files by the names in the scene. */
    models?: Record<string, string>;
}

/** An error in a scene, for its author. */
export interface SceneError {
    line: number;               // from 1
    column: number;             // from 1, in characters
    length: number;             // characters
    path: string;               // JSON pointer: "/figures/0/mass"
    message: string;
    help: string;               // may be empty
    source: string;             // the file, or "<command line>"
    isOverride: boolean;        // true: line and column count in the override
    text: string;               // as the command prints it, with the line and a mark below
}

/** Thrown for a scene with errors. */
export class SceneErrors extends Error {
    errors: SceneError[];
    /** The scene's precision is that of another module: see loadFloat. */
    readonly isOfOtherPrecision: boolean;
}

/** Thrown for anything else: a closed object, an unknown name. */
export class SinewError extends Error {
    status: number;             // a sinew_status of bindings/c/sinew.h
}

/** Values of SinewError.status. */
export const status: {
    readonly ok: 0; readonly badHandle: 1; readonly badId: 2; readonly badScene: 3; readonly badArgument: 4;
    readonly notFound: 5; readonly readOnly: 6; readonly full: 7;
};

// --- engine -------------------------------------------------------------------------------------------------------

export interface Engine {
    readonly version: string;   // of the engine: "0.9.0"
    readonly abi: number;
    readonly simd: string;      // "simd128"
    readonly memory: WebAssembly.Memory;
    /** Threads that share the steps of large worlds. */
    readonly threads: number;

    /** Ends the workers of an engine of several threads, which must not be used any more. */
    stop(): void;

    /** Opens a scene at its start, from JSON text or an object. Throws SceneErrors. */
    open(scene: string | object, options?: OpenOptions): Simulation;
    /**
     * Opens what Simulation.save() gave, here or on another machine: every later hash is that of the simulation that
     * never stopped. `options` has the images and models of its scene. Throws for bytes that no simulation of this
     * version gave.
     */
    load(bytes: Uint8Array, options?: OpenOptions): Simulation;
    /** Opens a scene in the interactive player. Throws SceneErrors. */
    play(scene: string | object, options?: OpenOptions): Player;
    /** The errors of a scene; empty if there are none. */
    check(scene: string | object, options?: OpenOptions): SceneError[];
    /** JSON Schema of scene files, for an editor's completion. */
    schema(): object;
    prefabs(): { name: string; about: string; dimensions: (2 | 3)[]; parameters: SceneParameter[] }[];
    overlays(): { name: string; about: string }[];
    tools(): { name: string; key: string; about: string }[];
    /** Joints of the tool "join". */
    joints(): { name: string; about: string }[];
    actions(): { name: string; key: string; about: string }[];
    /** Kinds of constraints of a dimension, in the order of their numbers. */
    kinds(dimension: 2 | 3): { name: string; particles: number }[];
    /** The compiled module, for `load` in a worker: it is neither fetched nor compiled again. */
    readonly module: WebAssembly.Module;
    /** Bytes of WebAssembly memory. */
    readonly bytes: number;
}

export type Reals = Float32Array | Float64Array;
export type Point = [number, number] | [number, number, number];
/** Ids stay valid while rows move. A name ("bob/head") is accepted wherever an id is. */
export type ParticleId = bigint;
export type ConstraintId = bigint;
export type PinId = bigint;
export type ColliderId = bigint;
export type ForceId = bigint;
export type GrabId = bigint;

export interface Report {
    seconds: number;            // simulated
    steps: number;
    kinetic: number; potential: number; stored: number; // energies
    energyLost: number;         // in impacts, since the start
    stretchMax: number; stretchMean: number;            // of distances, as fractions of rest lengths
    maxSpeed: number;
}

export interface SceneEvent {
    seconds: number;
    /**
     * "torn", "parted", "quarantined", "touched" (a sensor), the phase of a contact that the scene waits for ("begin",
     * "persist", "end", "hit"), or the name of a scene event.
     */
    what: string;
    where: string;              // figure or particle, or the text of a note
    islands: number;            // "parted": number of islands of the figure
    with: string;               // contacts: name of the collider or figure touched
    impulse: number;            // contacts: in the step, or of a hit
}

/** A contact in the last step. A hit is one whose `blow` is above a number of yours, and `blowBefore` was not. */
export interface Contact {
    phase: "begin" | "persist" | "end";
    impulse: number;            // in the last step
    blow: number;               // the same; in the step after the touch began, that of both: a blow may take two
    blowBefore: number;         // in the step before
    /** Of two figures the particle that is pressed hardest, or an end of a link that is. */
    particle: ParticleId;
    other: ParticleId | null;   // of the other figure; null: a collider or a plane is touched
    figure: number | null;      // index; null: a loose particle
    otherFigure: number | null;
    collider: ColliderId | null; // null: a figure or a plane is touched
    colliderName: string;       // as in the scene; may be empty; "bounds": a plane of world.bounds
    /** Where it pressed hardest, on the surface of a collider or between two figures, and its normal, towards `particle`. */
    point: number[];
    normal: number[];
    speed: number;              // of approach along the normal there, before the contact acted
}

/** Controls of a figure of the prefab "character" or "car", in every step until they are changed. */
export interface Controls {
    along?: number;             // -1 to 1: walks, drives, to the left or to the right
    up?: number;                // -1 to 1: climbs; a car in the air lifts its front
    jump?: boolean;             // a character jumps whenever it is on the ground; a car brakes
    hold?: boolean;             // a character reaches for ropes and planks, and holds on
}

export interface Footing {
    onGround: boolean;
    isHolding: boolean;
    figure: number | null;      // the ground's, or the held one's; null: a collider, a plane, or nothing
}

/** A circle or sphere by its radius, or a box by half of its edges, turned by `turn` radians (in 3D about an axis, z by default). */
export type Region =
    | { center: Point; radius: number }
    | { center: Point; half: Point; turn?: number; axis?: Point };

/** Parameters are those of a figure in a scene file: {segments: 20, contact: {figures: true}}. */
export interface FigureSpec {
    name?: string;              // that of the prefab, with a number if it is taken
    position?: Point;
    velocity?: Point;
    turn?: number;              // radians, counter-clockwise; in 3D about z
    [parameter: string]: unknown;
}

export interface ColliderSpec {
    /** Polygons and terrains are of 2D; polygons are convex, corners counter-clockwise; a terrain is solid on its right-hand side.
     *  Meshes and height fields are of 3D. */
    shape: "half_space" | "sphere" | "capsule" | "box" | "polygon" | "terrain" | "mesh" | "height_field";
    name?: string;
    position?: Point;
    turn?: number;              // radians
    axis?: Point;               // 3D: of the turn; z if left out
    half?: Point;               // box: half of its edges; capsule: half of its segment first
    radius?: number;            // sphere, capsule
    points?: Point[];           // polygon, terrain, mesh
    isClosed?: boolean;         // terrain: an edge from the last point to the first
    triangles?: [number, number, number][]; // mesh: numbers of points, counter-clockwise seen from the free side
    heights?: number[][];       // height field: rows follow z, numbers x
    spacing?: number;           // height field: side of a cell
    isSensor?: boolean;         // touched without a push
    bounce?: number;            // share of the approach speed given back, 0 to 1
    friction?: number;          // Coulomb's coefficient
    layers?: number;            // bits; the first if left out
    mask?: number;              // layers that touch it; all if left out
    oneWay?: Point;             // direction of the normals that are solid, in its own frame
    surfaceVelocity?: Point;    // of a belt: the surface runs along itself, in its own frame
}

/** A force field; fields of other kinds are not read. Units and ranges are those of the scene format. */
export interface ForceSpec {
    kind: "gravity" | "drag" | "wind" | "attractor" | "random_push";
    acceleration?: Point;       // gravity
    velocity?: Point;           // wind: of the air
    gust?: Point;               // wind: largest change of the velocity in a gust
    center?: Point;             // attractor
    low?: Point;                // random push: force
    high?: Point;
    strength?: number;          // drag, wind: force / velocity; attractor: acceleration times length^2
    density?: number;           // wind: of the air
    dragCoefficient?: number;   // wind with a density; 1.2 if left out
    gustPeriod?: number;        // wind; 1 second if left out
    gustSize?: number;          // wind: length of a gust
    softness?: number;          // attractor: below this distance like a spring; 0.1 m if left out
    seed?: bigint | number;     // wind, random push
    figure?: string;            // attractor: the only figure pulled
}

export interface RayHit {
    share: number;              // of the way, 0 to 1
    point: number[];
    normal: number[];
    particle: ParticleId | null;
    collider: ColliderId | null;
}

/** A running scene without a pointer. */
export interface Simulation {
    readonly dimension: 2 | 3;
    readonly precision: "float" | "double";
    readonly rate: number;      // steps per second
    readonly seconds: number;   // how long the scene is worth watching
    readonly size: [number, number]; // of its picture, pixels
    readonly yIsDown: boolean;
    readonly particleCount: number;
    readonly constraintCount: number;
    /** Particles asleep: at rest, left out of the steps until they are woken. */
    readonly asleepCount: number;
    /** True for the simulation of a player, which alone may change it. */
    readonly isReadOnly: boolean;
    readonly isClosed: boolean;

    /** Takes steps of the scene's rate. */
    step(count?: number): void;
    /** Steps until so much simulated time has passed since the start. */
    runUntil(seconds: number): void;
    restart(): void;
    /** A copy in the present state, which goes on by itself. */
    copy(): Simulation;
    /** The bytes of the simulation in its present state, for Engine.load(). */
    save(): Uint8Array;
    /** Frees the memory. Also `using`: Symbol.dispose. */
    dispose(): void;
    [Symbol.dispose](): void;

    /** Hash of the state, 16 hexadecimal digits; the same as that of `sinew run --json`. */
    hash(): string;
    report(): Report;
    events(since?: number): SceneEvent[];

    /**
     * Columns of the particles: views of the engine's memory, `dimension` numbers a row (one for masses and radii).
     * Every access gives a view that is valid until the next call; do not keep it.
     */
    readonly positions: Reals;
    readonly previous: Reals;
    readonly velocities: Reals;
    readonly inverseMasses: Reals;
    /** Inverse masses as the constraints see them: 0 while pinned. */
    readonly mobilities: Reals;
    readonly radii: Reals;
    readonly figureIndices: Uint32Array;
    /** Rows of the ends of every distance, two each. */
    readonly ends: Uint32Array;
    /** 1 for every particle asleep, else 0. */
    readonly sleepers: Uint32Array;
    /** Of every distance: force along it, positive when pulling, and error as a fraction of the violated limit. */
    readonly tensions: Float64Array;
    readonly strains: Float64Array;
    /** Rows of the corners of the triangles of filled cloth and skins, three each: an index buffer over `positions`. A patch that a cut has divided is none. */
    readonly triangles: Uint32Array;

    figures(): { index: number; name: string; prefab: string; particles: number; isQuarantined: boolean }[];
    /** Index of a figure. */
    figure(name: string): number;
    /** Rows of the particles of a figure, in their order. */
    rowsOf(figure: number | string): Uint32Array;
    particle(nameOrRow: string | number): ParticleId;
    constraint(name: string): ConstraintId;
    nameOf(particle: ParticleId): string;
    stateOf(particle: ParticleId | string): { position: number[]; velocity: number[]; inverseMass: number; radius: number; figure: number; isAsleep: boolean };
    loadOf(constraint: ConstraintId | string): { measure: number; error: number; strain: number; tension: number };
    constraintsOf(kind: string | number): ConstraintId[];

    /** Lists touches of figures with figures too, from the next step on; those with colliders always are. */
    listContacts(on?: boolean): void;
    /** Contacts of the last step; those that ended in it come last. */
    contacts(): Contact[];

    /** Nearest particle whose surface is within reach; `distance` is negative inside. */
    nearestParticle(point: Point, reach: number): { particle: ParticleId; distance: number } | null;
    /** Nearest link within reach; `t` is the place on it, 0 at its first end and 1 at its second. */
    nearestLink(point: Point, reach: number): { link: ConstraintId; t: number; distance: number } | null;
    /** First particle with a radius, collider, or plane of world.bounds (neither id) that a ray (a sphere with a radius)
     *  meets on its way. */
    castRay(from: Point, to: Point, options?: { radius?: number; mask?: number }): RayHit | null;
    /** What touches a region, in the order of rows. */
    particlesIn(region: Region): ParticleId[];
    linksIn(region: Region): ConstraintId[];

    collider(name: string): ColliderId;
    /** Pose at the end of the next step; what touches the collider is carried along. */
    moveCollider(collider: ColliderId | string, position: Point, turn?: number, axis?: Point): void;

    addCollider(collider: ColliderSpec): ColliderId;
    removeCollider(collider: ColliderId | string): void;

    addForce(force: ForceSpec): ForceId;
    /** Sets what is given of a force, also of one of the scene. */
    setForce(force: ForceId, values: Partial<ForceSpec>): void;
    force(force: ForceId): ForceSpec;
    removeForce(force: ForceId): void;
    /** The world's gravity, then the forces of the scene, then others. */
    forces(): ForceId[];

    /** Builds a prefab; returns the figure's index. Throws SceneErrors for a parameter that is unknown or out of its range. */
    addFigure(prefab: string, figure?: FigureSpec): number;
    /** New values of a figure that was added; it goes on as it moves. Throws for one that would change its form. */
    setFigure(figure: number | string, values: Record<string, unknown>): void;
    /** Removes a figure with its particles. */
    removeFigure(figure: number | string): void;
    /** Without controls the scene's events steer again. */
    steer(figure: number | string, controls?: Controls): void;
    /** Footing of a character after the last step. */
    footing(figure: number | string): Footing;
    addParticle(spec: { position: Point; velocity?: Point; mass?: number; radius?: number }): ParticleId;
    removeParticle(particle: ParticleId | string): void;
    /** `low` and `high` limit the measure; without them the present measure is kept exactly. */
    addConstraint(kind: string | number, particles: (ParticleId | string)[],
        spec?: { low?: number; high?: number; compliance?: number; maxForce?: number; breakingStrain?: number }): ConstraintId;
    removeConstraint(constraint: ConstraintId | string): void;
    setPosition(particle: ParticleId | string, position: Point): void;
    setVelocity(particle: ParticleId | string, velocity: Point): void;
    setMass(particle: ParticleId | string, mass: number): void;
    applyForce(particle: ParticleId | string, force: Point): void;
    applyImpulse(particle: ParticleId | string, impulse: Point): void;
    pin(particle: ParticleId | string): PinId;
    movePin(pin: PinId, target: Point): void;
    unpin(pin: PinId): void;

    /** Grabs what is nearest within `radius`, or a particle; false if nothing movable is there. */
    grab(at: Point | ParticleId | string, radius?: number): boolean;
    drag(to: Point): void;
    letGo(): void;
    /** Movable particle nearest to a way, as from the eye through a pixel; `share` is where on the way. */
    pick(from: Point, to: Point, radius?: number): { particle: ParticleId; share: number } | null;
    /** A grab beside all others: of a second finger. */
    addGrab(particle: ParticleId | string): GrabId;
    moveGrab(grab: GrabId, to: Point): void;
    removeGrab(grab: GrabId): void;
    /** Position of the pointer, for pins that follow it. */
    pointAt(at: Point): void;
    /** Cuts every distance that crosses the line; returns their number. */
    cut(from: Point, to: Point): number;

    /** The scene as a file states it, with the edits of `set`; `save` also has what calls and events have added. */
    sceneText(): string;
    parameters(): SceneParameter[];
    /** Sets one value of the running scene. Throws SceneErrors. */
    set(path: string, value: unknown): void;

    /** The picture through the view that the scene asks for. Valid until the next draw. */
    draw(width?: number, height?: number, overlays?: string[] | number): Picture;
    /** Position of a pixel of the picture in a 2D scene. */
    toScene(pixel: [number, number], width?: number, height?: number): Point;
    /** Pixel of a position. */
    toPixel(position: Point, width?: number, height?: number): [number, number];
}

// --- picture ------------------------------------------------------------------------------------------------------

export const Shape: {
    readonly polyline: 0; readonly loop: 1; readonly disc: 2; readonly polygon: 3;
    readonly image: 4; readonly text: 5; readonly pane: 6;
};

/** A display list in pixels: x right, y down. Items are painted in order. Typed arrays are views of the engine's memory. */
export interface Picture {
    readonly width: number;
    readonly height: number;
    /** Red, green, blue, alpha: sRGB, straight alpha, 0 to 1. */
    readonly background: [number, number, number, number];
    /** x, y of every point. */
    readonly points: Float32Array;
    readonly length: number;        // number of items
    /** Ten 32-bit words an item: shape, first point, count, width (float), red, green, blue, alpha (floats), number, across. */
    readonly words: Uint32Array;
    readonly floats: Float32Array;  // the same memory
    /** Texts of items of shape `text`, by `number`. */
    readonly texts: string[];
    /** Names of images, by `number`. */
    readonly images: string[];
    item(index: number): PictureItem;
    [Symbol.iterator](): Iterator<PictureItem>;
    /** A copy that outlives the next draw and can be posted to another thread. */
    copy(): Picture;
}

export interface PictureItem {
    shape: number;                  // a value of Shape
    points: Float32Array;           // x, y, ...
    width: number;                  // pixels: of a stroke, of a disc, of letters
    color: [number, number, number, number];
    number: number;                 // of the image or text
    across: number;                 // points in a row of an image's grid
}

export interface Painter {
    paint(picture: Picture): void;
    /** Images by the names in the scene. */
    setImage(name: string, image: CanvasImageSource): void;
    dispose(): void;
}

/** Paints pictures with a 2D context: of a canvas, an OffscreenCanvas, or anything with the same methods. */
export class Canvas2DPainter implements Painter {
    constructor(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D, options?: { font?: string });
    paint(picture: Picture): void;
    setImage(name: string, image: CanvasImageSource): void;
    dispose(): void;
}

/** Paints pictures with WebGL2: strokes and discs as antialiased quads. `preserveDrawingBuffer` for screenshots. */
export class WebGL2Painter implements Painter {
    constructor(canvas: HTMLCanvasElement | OffscreenCanvas, options?: { font?: string; preserveDrawingBuffer?: boolean });
    paint(picture: Picture): void;
    setImage(name: string, image: CanvasImageSource): void;
    dispose(): void;
}

// --- player -------------------------------------------------------------------------------------------------------

export interface PlayerState {
    step: number; firstStep: number; endStep: number; // of the timeline: now, earliest and latest restorable
    timeScale: number;          // simulated seconds per real second
    share: number;              // of the step in progress
    isPaused: boolean;
    panes: number;              // 2 in a split view: classic and physical
    isEdited: boolean;
    isHolding: boolean;
    overlays: string[];
    tool: string;
    theme: "light" | "dark";
    hovered: string;            // name of the particle under the pointer; may be empty
    selected: string;
    message: string;            // a line about the last action
    undo: string;               // name of the edit that undo would take back; empty: none
    redo: string;
}

export type PlayerEvent = { what: string } & Record<string, unknown>;
export type Button = "left" | "middle" | "right";

/** The interactive player of the window: clock, tools, camera, undo, timeline. */
export interface Player {
    /** The running scene of the pane, for reading. */
    readonly simulation: Simulation;
    pane(index: number): Simulation;
    readonly isClosed: boolean;
    dispose(): void;
    [Symbol.dispose](): void;

    /** Opens another scene; throws SceneErrors and keeps the old one. */
    open(scene: string | object, options?: OpenOptions): void;
    /** Continues as an edited scene: figures that are the same in both keep their state. Can be undone. */
    become(scene: string | object, options?: OpenOptions): void;

    /** Size of the picture in pixels, and pixels per nominal pixel (devicePixelRatio). */
    resize(width: number, height: number, density?: number): void;
    /** Advances real time, in seconds, and takes the steps due. Negative times count as 0. */
    advance(seconds: number): void;
    draw(): Picture;

    // input, in pixels of the picture
    pointerMove(x: number, y: number): void;
    pointerDown(button?: Button): void;
    pointerUp(button?: Button): void;
    pointerLeave(): void;
    /** Notches of the wheel, positive away from the user. */
    wheel(notches: number): void;
    pinch(dx: number, dy: number, factor: number): void;
    touch(finger: number, phase: "down" | "move" | "up", x: number, y: number): void;
    /** A key of the window: "p", "[", "escape", "ctrl+z", "shift". */
    key(name: string, isDown?: boolean): void;

    pan(dx: number, dy: number): void;
    orbit(dx: number, dy: number): void;
    zoom(factor: number): void;

    /** An action by its name in engine.actions(): "pause", "step", "back", "restart", "undo", "gravity", "split"... */
    do(action: string): void;
    pause(on?: boolean): void;
    step(): void;
    stepBack(): void;
    restart(): void;
    undo(): void;
    redo(): void;
    goTo(step: number): void;
    setTimeScale(scale: number): void;
    setTool(name: string): void;
    /** Prefab of the tool "spawn". */
    setPrefab(name: string, parameters?: object): void;
    /** Joint of the tool "join": a name in engine.joints(). */
    setJoint(name: string): void;
    setOverlays(overlays: string[] | number): void;
    /** "light", "dark", or "" for the scene's own. */
    setTheme(theme: string): void;

    parameters(): SceneParameter[];
    /** Sets one value of the scene; `goesOn` merges with the preceding edit of the same path. Throws SinewError. */
    set(path: string, value: unknown, goesOn?: boolean): void;
    sceneText(): string;
    hash(): string;
    state(): PlayerState;
    /** Takes all events since the last call. */
    events(): PlayerEvent[];
}
