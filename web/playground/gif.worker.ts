import { applyPalette, GIFEncoder, quantize } from "gifenc";

interface Frame {
    pixels: ArrayBuffer;
    width: number;
    height: number;
    delay: number;
}

const encoder = GIFEncoder();

self.addEventListener("message", ({ data }: MessageEvent<Frame | "end">) => {
    if (data === "end") {
        encoder.finish();
        const bytes = encoder.bytes();
        self.postMessage(bytes.buffer, { transfer: [bytes.buffer] });
        return;
    }
    const pixels = new Uint8ClampedArray(data.pixels);
    const palette = quantize(pixels, 128);
    encoder.writeFrame(applyPalette(pixels, palette), data.width, data.height, { palette, delay: data.delay });
    self.postMessage("frame");
});
