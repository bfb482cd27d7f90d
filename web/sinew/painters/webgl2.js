import { Shape } from "../picture.js";
import { Geometry } from "./geometry.js";
import { isFinitePath } from "./canvas2d.js";
import { Sprites } from "./sprites.js";

const vertexText = `#version 300 es
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 local;
layout(location = 2) in vec2 shape;
layout(location = 3) in vec4 color;
uniform vec2 size;
out vec2 at;
flat out vec2 form;
out vec4 paint;
void main() {
    at = local;
    form = shape;
    paint = color;
    gl_Position = vec4(place.x / size.x * 2.0 - 1.0, 1.0 - place.y / size.y * 2.0, 0.0, 1.0);
}`;

// Vertex colours have straight alpha; images and the output are premultiplied. Texture reads cost the most in software,
// where both sides of a branch are evaluated: there is a program with and one without them.
const fragmentText = (isTextured) => `#version 300 es
precision highp float;
in vec2 at;
flat in vec2 form;
in vec4 paint;
uniform sampler2D image;
out vec4 result;
void main() {
    if (form.x >= 0.0) {
        float away = length(vec2(max(abs(at.x) - form.x, 0.0), at.y)) - form.y;
        float cover = clamp(0.5 - away, 0.0, 1.0) * paint.a;
        result = vec4(paint.rgb * cover, cover);
    } else if (form.x < -1.5) {
        ${isTextured ? `vec4 texel = texture(image, at);
        result = mix(texel, vec4(paint.rgb * texel.a, texel.a), paint.a);` : "result = vec4(0.0);"}
    } else {
        result = vec4(paint.rgb * paint.a, paint.a);
    }
}`;

/** Paints pictures with WebGL2: strokes and discs as quads with a distance field, polygons as triangles with a faded rim. */
export class WebGL2Painter {
    constructor(canvas, { font, preserveDrawingBuffer = false } = {}) {
        this.canvas = canvas;
        const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, preserveDrawingBuffer });
        if (!gl) throw new Error("this browser has no WebGL2");
        this.gl = gl;
        this.geometry = new Geometry();
        this.sprites = new Sprites(gl, font);
        this.programs = [this.linked(false), this.linked(true)];
        this.makeBuffers();
    }

    setImage(name, image) {
        this.sprites.setImage(name, image);
    }

    dispose() {
        const { gl } = this;
        this.sprites.dispose();
        for (const program of this.programs) gl.deleteProgram(program.name);
        gl.deleteBuffer(this.vertices);
        gl.deleteBuffer(this.indices);
        gl.deleteVertexArray(this.array);
    }

    paint(picture) {
        this.gather(picture);
        this.upload();
        this.begin(picture);
        for (const batch of this.geometry.batches) this.draw(batch, picture);
        this.gl.disable(this.gl.SCISSOR_TEST);
        this.sprites.forgetUnused();
    }

    // --- geometry -------------------------------------------------------------------------------------------------

    gather(picture) {
        const { geometry, sprites } = this;
        geometry.clear();
        this.paper = picture.background;
        for (const item of picture) {
            if (!isFinitePath(item.points)) continue;
            const width = item.width >= 1 ? item.width : 1;
            if (item.shape === Shape.image) geometry.addImage(item, sprites.imageCalled(picture.images[item.number]));
            else if (item.color[3] > 0) this.gatherItem(picture, item, width);
        }
    }

    gatherItem(picture, item, width) {
        const { geometry } = this;
        const { points, color } = item;
        switch (item.shape) {
        case Shape.disc: return geometry.addLine(points[0], points[1], points[0], points[1], width, color);
        case Shape.polygon: return geometry.addPolygon(points, color);
        case Shape.text: return geometry.addSprite(points, this.sprites.textOf(picture.texts[item.number], width, color, this.paper));
        case Shape.pane:
            this.paper = color;
            return geometry.beginPane(points, color);
        default: return geometry.addStroke(points, item.shape === Shape.loop, width, color);
        }
    }

    // --- WebGL ----------------------------------------------------------------------------------------------------

    compiled(stage, text) {
        const { gl } = this;
        const shader = gl.createShader(stage);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
        return shader;
    }

    linked(isTextured) {
        const { gl } = this;
        const name = gl.createProgram();
        gl.attachShader(name, this.compiled(gl.VERTEX_SHADER, vertexText));
        gl.attachShader(name, this.compiled(gl.FRAGMENT_SHADER, fragmentText(isTextured)));
        gl.linkProgram(name);
        return { name, size: gl.getUniformLocation(name, "size") };
    }

    /** Vertices of 28 bytes: place, local coordinates, shape, colour. */
    makeBuffers() {
        const { gl } = this;
        this.array = gl.createVertexArray();
        this.vertices = gl.createBuffer();
        this.indices = gl.createBuffer();
        gl.bindVertexArray(this.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.vertices);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices);
        for (let i = 0; i < 3; ++i) gl.vertexAttribPointer(i, 2, gl.FLOAT, false, 28, 8 * i);
        gl.vertexAttribPointer(3, 4, gl.UNSIGNED_BYTE, true, 28, 24);
        for (let i = 0; i < 4; ++i) gl.enableVertexAttribArray(i);
    }

    upload() {
        const { gl, geometry } = this;
        gl.bindVertexArray(this.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.vertices);
        gl.bufferData(gl.ARRAY_BUFFER, geometry.vertexBytes(), gl.STREAM_DRAW);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, geometry.indexList(), gl.STREAM_DRAW);
    }

    begin({ width, height, background }) {
        const { gl } = this;
        gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
        this.scale = [gl.drawingBufferWidth / width, gl.drawingBufferHeight / height];
        gl.disable(gl.SCISSOR_TEST);
        gl.clearColor(background[0], background[1], background[2], 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        gl.disable(gl.DEPTH_TEST);
        gl.disable(gl.CULL_FACE);
        gl.activeTexture(gl.TEXTURE0);
    }

    draw({ texture, first, count, pane }, { width, height }) {
        if (count === 0) return;
        const { gl } = this;
        const program = this.programs[texture ? 1 : 0];
        gl.useProgram(program.name);
        gl.uniform2f(program.size, width, height);
        if (pane) {
            const [x, y, wide, high] = pane;
            gl.enable(gl.SCISSOR_TEST);
            gl.scissor(x * this.scale[0], (height - y - high) * this.scale[1], wide * this.scale[0], high * this.scale[1]);
        }
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * first);
    }
}
