// Where the light goes: the number above all.

import { plainUnit, unitText } from "./format.js";

/** Units of growing plants, whose light is a part of what all sources send. */
export const kShares = { 1: "of full light", "": "full-light areas" };

/** The parts of light at one time, in its own unit; null without an energy budget. */
export function budgetOf(head, band) {
  const energy = head?.energy?.[band];
  if (!energy) {
    return null;
  }
  const mean = (part) => energy[part]?.mean ?? 0;
  const error = (part) => (energy[part] ? energy[part].standard_error ?? NaN : 0);
  return {
    unit: energy.unit, plants: mean("absorbed_by_organs"), plantsError: error("absorbed_by_organs"), ground: mean("absorbed_by_ground"),
    groundError: error("absorbed_by_ground"), sky: mean("escaped") + mean("cut_off"), skyError: error("escaped") + error("cut_off"),
  };
}

const kParts = ["plants", "plantsError", "ground", "groundError", "sky", "skyError"];

/**
 * The budget of a sum over times: of its plants the error is known, as the sum has them as a group; others are upper
 * bounds.
 * @param head  of the sum  @param steps  heads of its times  @param units  `sum_units` of the result
 */
export function summedBudget(head, steps, units, band) {
  const all = head?.groups?.find(({ by }) => by === "all")?.absorbed_flux?.[band];
  const sum = Object.fromEntries(kParts.map((key) => [key, 0]));
  for (const step of steps ?? []) {
    const own = budgetOf(step, band);
    if (!own || !(step.seconds > 0)) {
      return null;
    }
    kParts.forEach((key) => (sum[key] += own[key] * step.seconds));
  }
  if (!all || all.mean === null) {
    return null;
  }
  const factor = sum.plants > 0 ? all.mean / sum.plants : 0;
  return {
    unit: units?.[band]?.flux ?? "", plants: all.mean, plantsError: all.standard_error ?? NaN,
    ground: sum.ground * factor, groundError: sum.groundError * factor, sky: sum.sky * factor, skyError: sum.skyError * factor,
  };
}

/** The weighted sum of budgets, their mean if they are not of times; null while one is not known. Its errors are upper bounds. */
export function weightedBudget(budgets, weights, isOfTimes) {
  if (budgets.some((budget) => budget === null)) {
    return null;
  }
  const whole = isOfTimes ? 1 : weights.reduce((sum, weight) => sum + weight, 0);
  const sum = (key) => budgets.reduce((all, budget, i) => all + (weights[i] / whole) * budget[key], 0);
  return { unit: budgets[0].unit, ...Object.fromEntries(kParts.map((key) => [key, sum(key)])) };
}

/** The budget of an entry of a result or a run in progress. */
function budgetAt(page, entry, band) {
  const { run, timeline } = page;
  const isTotal = entry === timeline.total;
  if (!isTotal && !timeline.days.includes(entry)) {
    return budgetOf(page.headOf(entry), band);
  }
  const steps = isTotal ? timeline.steps : timeline.steps.filter(({ date }) => date === entry.date);
  return summedBudget(page.headOf(entry), steps.map((step) => page.headOf(step)), run.json.head.sum_units, band);
}

/** The area of the cell of a periodic scene, in square lengths of the scene; NaN for others. */
function cellArea(result) {
  const cell = result.run_file?.cell;
  if (!cell) {
    return NaN;
  }
  const ends = (axis) => (Array.isArray(cell[axis]) && cell[axis].length === 2 ? cell[axis][1] - cell[axis][0] : NaN);
  return ends("x") * ends("y");
}

/** What is known of the light that no organ absorbs. Only in a cell with a ground it has nowhere to go but up. */
function restOf({ ground, groundError, sky, skyError }, isClosed) {
  return [{ key: "ground", name: "Ground", light: ground, error: groundError },
    { key: "sky", name: isClosed ? "Back to the sky" : "Passes or leaves", light: sky, error: skyError }]
    .filter(({ key, light }) => key !== "ground" || light > 0);
}

const kFractions = { plants: "absorptance", ground: "ground_absorptance", sky: "reflectance" };

/**
 * The parts of the light that enters a cell, with the errors of the result where it has its canopy's.
 * @param canopy  of the result at that time  @param rest  see restOf
 */
function partsOf({ plants, plantsError }, rest, canopy) {
  const all = [{ key: "plants", name: "Organs", light: plants, error: plantsError }, ...rest];
  const incoming = all.reduce((sum, { light }) => sum + light, 0);
  const given = (key) => canopy?.[kFractions[key]];
  return incoming > 0 ? all.map(({ key, name, light, error }) => (Number.isFinite(given(key)?.mean) ? { key, name, part: given(key).mean, error: given(key).standard_error ?? NaN }
    : { key, name, part: Math.max(0, light) / incoming, error: error / incoming })) : [];
}

/**
 * The light of a band at an entry of the timeline.
 * @returns {plants, error, unit, isPerGround, given, byOf, parts: [{key, name, part, error}], rest: [{key, name, light, error}]}:
 *   `given` is the unit in the result, `byOf` returns what its numbers are multiplied by, for the area of a cell, and
 *   `rest`, in `unit`, is where there are no parts; null if the result does not have it
 */
export function lightBudget(page, entry, band) {
  const { run } = page;
  const found = page.live?.budgetOf ? page.live.budgetOf(entry, band) : budgetAt(page, entry, band);
  if (!found) {
    return null;
  }
  const { unit, factor } = plainUnit(found.unit);
  const isLarge = unit === "J" && found.plants * factor > 1e4;
  const area = cellArea(run.json.head);
  const isPerGround = area > 0 && /^(W|umol s-1|mol|MJ|J|kJ)$/.test(unit) && run.json.unit === "m";
  const byOf = (cell) => (isPerGround ? 1 / cell : factor) * (isLarge ? 1e-6 : 1);
  const by = byOf(area);
  const own = isLarge ? "MJ" : unit;
  const isCell = area > 0 || run.json.periods?.length > 1;
  const rest = restOf(found, isCell && run.json.organs.ground.length > 0);
  const perGround = { "umol s-1": "umol m-2 s-1" }[own] ?? `${own} m-2`;
  return {
    plants: found.plants * by, error: found.plantsError * by, unit: run.json.grows && own in kShares ? kShares[own] : unitText(isPerGround ? perGround : own), isPerGround, given: found.unit, byOf,
    parts: isCell ? partsOf(found, rest, page.headOf(entry)?.canopy?.[band]) : [], rest: isCell ? [] : rest.map((one) => ({ ...one, light: one.light * by, error: one.error * by })),
  };
}

/** The light of all plants at a time of a result, in its own unit: {mean, error, unit}; null if it does not have it. */
function plantsOf(result, { part, label }, band) {
  const head = headAt(result, part, label);
  const isSum = part === "days" || part === "total";
  const found = isSum ? head?.groups?.find(({ by }) => by === "all")?.absorbed_flux?.[band] : head?.energy?.[band]?.absorbed_by_organs;
  const unit = isSum ? result.sum_units?.[band]?.flux : head?.energy?.[band]?.unit;
  return Number.isFinite(found?.mean) ? { mean: found.mean, error: found.standard_error ?? NaN, unit } : null;
}

/**
 * The light of all plants minus that of another result, with the error of independent results.
 * @param budget  see lightBudget  @param other  the other result  @param time  {part, label}
 * @returns {mean, error, part, partError}: `part` of the other one; null if the two can't be compared
 */
export function lightDifference(budget, other, time, band) {
  const found = other && plantsOf(other, time, band);
  if (!found || found.unit !== budget.given) {
    return null;
  }
  const by = budget.byOf(cellArea(other));
  const mean = budget.plants - found.mean * by;
  return Number.isFinite(mean) ? { mean, error: Math.hypot(budget.error, found.error * by), part: mean / (found.mean * by), partError: Math.hypot(budget.error, found.error * by) / Math.abs(found.mean * by) } : null;
}

/** The light that all plants take of a band at a time, for the bars of the strip. */
export const plantLight = (head, band) => {
  const { energy } = head ?? {};
  return (energy?.[band] ?? Object.values(energy ?? {})[0])?.absorbed_by_organs?.mean ?? NaN;
};

/** An estimate of a column in a row of organs or groups of a result; undefined if it has none. */
export const estimateOf = (row, { quantity, band }) =>
  (band ? row[quantity]?.[band] : quantity === "sunlit_fraction" ? row[quantity] : row.ratios?.[quantity]);

/** What a result says of a time without its organs; undefined if it has no such time. */
export const headAt = (head, part, label) =>
  (part === "" ? head : part === "total" ? head.total : head[part]?.find(({ time, date }) => (time ?? date) === label));

/** Numbers of an estimate of a result, in another unit: {mean, error, low, high}. */
const numbersOf = ({ mean, standard_error: error, ci95_low: low, ci95_high: high }, factor = 1) =>
  Object.fromEntries(Object.entries({ mean, error, low, high }).map(([key, number]) => [key, (number ?? NaN) * factor]));

/** The estimate of all organs together of a quantity, in another unit: {mean, error, low, high}; null if it is not known. */
export function allPlants(head, quantity, band, factor = 1) {
  const found = head?.groups?.find(({ by }) => by === "all");
  const estimate = found && estimateOf(found, { quantity, band });
  return estimate && estimate.mean !== null ? numbersOf(estimate, factor) : null;
}

/**
 * The layers of a result at a time, with the means of a column; null if it has none. Flux is summed, not averaged.
 * @param head  of that time  @param kind  {quantity, band}  @param factor  to the unit in which means are shown
 */
export function layersOfResult(head, kind, factor) {
  const rows = head?.groups?.filter(({ by }) => by === "layer") ?? [];
  const layers = rows.map((row) => ({ row, estimate: estimateOf(row, kind) }));
  const isKnown = rows.length > 0 && kind.quantity !== "absorbed_flux" && layers.every(({ estimate }) => estimate);
  return isKnown ? layers.map(({ row, estimate }) => ({ ...row, ...numbersOf(estimate, factor) })) : null;
}
