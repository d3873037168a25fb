// The area of organs in layers of height: large leaves and stems span many.

import { ticks } from "./numbers.js";

const kLayers = 15; // about

/** The part of a triangle below a height, from those of its corners, a <= b <= c. */
export function partBelow(height, a, b, c) {
  if (height <= a) {
    return 0;
  }
  if (height >= c) {
    return 1;
  }
  return height <= b ? (height - a) ** 2 / ((b - a) * (c - a)) : 1 - (c - height) ** 2 / ((c - b) * (c - a));
}

/** The lowest and the highest point of each organ: {lows, highs}. @param middle  the height of 0 in the shape */
function spansOf({ vertices, first, counts }, middle) {
  const lows = new Float64Array(counts.length).fill(Infinity);
  const highs = new Float64Array(counts.length).fill(-Infinity);
  for (let organ = 0; organ < counts.length; ++organ) {
    for (let i = 3 * first[organ] + 2; i < 3 * first[organ + 1]; i += 3) {
      lows[organ] = Math.min(lows[organ], vertices[i] + middle);
      highs[organ] = Math.max(highs[organ], vertices[i] + middle);
    }
  }
  return { lows, highs };
}

/** Limits of layers of equal, round thickness that hold all heights; a layer is without its upper limit. */
export function roundLimits(low, high) {
  if (!(high > low)) {
    const half = 0.1 * Math.abs(low) || 0.5;
    return [low - half, low + half];
  }
  const thick = ticks(0, high - low, kLayers)[1];
  const from = Math.floor(low / thick);
  return Array.from({ length: Math.floor(high / thick) + 2 - from }, (_, k) => Number(((from + k) * thick).toPrecision(12)));
}

/** The layer of a height. */
function layerOf(height, limits) {
  const last = limits.length - 2;
  let layer = Math.min(last, Math.max(0, Math.floor((height - limits[0]) / (limits[1] - limits[0]))));
  while (layer < last && height >= limits[layer + 1]) {
    ++layer;
  }
  while (layer > 0 && height < limits[layer]) {
    --layer;
  }
  return layer;
}

/** Adds the area of a triangle to the layers that it spans. @param row  index of the lowest layer of its organ */
function addTriangle(sums, row, area, [x, y, z], limits) {
  const a = Math.min(x, y, z);
  const b = Math.max(Math.min(x, y), Math.min(Math.max(x, y), z));
  const c = Math.max(x, y, z);
  const last = layerOf(c, limits);
  let below = 0;
  for (let layer = layerOf(a, limits); layer < last; ++layer) {
    const now = partBelow(limits[layer + 1], a, b, c);
    sums[row + layer] += area * (now - below);
    below = now;
  }
  sums[row + last] += area * (1 - below);
}

/** The area of each organ in each layer, organ by organ: together its own area. */
function sharedAreas({ vertices, corners, counts, areas }, limits, middle) {
  const count = limits.length - 1;
  const sums = new Float32Array(counts.length * count);
  for (let organ = 0, corner = 0; organ < counts.length; ++organ) {
    const row = organ * count;
    let whole = 0;
    for (const end = corner + 3 * counts[organ]; corner < end; corner += 3) {
      const [p, q, r] = [3 * corners[corner], 3 * corners[corner + 1], 3 * corners[corner + 2]];
      const side = (to, k) => vertices[to + k] - vertices[p + k];
      const cross = (k, l) => side(q, k) * side(r, l) - side(q, l) * side(r, k);
      const area = Math.sqrt(cross(0, 1) ** 2 + cross(1, 2) ** 2 + cross(2, 0) ** 2) / 2;
      addTriangle(sums, row, area, [vertices[p + 2] + middle, vertices[q + 2] + middle, vertices[r + 2] + middle], limits);
      whole += area;
    }
    for (let layer = row; layer < row + count && whole > 0; ++layer) {
      sums[layer] *= areas[organ] / whole;
    }
  }
  return sums;
}

/** The areas of the organs of a scene in layers, computed when they are asked for. */
export class LayerAreas {
  /** @param shape  see readShape  @param middle  the height of 0 in the shape */
  constructor(shape, middle) {
    Object.assign(this, { shape, middle, limits: [] });
  }

  get spans() {
    this.known ??= spansOf(this.shape, this.middle);
    return this.known;
  }

  /** Whether an organ has a part in a layer. */
  reaches(organ, [from, to]) {
    const { lows: { [organ]: low }, highs: { [organ]: high } } = this.spans;
    return low < to && (high > from || low >= from);
  }

  /**
   * Round layers of some organs.
   * @param isIn  whether an organ is one of them
   * @returns {limits, areas}: limits of layers from the lowest up, and areas of all organs, row by row; null without such organs
   */
  of(isIn) {
    const { lows, highs } = this.spans;
    let [low, high] = [Infinity, -Infinity];
    for (let organ = 0; organ < lows.length; ++organ) {
      if (isIn(organ)) {
        low = Math.min(low, lows[organ]);
        high = Math.max(high, highs[organ]);
      }
    }
    if (!(high >= low)) {
      return null;
    }
    const limits = roundLimits(low, high);
    if (limits.join() !== this.limits.join()) {
      Object.assign(this, { limits, areas: sharedAreas(this.shape, limits, this.middle) });
    }
    return this;
  }
}
