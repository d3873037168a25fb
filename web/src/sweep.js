// The points of a finished sweep, shown like times: each is a result of its own, read when it is shown.

import { runAsOther } from "./comparison.js";
import { RunData, readJson } from "./data.js";
import { plantLight } from "./energy.js";

/** "elevation 15°" for a key and its value. */
function valueName(key, text) {
  const name = key.slice(key.lastIndexOf(".") + 1);
  return name.endsWith("_deg") ? `${name.slice(0, -4).replaceAll("_", " ")} ${text}°` : `${name.replaceAll("_", " ")} ${text}`;
}

/** The names of a point of a sweep. @param values  texts by key */
export function pointNames(values) {
  const pairs = Object.entries(values);
  return { name: pairs.map((pair) => valueName(...pair)).join(", "), short: pairs.map(([, text]) => text).join(", ") };
}

/** What a page asks of a sweep; see LiveView. */
export class SweepView {
  /** @param first  RunData of the point that is shown first */
  constructor(first) {
    this.points = first.json.sweep.points;
    this.shown = first.json.sweep.point;
    this.isFollowing = true; // there is nothing newer
    this.runs = new Map([[this.shown, Promise.resolve(first.ofSum())]]);
    this.heads = new Map();
    this.#keepHead(this.shown, first);
  }

  #keepHead(point, run) {
    this.heads.set(point, run.headOf(run.json.times.length - 1));
  }

  /** A point with its sum over times. */
  run(point) {
    if (!this.runs.has(point)) {
      this.runs.set(point, RunData.load(`point-${point}-`).then((run) => {
        this.#keepHead(point, run);
        return run.ofSum();
      }));
    }
    return this.runs.get(point);
  }

  async select(point) {
    this.asked = point;
    const run = await this.run(point);
    if (this.asked === point) {
      this.shown = point;
      await this.page.replace(run, this.page.timeline, this.page.timeline.steps[point].key);
    }
  }

  /** A point to be taken away from the one that is shown. A promise. */
  async otherPoint(point) {
    return { ...runAsOther(await this.run(point), pointNames(this.points[point]).name), point };
  }

  headOf({ index }) {
    return this.heads.get(index);
  }

  lightOf({ index }, band) {
    return plantLight(this.heads.get(index), band);
  }

  async course(indices, column, id) {
    return Promise.all(indices.map(async (point) => {
      const run = await this.run(point);
      const organ = run.organOfId(id);
      const values = organ >= 0 ? await run.values(0, column) : null;
      return values && { mean: values.mean[organ], error: values.error[organ], low: values.low[organ], high: values.high[organ] };
    }));
  }

  /** Reads the light of all other points, for the heights of their bars. */
  async readLight() {
    for (const point of this.points.keys()) {
      if (!this.heads.has(point)) {
        const { head, times } = await readJson(`point-${point}-data`);
        this.heads.set(point, times.at(-1).part === "total" ? head.total : head);
        this.page.notify("time");
      }
    }
  }
}
