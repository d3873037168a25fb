// The copies of a periodic cell around it, for the eye alone: they have no numbers, and can't be picked.

import { InstancedBufferAttribute, InstancedBufferGeometry, Mesh, Scene } from "three";

const kMaxTriangles = 2e6; // of all copies together; more would hold up slow graphics

/** The vectors from a cell to those that touch it. @param periods  one vector or two */
export function shiftsOf(periods) {
  const sums = periods.reduce(
    (all, period) => [-1, 0, 1].flatMap((times) => all.map((sum) => sum.map((x, k) => x + times * period[k]))), [[0, 0, 0]]);
  return sums.filter((sum) => sum.some((x) => x !== 0));
}

export class Neighbours {
  /** @param organs  the OrganGeometry of the cell, whose buffers are shared */
  constructor(organs, periods, material) {
    const shifts = shiftsOf(periods);
    const { attributes, index, boundingSphere } = organs.geometry;
    this.organs = organs;
    this.most = Math.min(1, (3 * kMaxTriangles) / (shifts.length * organs.count));
    this.reach = Math.max(...shifts.map((shift) => Math.hypot(...shift)));
    this.geometry = new InstancedBufferGeometry();
    Object.entries(attributes).forEach(([name, attribute]) => this.geometry.setAttribute(name, attribute));
    this.geometry.setAttribute("shift", new InstancedBufferAttribute(Float32Array.from(shifts.flat()), 3));
    this.geometry.setIndex(index);
    this.geometry.instanceCount = shifts.length;
    this.geometry.boundingSphere = boundingSphere;
    this.scene = new Scene();
    const mesh = new Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  /** Draws at most a fraction of the triangles of each copy. */
  drawFraction(fraction) {
    this.geometry.setDrawRange(0, this.organs.cornersOf(Math.min(fraction, this.most)));
  }

  /** Frees what it does not share. */
  dispose() {
    ["position", "organ"].forEach((name) => this.geometry.deleteAttribute(name));
    this.geometry.setIndex(null);
    this.geometry.dispose();
  }
}
