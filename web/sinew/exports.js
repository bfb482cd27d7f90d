// Exports of every entry of the package, beside its ways to load.
export { abi } from "./engine.js";
export { SceneErrors, SinewError, status } from "./errors.js";
export { Exporter } from "./export.js";
export { Importer } from "./import.js";
export { Canvas2DPainter } from "./painters/canvas2d.js";
export { WebGL2Painter } from "./painters/webgl2.js";
export { PictureCopy, Shape } from "./picture.js";
