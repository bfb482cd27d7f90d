import { item as itemLayout, picture as pictureLayout } from "./layout.js";

/** Shapes of items: numbers of sinew_shape in bindings/c/sinew.h. */
export const Shape = Object.freeze({ polyline: 0, loop: 1, disc: 2, polygon: 3, image: 4, text: 5, pane: 6 });

/** 32-bit words of an item. */
export const itemWords = itemLayout.size / 4;

/** Words of the fields of an item. */
const word = Object.fromEntries(itemLayout.fields.map(([name, from]) => [name, from / 4]));

class Base {
    get length() {
        return this.words.length / itemWords;
    }

    item(index) {
        const at = index * itemWords;
        const { words, floats, points } = this;
        const first = words[at + word.first], color = at + word.color;
        return {
            shape: words[at + word.shape], points: points.subarray(2 * first, 2 * (first + words[at + word.count])), width: floats[at + word.width],
            color: [floats[color], floats[color + 1], floats[color + 2], floats[color + 3]], number: words[at + word.number],
            across: words[at + word.across],
        };
    }

    *[Symbol.iterator]() {
        for (let i = 0; i < this.length; ++i) yield this.item(i);
    }
}

/** A display list in the engine's memory, valid until the next draw. Memory may grow meanwhile: arrays are made on demand. */
export class Picture extends Base {
    constructor(engine, at, handle, textName, imageName) {
        super();
        const { data } = engine;
        this.engine = engine;
        const { width, height, background, textCount, imageCount, ...places } = data.read(pictureLayout, at);
        Object.assign(this, { width, height, background, places });
        const list = (count, name) => Array.from({ length: count }, (_, i) => {
            engine.call(name, handle, i, data.result);
            return data.textFrom(data.result);
        });
        this.texts = list(textCount, textName);
        this.images = list(imageCount, imageName);
    }

    array(Numbers, address, count) {
        return count === 0 ? new Numbers(0) : new Numbers(this.engine.data.buffer, address, count);
    }

    get points() {
        if (this.madePoints?.buffer !== this.engine.data.buffer)
            this.madePoints = this.array(Float32Array, this.places.points, 2 * this.places.pointCount);
        return this.madePoints;
    }

    get words() {
        if (this.madeWords?.buffer !== this.engine.data.buffer)
            this.madeWords = this.array(Uint32Array, this.places.items, itemWords * this.places.itemCount);
        return this.madeWords;
    }

    get floats() {
        if (this.madeFloats?.buffer !== this.engine.data.buffer)
            this.madeFloats = this.array(Float32Array, this.places.items, itemWords * this.places.itemCount);
        return this.madeFloats;
    }

    copy() {
        return new PictureCopy(this);
    }
}

/** A display list with memory of its own. */
export class PictureCopy extends Base {
    constructor({ width, height, background, points, words, texts, images }) {
        super();
        Object.assign(this, { width, height, background: [...background], texts: [...texts], images: [...images] });
        this.points = points.slice();
        this.words = words.slice();
        this.floats = new Float32Array(this.words.buffer);
    }

    copy() {
        return new PictureCopy(this);
    }
}
