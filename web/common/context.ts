type Canvas = HTMLCanvasElement | OffscreenCanvas;
type Context<C extends Canvas> = C extends HTMLCanvasElement ? CanvasRenderingContext2D : OffscreenCanvasRenderingContext2D;

/** A 2D context that paints by the processor where the browser has only a software GL: paths are twenty to a hundred times
 * as fast there as through the GPU's emulation. */
export function context2d<C extends Canvas>(canvas: C): Context<C> {
    const context = canvas.getContext("2d", { alpha: false, willReadFrequently: isSoftware() });
    if (!context) throw new Error("This browser has no 2D canvas.");
    smooth(context as Context<C>);
    return context as Context<C>;
}

/** Images that are drawn smaller keep their details; to be called again after a canvas has another size. */
export function smooth(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D): void {
    context.imageSmoothingQuality = "medium";
}

let known: boolean | null = null;

function isSoftware(): boolean {
    known ??= /^$|swiftshader|llvmpipe|softpipe|software|basic render/i.test(rendererName());
    return known;
}

/** Name of what executes WebGL; empty without WebGL. */
function rendererName(): string {
    const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
    if (!gl) return "";
    const extension = gl.getExtension("WEBGL_debug_renderer_info");
    const name = String(gl.getParameter(extension ? extension.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    gl.getExtension("WEBGL_lose_context")?.loseContext();
    return name;
}
