// The light of the organs that are shown, where these are not all.

import { many } from "./format.js";

/** Whether some organ is hidden, or all are. */
export const isPart = ({ run, isShown }) => run.isPlant.some((plant, i) => plant && !isShown[i]);

/** The group of a result that has just the organs that are shown; undefined for none. */
export function groupOfShown({ isPlant, json }, isShown, groups) {
  const { labels } = json.organs;
  return groups?.find(({ by, value }) => {
    const wanted = labels[by]?.values.indexOf(String(value)) ?? -1;
    return wanted >= 0 && isPlant.every((plant, i) => !plant || (isShown[i] === 1) === (labels[by].of[i] === wanted));
  });
}

/** The part of the light of all organs that those shown take; NaN where it is not known. */
async function partOfShown({ run, time, band, isShown }) {
  const column = ["absorbed_flux_density", "absorbed_flux"].map((quantity) => run.columnOf(quantity, band)).find((found) => found >= 0);
  const values = column === undefined ? null : await run.values(time, column);
  const weight = (i) => (run.json.columns[column].quantity === "absorbed_flux" ? 1 : run.shape.areas[i]);
  let [all, shown] = [0, 0];
  values?.mean.forEach((mean, i) => {
    if (run.isPlant[i] && Number.isFinite(mean)) {
      all += mean * weight(i);
      shown += isShown[i] ? mean * weight(i) : 0;
    }
  });
  return shown / all;
}

/**
 * The budget of the organs that are shown: with an error if the result has a group of just these.
 * @param whole  that of all, see lightBudget
 * @returns  as lightBudget(), with `subject` absorbs it, a `note`, and the part of other organs. A promise
 */
export async function lightOfShown(page, whole) {
  const { run, isShown, band } = page;
  const groups = page.headOf(page.entry)?.groups;
  const group = groupOfShown(run, isShown, groups);
  const flux = group?.absorbed_flux?.[band];
  const all = groups?.find(({ by }) => by === "all")?.absorbed_flux?.[band];
  const isKnown = Number.isFinite(flux?.mean) && all?.mean > 0;
  const part = isKnown ? flux.mean / all.mean : await partOfShown(page);
  const count = isShown.reduce((sum, shown, i) => sum + (shown && run.isPlant[i] ? 1 : 0), 0);
  const organs = whole.parts.find(({ key }) => key === "plants");
  const given = group?.fraction_incident?.[band];
  const ownPart = Number.isFinite(given?.mean) ? { part: given.mean, error: given.standard_error ?? NaN } : { part: (organs?.part ?? NaN) * part, error: NaN };
  return {
    ...whole, plants: whole.plants * part, error: isKnown ? (whole.plants * (flux.standard_error ?? NaN)) / all.mean : NaN,
    subject: isKnown ? `Organs of ${group.by} ${group.value} absorb` : `${many(count, "organ")} shown absorb${count === 1 ? "s" : ""}`,
    note: isKnown ? "" : "Error not known: no group of the result has just these organs.",
    parts: organs ? [{ ...organs, name: "Shown organs", ...ownPart }, { key: "others", name: "Other organs", part: organs.part - ownPart.part, error: NaN }, ...whole.parts.filter((one) => one !== organs)] : [],
  };
}
