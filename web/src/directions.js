// Horizon, the four winds, the sun and its path, and lamps: vectors in two layers, one behind the canvas
// and one before it.

import { Vector3 } from "three";
import { svg } from "./dom.js";

const kSteps = 96; // of the horizon
const kMargin = 10; // of what is seen, pixels

/** The frame of what is drawn: the middle of the ground below the plants, and the radius of the hemisphere around them. */
function frameOf({ bounds: { low: from, high: to }, points, low }) {
  const base = new Vector3((from.x + to.x) / 2, (from.y + to.y) / 2, low.z);
  return { base, radius: points.plants.reduce((most, point) => Math.max(most, point.distanceTo(base)), 1e-30) };
}

export class Directions {
  /** @param back, front  svg elements */
  constructor(back, front) {
    this.layers = [back, front];
  }

  clear() {
    this.layers.forEach((layer) => layer.replaceChildren());
  }

  /**
   * @param window  the SceneWindow
   * @param paths  unit vectors towards the sun through days  @param hours  of each time step
   * @param covered  {left, bottom}: the lower right corner of the legend
   * @param suns  of the shown time  @param lamps  positions
   */
  draw(window, { paths, hours, suns, lamps }, covered) {
    this.clear();
    const { base, radius } = frameOf(window);
    const back = window.camera.position.clone().sub(base).setZ(0);
    const at = (v, far = 1) => base.clone().addScaledVector(new Vector3(...v), far * radius);
    const layerOf = (point) => this.layers[point.clone().sub(base).dot(back) > 0 ? 1 : 0];
    const line = (points, kind) => this.#line(points.map((point) => [layerOf(point), window.project(point)]), kind);
    line(Array.from({ length: kSteps + 1 }, (_, i) => at([Math.cos((2 * Math.PI * i) / kSteps), Math.sin((2 * Math.PI * i) / kSteps), 0])), "ring");
    this.#winds(window, at, covered);
    paths.forEach((path) => line(path.map((v) => at(v)), "path"));
    if (paths.length > 0) {
      hours.forEach((v) => this.#disc(layerOf(at(v)), window.project(at(v)), 2, "dot"));
    }
    for (const sun of suns) {
      const far = this.#seenFrom(1, sun, window, at, covered);
      line([at(sun, 0.72 * far), at(sun, 0.94 * far)], "ray");
      this.#disc(layerOf(at(sun)), window.project(at(sun, far)), suns.length > 1 ? 6 : 9, "sun");
    }
    for (const lamp of lamps.slice(0, 100)) {
      const point = new Vector3(...lamp);
      const far = point.distanceTo(base);
      const shown = far <= 2 * radius ? point : point.sub(base).multiplyScalar(radius / far).add(base);
      this.#disc(layerOf(shown), window.project(shown), 4, "dot");
      this.#disc(layerOf(shown), window.project(shown), 8, "lamp");
    }
  }

  /** Letters before the scene, as pieces of hidden ones would be seen, but for those behind the legend. */
  #winds(window, at, covered) {
    const [nx, ny] = window.run.json.north;
    for (const [letter, v] of [["N", [nx, ny, 0]], ["E", [ny, -nx, 0]], ["S", [-nx, -ny, 0]], ["W", [-ny, nx, 0]]]) {
      const [x, y] = window.project(at(v, this.#seenFrom(1.1, v, window, at, covered)));
      this.layers[1].append(svg("text", { x, y, class: letter === "N" ? "wind north" : "wind" }, letter));
    }
  }

  /** How far out a mark in a direction is seen, beside the legend: from the middle it is in the same direction. @param most  of the radius */
  #seenFrom(most, v, window, at, covered) {
    const { clientWidth: width, clientHeight: height } = window.canvas;
    const isSeen = ([x, y]) => x > kMargin && x < width - kMargin && y > kMargin && y < height - kMargin && (x > covered.left + kMargin || y > covered.bottom + kMargin);
    let far = most;
    while (far > 0 && !isSeen(window.project(at(v, far)))) {
      far -= 0.02;
    }
    return Math.max(0, far);
  }

  /** Pieces of a line go to the layer of their first point. */
  #line(points, kind) {
    let piece = [];
    points.forEach(([layer, pixel], i) => {
      piece.push(pixel);
      const next = points[i + 1];
      if (!next || (next[0] !== layer && piece.length > 0)) {
        const all = next ? [...piece, next[1]] : piece;
        layer.append(svg("polyline", { class: kind, points: all.map((p) => p.map((x) => x.toFixed(1)).join(",")).join(" ") }));
        piece = [];
      }
    });
  }

  #disc(layer, [cx, cy], r, kind) {
    layer.append(svg("circle", { class: kind, cx, cy, r }));
  }
}
