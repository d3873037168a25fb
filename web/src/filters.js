// Which organs are shown.

import { fill, make } from "./tables.js";

const kMostValues = 2000; // that a person looks through
const kFirstLists = 3; // that are open from the start

/** A list of the values of a key, of which some can be chosen. */
function valueList(key, values, chosen) {
  const list = make("select", undefined, { multiple: "", size: Math.min(4, values.length), "data-key": key });
  const letters = new Intl.Collator(undefined, { numeric: true });
  const inOrder = [...values].sort((one, other) => one - other || letters.compare(one, other)); // numbers, or by letters
  fill(list, inOrder.map((value) => [value, value]));
  [...list.options].forEach((option) => (option.selected = chosen?.has(option.value) ?? false));
  const label = make("label", `${key} `);
  label.append(list);
  return label;
}

/**
 * A list for each key of labels that tells organs apart, those of the fewest values first; what was chosen before stays
 * so. Files of plants give organs many labels, measures among them: all but the first lists are folded away.
 */
export function fillLabels(parent, labels) {
  const wanted = wantedLabels(parent);
  const lists = Object.entries(labels)
    .filter(([, { values, of }]) => values.length <= kMostValues && (values.length > 1 || of.includes(-1)))
    .sort(([, one], [, other]) => one.values.length - other.values.length)
    .map(([key, { values }]) => valueList(key, values, wanted.get(key)));
  parent.replaceChildren(...lists.slice(0, kFirstLists));
  if (lists.length > kFirstLists) {
    const more = make("details");
    more.append(make("summary", "More labels"), ...lists.slice(kFirstLists));
    parent.append(more);
  }
}

/** The values that are chosen, of each key of labels of which some are. */
export function wantedLabels(parent) {
  const lists = [...parent.querySelectorAll("select")].filter((list) => list.selectedOptions.length > 0);
  return new Map(lists.map((list) =>
    [list.dataset.key, new Set([...list.selectedOptions].map((option) => option.value))]));
}

/**
 * A number for each organ, 0 for those that do not pass.
 * @param wanted  see wantedLabels: of each key there one of its values must be the organ's
 * @param layer  ends of heights, null for all  @param range  ends of numbers, each null for none
 */
export function organsPassing(run, numbers, { wanted, layer, range: [from, to], hasGround }) {
  const labels = [...wanted].map(([key, chosen]) => {
    const { values, of } = run.json.organs.labels[key];
    return { of, isWanted: values.map((value) => chosen.has(value)) };
  });
  const { heights } = run.shape;
  const passes = (organ) =>
    (hasGround || !run.isGround[organ]) &&
    labels.every(({ of, isWanted }) => of[organ] >= 0 && isWanted[of[organ]]) &&
    (!layer || (heights[organ] >= layer[0] && heights[organ] <= layer[1])) &&
    (from === null || numbers[organ] >= from) && (to === null || numbers[organ] <= to);
  const shown = new Uint8Array(run.count);
  for (let organ = 0; organ < run.count; ++organ) {
    shown[organ] = passes(organ) ? 1 : 0;
  }
  return shown;
}
