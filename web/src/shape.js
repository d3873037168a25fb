// The triangles of a scene for the GPU.

import { BufferAttribute, BufferGeometry, Sphere } from "three";

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
  const vertices = new Float32Array(bytes, 12 * count, size);
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
  return { areas, heights, counts: triangles, triangles: total, vertices, corners, first };
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

/** Organs that are drawn whole while the scene moves: the ground, and the largest ones of few triangles. */
function wholeOrgans(shape, isGround) {
  const kLargest = 64; // organs
  const most = Math.max(2000, 0.05 * shape.triangles); // triangles
  const inOrder = [...shape.areas.keys()].sort((a, b) => isGround[b] - isGround[a] || shape.areas[b] - shape.areas[a]);
  const whole = new Uint8Array(shape.areas.length);
  let triangles = 0;
  for (const organ of inOrder.slice(0, kLargest)) {
    if (triangles + shape.counts[organ] <= most) {
      whole[organ] = 1;
      triangles += shape.counts[organ];
    }
  }
  return whole;
}

/** The corners of whole organs first, then all others spread. @returns {corners, whole}: whole is the number of the first */
function drawingOrder(shape, isGround) {
  const isWhole = wholeOrgans(shape, isGround);
  const whole = new Uint32Array(shape.corners.length);
  const others = new Uint32Array(shape.corners.length);
  let [wholeCount, otherCount, from] = [0, 0, 0];
  shape.counts.forEach((count, organ) => {
    const own = shape.corners.subarray(from, (from += 3 * count));
    if (isWhole[organ]) {
      whole.set(own, wholeCount);
      wholeCount += own.length;
    } else {
      others.set(own, otherCount);
      otherCount += own.length;
    }
  });
  whole.set(spread(others.subarray(0, otherCount)), wholeCount);
  return { corners: whole, whole: wholeCount };
}

/** The triangles; each vertex has the number of its organ, by which shaders find its colour. */
export class OrganGeometry {
  constructor(shape, isGround) {
    const { corners, whole } = drawingOrder(shape, isGround);
    const organs = new Uint32Array(shape.vertices.length / 3);
    for (let organ = 0; organ + 1 < shape.first.length; ++organ) {
      organs.fill(organ, shape.first[organ], shape.first[organ + 1]);
    }
    this.whole = whole;
    this.count = corners.length;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(shape.vertices, 3));
    this.geometry.setAttribute("organ", new BufferAttribute(organs, 1));
    this.geometry.setIndex(new BufferAttribute(corners, 1));
    this.geometry.boundingSphere = new Sphere(); // unused, and slow to compute
  }

  /** The number of first corners that draw whole organs, and a fraction of the triangles of all others. */
  cornersOf(fraction) {
    return this.whole + 3 * Math.ceil((fraction * (this.count - this.whole)) / 3);
  }

  drawFraction(fraction) {
    this.geometry.setDrawRange(0, this.cornersOf(fraction));
  }

  dispose() {
    this.geometry.dispose();
  }
}
