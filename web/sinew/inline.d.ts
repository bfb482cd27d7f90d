// The package with its module in one file, for worlds of double on one thread: the other ways to load need a source.
import type { Canvas2DPainter, load, loadExporter, loadFloat, loadImporter } from "./index.js";
export type * from "./index.js";
export {
    abi, Canvas2DPainter, Exporter, Importer, load, loadExporter, loadFloat, loadImporter, SceneErrors, Shape, SinewError, status, WebGL2Painter,
} from "./index.js";
declare const Sinew: {
    load: typeof load; loadFloat: typeof loadFloat; loadExporter: typeof loadExporter; loadImporter: typeof loadImporter; abi: number; Canvas2DPainter: typeof Canvas2DPainter;
};
export default Sinew;
