// Horizon, the four winds, the sun and its path, and lamps: vectors in two layers, one behind the canvas
// and one before it.

import { Vector3 } from "three";
import { svg } from "./dom.js";

const kSteps = 96; // of the horizon

/** The mean of unit vectors as a unit vector; null for none. */
export function meanDirection(vectors) {
  const sum = vectors.reduce((all, v) => all.map((x, k) => x + v[k]), [0, 0, 0]);
  const length = Math.hypot(...sum);
  return length > 0 ? sum.map((x) => x / length) : null;
}

/** The frame of what is drawn: the middle of the ground below the plants, and a radius around it. */
function frameOf({ bounds, low }) {
  const { low: from, high: to } = bounds;
  const wide = Math.max(to.x - from.x, to.y - from.y, 0.7 * (to.z - from.z));
  return { base: new Vector3((from.x + to.x) / 2, (from.y + to.y) / 2, low.z), radius: 0.68 * Math.max(wide, 1e-30) };
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
   * @param sun  of the shown time, null for none  @param lamps  positions
   */
  draw(window, { paths, hours, sun, lamps }, covered) {
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
    if (sun) {
      line([at(sun, 0.72), at(sun, 0.94)], "ray");
      this.#disc(layerOf(at(sun)), window.project(at(sun)), 9, "sun");
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
    const [x, y] = window.run.json.north;
    for (const [letter, v] of [["N", [x, y, 0]], ["E", [y, -x, 0]], ["S", [-x, -y, 0]], ["W", [-y, x, 0]]]) {
      const point = at(v, 1.1);
      const [left, top] = window.project(point);
      if (left > covered.left || top > covered.bottom) {
        this.layers[1].append(svg("text", { x: left, y: top, class: letter === "N" ? "wind north" : "wind" }, letter));
      }
    }
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
