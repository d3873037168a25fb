// The weighted sum of the points of a sweep: sums of days, or the mean of points without times.

import { RunData } from "./data.js";
import { kSure } from "./numbers.js";

/** The standard error of a sum is at most the sum of those of its parts; points have random numbers in common. */
const sumOf = (numbers, weights) => numbers.reduce((sum, number, i) => sum + weights[i] * (number ?? NaN), 0);

/** Estimates of groups of all organs, quantity by quantity. */
function summedGroup(groups, weights) {
  const estimates = (all) => {
    const mean = sumOf(all.map((one) => one?.mean), weights);
    return Number.isFinite(mean) ? { mean, standard_error: sumOf(all.map((one) => one?.standard_error), weights) } : { mean: null };
  };
  const bands = Object.keys(groups[0].absorbed_flux ?? {});
  const quantities = Object.keys(groups[0]).filter((key) => !key.startsWith("fraction_") && bands.some((band) => groups[0][key]?.[band])); // fractions have no sum
  const { by, value, organs, area } = groups[0];
  return { by, value, organs, area, ...Object.fromEntries(quantities.map((key) =>
    [key, Object.fromEntries(bands.map((band) => [band, estimates(groups.map((group) => group[key]?.[band]))]))])) };
}

/** The sums of the groups that all points have. */
function summedGroups(heads, weights) {
  const same = ({ by, value }) => heads.map((head) => head.groups?.find((group) => group.by === by && group.value === value));
  return (heads[0].groups ?? []).map(same).filter((groups) => groups.every(Boolean)).map((groups) => summedGroup(groups, weights));
}

/**
 * The sum of the last times of the points, with errors that are upper bounds; null if their organs are not the same.
 * @param runs  RunData of all points  @param weights  their weights; those of points without times become parts of 1
 */
export function sumOfPoints(runs, weights) {
  const [first] = runs;
  const organs = JSON.stringify(first.json.organs);
  if (runs.some(({ json }) => JSON.stringify(json.organs) !== organs)) {
    return null;
  }
  const isOfTimes = first.json.times.at(-1).part === "total";
  const whole = weights.reduce((sum, weight) => sum + weight, 0);
  const parts = isOfTimes ? weights : weights.map((weight) => weight / whole);
  const heads = runs.map((run) => run.headOf(run.json.times.length - 1));
  const head = { groups: summedGroups(heads, parts), seconds: isOfTimes ? sumOf(heads.map(({ seconds }) => seconds), parts) : undefined };
  const known = (column) => column.band && runs.every((run) => run.has(run.json.times.length - 1, first.json.columns.indexOf(column)));
  const common = { ...first.json.head, point: `all ${runs.length}`, completed: undefined, method: undefined, timing: undefined };
  const json = {
    ...first.json, head: isOfTimes ? { ...common, time_steps: undefined, days: undefined, total: head } : { ...common, energy: undefined, ...head },
    times: [{ part: isOfTimes ? "total" : "", index: 0, label: "", suns: isOfTimes ? [] : runs.flatMap((run) => run.json.times.at(-1).suns), lamps: [], sky: null, values: first.json.columns.map((column, i) => (known(column) ? i : -1)),
      paths: runs.map((run) => run.json.times.filter(({ part }) => part === "time_steps").flatMap(({ suns }) => suns)).filter((suns) => suns.length > 1) }],
  };
  return new RunData(json, first.colorMaps, first.shape, async (column) => {
    const all = await Promise.all(runs.map((run) => run.values(run.json.times.length - 1, column)));
    const by = 1 / first.factorOf(first.json.times.length - 1, column); // blobs are in the units of the result
    const sum = (part) => Float32Array.from(all[0].mean, (_, organ) => by * sumOf(all.map((values) => values[part][organ]), parts));
    const [mean, error] = [sum("mean"), sum("error")];
    return Float32Array.from([...mean, ...error, ...mean.map((m, i) => Math.max(0, m - kSure * error[i])), ...mean.map((m, i) => m + kSure * error[i])]).buffer;
  });
}
