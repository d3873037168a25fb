// The triangles of a scene for the GPU.

import { BufferAttribute, BufferGeometry, Sphere } from "three";

/** The state of an organ, in the highest byte of its colour. */
const kWhole = 255;
const kMarked = 128;
const kNumber = 0xffffff;

/**
 * The shape of a scene, from the bytes that the program writes
 * (docs/develop/decisions/viewer-server.md): areas, heights and numbers of triangles of `count`
 * organs; vertices; corners, each the number of a vertex; and the first vertex of each organ.
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

/** A step that visits all of `count` indices once, each far from the last (golden section). */
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
 * has triangles from everywhere. It is drawn if there is no time for all triangles.
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

/** The triangles, each in the tint of its organ: its colour, and its state in the highest byte; 0 hides it. */
class TintedGeometry {
  constructor(shape, position, index) {
    this.first = shape.first;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", position);
    this.geometry.setAttribute("tint", new BufferAttribute(new Uint32Array(shape.places.length / 3), 1));
    this.geometry.setIndex(index);
    this.geometry.boundingSphere = new Sphere(); // unused, and slow to compute
    this.tint = this.geometry.attributes.tint;
    this.isAllOld = true; // whether all tints on the GPU are outdated
    this.tint.onUpload(() => (this.isAllOld = false));
  }

  /** Sets the tints of all organs. */
  write(tintOf) {
    for (let organ = 0; organ + 1 < this.first.length; ++organ) {
      this.tint.array.fill(tintOf(organ), this.first[organ], this.first[organ + 1]);
    }
    this.isAllOld = true;
    this.tint.clearUpdateRanges();
    this.tint.needsUpdate = true;
  }

  /** Sets the tints of a few organs. */
  rewrite(organs, tintOf) {
    const kFew = 16; // maximum number of separate uploads
    this.isAllOld ||= organs.length > kFew;
    if (this.isAllOld) {
      this.tint.clearUpdateRanges();
    }
    for (const organ of organs) {
      const [from, to] = [this.first[organ], this.first[organ + 1]];
      this.tint.array.fill(tintOf(organ), from, to);
      if (!this.isAllOld && to > from) {
        this.tint.addUpdateRange(from, to - from);
      }
    }
    if (organs.length > 0) {
      this.tint.needsUpdate = true;
    }
  }
}

/** The organs in the colours of their light, in those of the plant, and as numbers, for picking. */
export class OrganGeometry {
  constructor(shape) {
    const position = new BufferAttribute(shape.places, 3);
    const index = new BufferAttribute(spread(shape.corners), 1);
    this.make = () => new TintedGeometry(shape, position, index);
    this.colored = this.make();
    this.numbered = this.make();
    this.plant = null;
    this.tints = new Uint32Array(shape.first.length - 1);
    this.marked = [];
    this.areNumbersOld = true;
  }

  dispose() {
    [this.colored, this.numbered, this.plant].forEach((each) => each?.geometry.dispose());
  }

  /** @param colors  one per organ, red in the lowest of three bytes; negative hides it */
  paint(colors) {
    colors.forEach((color, organ) => {
      this.tints[organ] = color < 0 ? 0 : (kWhole << 24) | color;
    });
    this.marked.forEach((organ) => this.#setMark(organ, kMarked));
    this.colored.write((organ) => this.tints[organ]);
    this.plant?.write((organ) => this.#plantTint(organ));
    this.areNumbersOld = true;
  }

  /** @param colors  one per organ, for the plant without light; null if it is not shown */
  paintPlant(colors) {
    this.plantColors = colors;
    this.plant = colors && (this.plant ?? this.make());
    this.plant?.write((organ) => this.#plantTint(organ));
  }

  /** Highlights organs. */
  mark(organs) {
    const changed = [...this.marked, ...organs];
    this.marked.forEach((organ) => this.#setMark(organ, kWhole));
    this.marked = organs;
    this.marked.forEach((organ) => this.#setMark(organ, kMarked));
    this.colored.rewrite(changed, (organ) => this.tints[organ]);
    this.plant?.rewrite(changed, (organ) => this.#plantTint(organ));
  }

  /** Organs' numbers, from 1, as colours. */
  numbers() {
    if (this.areNumbersOld) {
      this.numbered.write((organ) => (this.tints[organ] === 0 ? 0 : (kWhole << 24) | (organ + 1)));
      this.areNumbersOld = false;
    }
    return this.numbered;
  }

  #plantTint(organ) {
    return this.tints[organ] === 0 ? 0 : (this.tints[organ] & ~kNumber) | this.plantColors[organ];
  }

  #setMark(organ, mark) {
    if (this.tints[organ] !== 0) {
      this.tints[organ] = (mark << 24) | (this.tints[organ] & kNumber);
    }
  }
}
