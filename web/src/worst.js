// The organs with the largest errors.

import { short } from "./numbers.js";
import { make, table } from "./tables.js";

const kMost = 10;

/** The organs with the largest `parts`, in decreasing order, without NaN. */
function largest(parts) {
  const found = [];
  for (let i = 0; i < parts.length; ++i) {
    if (parts[i] > (found.length < kMost ? -Infinity : parts[found.at(-1)])) {
      const at = found.findIndex((other) => parts[other] < parts[i]);
      found.splice(at < 0 ? found.length : at, 0, i);
      found.length = Math.min(found.length, kMost);
    }
  }
  return found;
}

function median(parts) {
  const known = parts.filter((part) => !Number.isNaN(part)).sort();
  return known.length > 0 ? known[Math.floor(known.length / 2)] : NaN;
}

/**
 * Organs with the largest errors, as per cent of their values. @param describe  (organ) => its number
 * @param choose  called with an organ whose name is pressed
 */
export function worstOrgans(run, column, { mean, error }, describe, choose) {
  const parts = mean.map((value, i) => (value > 0 && Number.isFinite(error[i]) ? error[i] / value : NaN));
  const dark = mean.reduce((count, value) => count + (value === 0 ? 1 : 0), 0);
  const rows = largest(parts).map((organ) => {
    const name = make("button", run.organName(organ), { type: "button", class: "link" });
    name.addEventListener("click", () => choose(organ));
    return [name, { number: describe(organ) }, { number: `${short(100 * parts[organ])} %` }];
  });
  return table(
    `${run.columnName(column)}: median relative standard error ${short(100 * median(parts))} %; ` +
    `${dark} organ${dark === 1 ? "" : "s"} without sampled light`, ["organ", "value", "standard error"], rows);
}
