// The points of a finished sweep, shown like times: each is a result of its own, read when it is shown. Points with
// the hours of one day have these below them, and weights give a sum of all points.

import { runAsOther } from "./comparison.js";
import { RunData, readJson } from "./data.js";
import { allPlants, budgetOf, summedBudget, weightedBudget } from "./energy.js";
import { pointNames } from "./point_names.js";
import { Timeline } from "./timeline.js";
import { sumOfPoints } from "./sweep_sum.js";

/** What a page asks of a sweep; see LiveView. */
export class SweepView {
  /** @param first  RunData of the point that is shown first */
  constructor(first) {
    const { points, point, weights } = first.json.sweep;
    this.names = pointNames(points);
    this.weights = weights;
    this.shown = point;
    this.isFollowing = true; // there is nothing newer
    this.runs = new Map([[point, Promise.resolve(first)]]);
    this.loaded = new Map([[point, first]]);
    this.heads = new Map(); // {head, last} of points: the result without organs, and that of its last time
    this.hasSum = first.json.head.run_file?.sweep?.weights !== undefined;
    this.#keepHead(point, first.json);
  }

  #keepHead(point, { head, times }) {
    const last = times.at(-1).part === "total" ? head.total : head;
    this.heads.set(point, { head, last });
  }

  /** The result of a point. A promise. */
  run(point) {
    if (!this.runs.has(point)) {
      this.runs.set(point, RunData.load(`point-${point}-`).then((run) => {
        this.loaded.set(point, run);
        this.#keepHead(point, run.json);
        return run;
      }));
    }
    return this.runs.get(point);
  }

  /** The weighted sum of all points, null if they do not have the same organs. A promise. */
  sum() {
    this.summed ??= Promise.all(this.names.map((_, point) => this.run(point))).then((runs) => (this.whole = sumOfPoints(runs, this.weights)));
    return this.summed;
  }

  timeline() {
    return Timeline.ofPoints(this.names, this.shown, this.loaded.get(this.shown), this.hasSum ? this.weights : null);
  }

  /** What is shown first: an entry of the address, or else the sum, or the first point. @returns {run, timeline, key} */
  async start(key) {
    this.hasSum = this.hasSum && (await this.sum()) !== null;
    const point = Number(/^point-(\d+)/.exec(key)?.[1]) - 1;
    if (this.names[point]) {
      await this.run(point);
      this.shown = point;
    }
    const timeline = this.timeline();
    const entry = timeline.find(key) ?? timeline.total ?? timeline.point(this.shown);
    return { run: entry === timeline.total ? await this.sum() : this.loaded.get(this.shown), timeline, key: entry.key };
  }

  async select(entry) {
    this.asked = entry.key;
    const run = await (entry.point < 0 ? this.sum() : this.run(entry.point));
    if (this.asked === entry.key) {
      this.shown = entry.point < 0 ? this.shown : entry.point;
      await this.page.replace(run, this.timeline(), entry.key);
    }
  }

  /** A point to be taken away from the one that is shown. A promise. */
  async otherPoint(point) {
    return { ...runAsOther(await this.run(point), this.names[point].name), point };
  }

  /** Results without organs, as far as they are loaded. */
  headOf({ point, index, start }) {
    return point < 0 ? this.whole.headOf(0) : start === null ? this.heads.get(point)?.last : this.loaded.get(point)?.headOf(index);
  }

  /** The light of a point, null if it is not known. */
  #pointBudget(point, band) {
    const { head } = this.heads.get(point) ?? {};
    return head?.total ? summedBudget(head.total, head.time_steps, head.sum_units, band) : budgetOf(head, band);
  }

  /** See lightBudget. */
  budgetOf(entry, band) {
    if (entry.point < 0) {
      return weightedBudget(this.names.map((_, point) => this.#pointBudget(point, band)), this.weights, this.isOfTimes);
    }
    return entry.start === null ? this.#pointBudget(entry.point, band) : budgetOf(this.headOf(entry), band);
  }

  get isOfTimes() {
    return this.heads.get(this.shown).head.total !== undefined;
  }

  lightOf(entry, band) {
    return this.budgetOf(entry, band)?.plants ?? NaN;
  }

  /** Values of an organ at several entries. A promise. */
  course(entries, column, id) {
    return Promise.all(entries.map(async ({ point, index, start }) => {
      const run = await this.run(point);
      const organ = run.organOfId(id);
      const [found] = organ >= 0 ? await run.course([start === null ? run.json.times.length - 1 : index], column, organ) : [null];
      return found;
    }));
  }

  /** Values of all organs for a common scale: at all points, or at the hours of the point of most light, if an entry is one. A promise. */
  async allValues(column, { start }) {
    const isOfHours = start !== null;
    const points = isOfHours ? [await this.#brightest(column)] : [...this.names.keys()];
    const all = await Promise.all(points.map(async (point) => {
      const run = await this.run(point);
      const { times } = run.json;
      const wanted = isOfHours ? [...times.keys()].filter((time) => times[time].part === "time_steps") : [times.length - 1];
      return Promise.all(wanted.map(async (time) => ({ values: await run.values(time, column), areas: run.weights })));
    }));
    return all.flat();
  }

  /** The point at which all organs together have most of a quantity. A promise. */
  async #brightest(column) {
    await this.readLight();
    const { quantity, band } = this.loaded.get(this.shown).json.columns[column];
    const meanAt = (point) => allPlants(this.heads.get(point).last, quantity, band)?.mean ?? 0;
    return [...this.names.keys()].reduce((best, point) => (meanAt(point) > meanAt(best) ? point : best));
  }

  /** Reads the light of all other points, for the heights of their bars. */
  readLight() {
    this.reading ??= (async () => {
      for (const point of this.names.keys()) {
        if (!this.heads.has(point)) {
          this.#keepHead(point, await readJson(`point-${point}-data`));
          this.page?.notify("time");
        }
      }
    })();
    return this.reading;
  }
}
