// Textures of a WebGL2 painter: images of the scene, and lines of text drawn with a 2D context.

const usualFont = '"Inter", "DejaVu Sans", system-ui, sans-serif';
const textRim = 0.25; // of the letters' height, both sides together
const mostTexts = 256;

function blank(width, height) {
    if (typeof OffscreenCanvas !== "undefined") return new OffscreenCanvas(width, height);
    return Object.assign(document.createElement("canvas"), { width, height });
}

function css([red, green, blue, alpha]) {
    return `rgba(${red * 255}, ${green * 255}, ${blue * 255}, ${alpha})`;
}

export class Sprites {
    constructor(gl, font = usualFont) {
        this.gl = gl;
        this.font = font;
        this.images = new Map();
        this.texts = new Map(); // in order of last use
        this.measuring = blank(1, 1).getContext("2d");
    }

    setImage(name, image) {
        const known = this.images.get(name);
        if (known) this.gl.deleteTexture(known);
        this.images.set(name, this.uploaded(image, true));
    }

    /** Null for an image that was not given. */
    imageCalled(name) {
        return this.images.get(name) ?? null;
    }

    textOf(text, height, color, paper) {
        if (!text) return null;
        const key = [text, height, css(color), css(paper)].join("\n");
        const known = this.texts.get(key) ?? this.written(text, height, color, paper);
        this.texts.delete(key);
        this.texts.set(key, known);
        return known;
    }

    written(text, height, color, paper) {
        this.measuring.font = `${height}px ${this.font}`;
        const wide = Math.ceil(this.measuring.measureText(text).width + height * textRim + 4);
        const high = Math.ceil(height * 1.6 + 4);
        const canvas = blank(wide, high);
        const context = canvas.getContext("2d");
        context.font = this.measuring.font;
        context.textAlign = "center";
        context.textBaseline = "middle";
        context.lineJoin = "round";
        context.lineWidth = height * textRim;
        context.strokeStyle = css(paper);
        context.fillStyle = css(color);
        context.strokeText(text, wide / 2, high / 2);
        context.fillText(text, wide / 2, high / 2);
        return { texture: this.uploaded(canvas, false), width: wide, height: high };
    }

    uploaded(image, isShrunk) {
        const { gl } = this;
        const texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, isShrunk ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
        if (isShrunk) gl.generateMipmap(gl.TEXTURE_2D);
        return texture;
    }

    /** Texts beyond the number kept, least recently used first. */
    forgetUnused() {
        for (const [key, { texture }] of this.texts) {
            if (this.texts.size <= mostTexts) return;
            this.gl.deleteTexture(texture);
            this.texts.delete(key);
        }
    }

    dispose() {
        for (const texture of this.images.values()) this.gl.deleteTexture(texture);
        for (const { texture } of this.texts.values()) this.gl.deleteTexture(texture);
        this.images.clear();
        this.texts.clear();
    }
}
