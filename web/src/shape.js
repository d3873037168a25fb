// The triangles of a scene as the graphics take them.

import { BufferAttribute, BufferGeometry } from "three";

/** What is told of an organ, in the highest byte of its colour. */
const kWhole = 255;
const kMarked = 128;
const kNumber = 0xffffff;

/**
 * The shape of a scene, of the bytes that the program writes
 * (docs/develop/decisions/window-server.md): areas, heights and numbers of triangles of `count`
 * organs; places; corners, each the number of a place; and the first place of each organ.
 */
export function readShape(bytes, count) {
  const areas = new Float32Array(bytes, 0, count);
  const heights = new Float32Array(bytes, 4 * count, count);
  const triangles = new Uint32Array(bytes, 8 * count, count);
  const total = triangles.reduce((sum, n) => sum + n, 0);
  const size = (bytes.byteLength - 12 * count - 3 * total) / 4;
  const places = new Float32Array(bytes, 12 * count, size);
  const backward = new Uint8Array(bytes, 12 * count + 4 * size, 3 * total);
  const corners = new Uint32Array(3 * total);
  const first = new Uint32Array(count + 1);
  let corner = 0;
  let next = 0;
  for (let organ = 0; organ < count; ++organ) {
    for (const end = corner + 3 * triangles[organ]; corner < end; ++corner) {
      const back = backward[corner];
      corners[corner] = back === 0 ? next++ : next - back;
    }
    first[organ + 1] = next;
  }
  return { areas, heights, triangles: total, places, corners, first };
}

/** A step that goes through all of `count` places once, far from the last at each (golden section). */
function farStep(count) {
  const divisor = (a, b) => (b === 0 ? a : divisor(b, a % b));
  let step = Math.max(1, Math.round(count * 0.618));
  while (divisor(count, step) !== 1) {
    ++step;
  }
  return step;
}

/**
 * Corners in another order of triangles: blocks of neighbours, such that any first part of the list
 * has triangles from everywhere. It is what is drawn where there is no time for all.
 */
function spread(corners) {
  const kBlock = 3 * 64;
  const blocks = Math.floor(corners.length / kBlock);
  const result = new Uint32Array(corners.length);
  const step = farStep(blocks);
  for (let i = 0, from = 0; i < blocks; ++i, from = (from + step) % blocks) {
    result.set(corners.subarray(from * kBlock, (from + 1) * kBlock), i * kBlock);
  }
  result.set(corners.subarray(blocks * kBlock), blocks * kBlock);
  return result;
}

/** Places, colours of organs, and their numbers for the picture that tells what is pointed at. */
export class OrganGeometry {
  constructor(shape) {
    this.shape = shape;
    const position = new BufferAttribute(shape.places, 3);
    const index = new BufferAttribute(spread(shape.corners), 1);
    const make = () => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", position);
      geometry.setAttribute("tint", new BufferAttribute(new Uint32Array(shape.places.length / 3), 1));
      geometry.setIndex(index);
      return geometry;
    };
    this.colored = make();
    this.numbered = make();
    this.tints = new Uint32Array(shape.first.length - 1);
    this.marked = [];
    this.areNumbersOld = true;
    this.isAllOld = true; // of what the graphics hold of colours
    this.colored.attributes.tint.onUpload(() => (this.isAllOld = false));
  }

  dispose() {
    this.colored.dispose();
    this.numbered.dispose();
  }

  /** @param colors  of each organ, red in the lowest of three bytes; negative hides it */
  paint(colors) {
    colors.forEach((color, organ) => {
      this.tints[organ] = color < 0 ? 0 : (kWhole << 24) | color;
    });
    this.marked.forEach((organ) => this.#setMark(organ, kMarked));
    this.#write(this.colored, (organ) => this.tints[organ]);
    this.areNumbersOld = true;
    this.isAllOld = true;
  }

  /** Sets these organs apart from all others. */
  mark(organs) {
    const changed = [...this.marked, ...organs];
    this.marked.forEach((organ) => this.#setMark(organ, kWhole));
    this.marked = organs;
    this.marked.forEach((organ) => this.#setMark(organ, kMarked));
    const { first } = this.shape;
    const { tint } = this.colored.attributes;
    const kFew = 16; // parts that are sent by themselves
    this.isAllOld ||= changed.length > kFew;
    if (this.isAllOld) {
      tint.clearUpdateRanges();
    }
    for (const organ of changed) {
      tint.array.fill(this.tints[organ], first[organ], first[organ + 1]);
      if (!this.isAllOld && first[organ + 1] > first[organ]) {
        tint.addUpdateRange(first[organ], first[organ + 1] - first[organ]);
      }
    }
    if (changed.length > 0) {
      tint.needsUpdate = true;
    }
  }

  /** Organs' numbers, from 1, as colours. */
  numbers() {
    if (this.areNumbersOld) {
      this.#write(this.numbered, (organ) => (this.tints[organ] === 0 ? 0 : (kWhole << 24) | (organ + 1)));
      this.areNumbersOld = false;
    }
    return this.numbered;
  }

  #setMark(organ, mark) {
    if (this.tints[organ] !== 0) {
      this.tints[organ] = (mark << 24) | (this.tints[organ] & kNumber);
    }
  }

  #write(geometry, tintOf) {
    const { first } = this.shape;
    const { tint } = geometry.attributes;
    for (let organ = 0; organ + 1 < first.length; ++organ) {
      tint.array.fill(tintOf(organ), first[organ], first[organ + 1]);
    }
    tint.clearUpdateRanges();
    tint.needsUpdate = true;
  }
}
