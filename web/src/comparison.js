// The difference of what is shown from another result: organs are matched by their ids.

import { headAt, layersOfResult } from "./energy.js";
import { kSure } from "./numbers.js";

export const kErrorsOfDifferences = "Errors are √(a² + b²): results hold no replicates, so the two are taken as independent.";

/**
 * The values of a result minus those of another one. Errors are those of independent results.
 * @param index  for each organ its index in the other result; -1: it has none
 */
function differenceOf(own, other, index) {
  const of = (act) => Float64Array.from(index, (there, organ) => (there < 0 ? NaN : act(organ, there)));
  const mean = of((here, there) => own.mean[here] - other.mean[there]);
  const error = of((here, there) => Math.hypot(own.error[here], other.error[there]));
  return { mean, error, low: mean.map((m, i) => m - kSure * error[i]), high: mean.map((m, i) => m + kSure * error[i]) };
}

/** Layers minus the same ones of another result, with errors of independent results; null if they are not the same. */
export function differenceOfLayers(own, other) {
  const isSame = (layer, i) => ["height_min", "height_max", "organs"].every((key) => layer[key] === other[i][key]);
  return own && other && own.length === other.length && own.every(isSame)
    ? own.map((layer, i) => ({ ...layer, mean: layer.mean - other[i].mean, error: Math.hypot(layer.error, other[i].error), low: undefined, high: undefined })) : null;
}

/** A run, and another result that is taken away from it. */
export class Comparison {
  /**
   * @param run  RunData
   * @param other  {title, ids, result, values, layers}: ids of its organs as texts; its JSON; values(time, column, factor) returns a
   *   promise of {mean, error} in units of the run, null where it has none; layers(time, column, factor) its layers or
   *   null. See runAsOther, and ResultFile.
   */
  constructor(run, other) {
    Object.assign(this, { run, other, title: other.title, result: other.result, errors: kErrorsOfDifferences });
    const known = new Map(other.ids.map((id, i) => [id, i]));
    this.index = Int32Array.from({ length: run.count }, (_, organ) => known.get(run.idOf(organ)) ?? -1);
    const common = this.index.reduce((sum, there) => sum + (there >= 0 ? 1 : 0), 0);
    Object.assign(this, { common, onlyFirst: run.count - common, onlyOther: other.ids.length - common });
  }

  /** Differences of all organs; null where one of the results has no values. A promise. */
  async values(time, column) {
    const { json } = this.run;
    const [own, other] = await Promise.all([
      this.run.values(time, column), this.other.values(json.times[time], json.columns[column], this.run.factorOf(time, column))]);
    return own && other && differenceOf(own, other, this.index);
  }

  /** The layers of the other result, in units of the run; null if it has none. */
  layers(time, column) {
    const { json } = this.run;
    return this.other.layers(json.times[time], json.columns[column], this.run.factorOf(time, column));
  }
}

/** Another point of a sweep, for a Comparison. */
export function runAsOther(run, title) {
  const timeOf = ({ part, label }) => run.json.times.findIndex((own) => own.part === part && own.label === label);
  return {
    title, result: run.json.head, ids: Array.from({ length: run.count }, (_, organ) => run.idOf(organ)),
    layers(own, kind, factor) {
      const time = timeOf(own);
      return time < 0 ? null : layersOfResult(run.headOf(time), kind, factor);
    },
    async values(own, { quantity, band }) {
      const time = timeOf(own);
      const column = run.columnOf(quantity, band);
      return time < 0 || column < 0 ? null : run.values(time, column);
    },
  };
}

/** The difference that a result was written with (--minus); null if there is none. */
export function givenDifference(run) {
  const { minus } = run.json;
  if (!minus) {
    return null;
  }
  const layers = (time, column) => {
    const { part, label } = run.json.times[time];
    return layersOfResult(headAt(minus.head, part, label), run.json.columns[column], run.factorOf(time, column));
  };
  return { ...minus, result: minus.head, onlyFirst: minus.only_first, onlyOther: minus.only_other, layers, values: (time, column) => run.difference(time, column) };
}
