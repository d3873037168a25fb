// The ends of the scale of colours: those of one time, or of all times that have one scale.

import { isKnown, scaleOf, weightedQuantile } from "./numbers.js";

/** The scale of the organs that are known to 50 % or better; of all, where none is. @param areas  see weightsOf */
export function scaleOfKnown({ mean, error }, areas) {
  const known = mean.map((value, i) => (isKnown(value, error[i]) ? value : NaN));
  return scaleOf(known.some((value, i) => Number.isFinite(value) && areas[i] > 0) ? known : mean, areas);
}

export class ColorScale {
  constructor(page) {
    this.page = page;
  }

  /** Finds the ends for the values that are to be shown. A promise. */
  async find(values) {
    const { run: { weights }, state } = this.page;
    this.spread = state.show === "value" ? [0.05, 0.95].map((part) => weightedQuantile(values.mean, weights, part)) : [NaN, NaN];
    if (state.sameScale && state.show !== "difference") {
      await this.#findCommon();
      return;
    }
    this.commonTo = null;
    const size = state.show === "difference" && scaleOf(values.mean.map(Math.abs), weights).high;
    this.usual = size ? { low: -size, high: size } : scaleOfKnown(values, weights);
  }

  /** Reads all values only if others have one scale now. */
  async #findCommon() {
    const { column, state, unit, timeline, entry } = this.page;
    const owner = this.#owner;
    const what = `${column} ${state.show} ${unit} ${timeline.steps.length} ${entry.start === null}`;
    if (this.commonTo !== owner || this.commonOf !== what) {
      const scales = (await this.#allValues(owner)).filter(({ values }) => values).map(({ values, areas }) => scaleOfKnown(values, areas));
      const low = Math.min(0, ...scales.map((scale) => scale.low));
      const high = Math.max(0, ...scales.map((scale) => scale.high));
      this.usual = { low, high: high > low ? high : low + 1 };
      Object.assign(this, { commonTo: owner, commonOf: what });
    }
  }

  /** What has a common scale: points of a sweep or frames have one together, and times of one result. */
  get #owner() {
    const { live, entry, timeline, run } = this.page;
    return live?.allValues && entry !== timeline.total ? live : run;
  }

  /** The values of all times that have a common scale: [{values, areas}]; null values where there are none. */
  async #allValues(owner) {
    const { run, column, timeline, entry } = this.page;
    if (owner !== run) {
      return owner.allValues(column, entry);
    }
    const isOne = run.json.times.length === 1;
    const steps = timeline.steps.includes(entry) && !isOne ? timeline.steps : [entry];
    const all = await Promise.all(steps.map(({ index }) => run.values(isOne ? 0 : index, column)));
    return all.map((values) => ({ values, areas: run.weights }));
  }

  /** Whether a logarithmic scale shows more. */
  get suitsLog() {
    return this.spread[0] > 0 && this.spread[1] > 100 * this.spread[0];
  }

  /** The scale that is shown: {low, high, isLog}; its ends are the user's, if there are such. */
  get shown() {
    const { ends, isLog: isAsked } = this.page.state;
    const [low, high] = ends ?? [this.usual.low, this.usual.high];
    const isLog = isAsked && this.suitsLog;
    return { low: isLog ? Math.max(low, this.spread[0] / 2) : low, high: high > low ? high : low + 1, isLog };
  }
}
