// Filters of the shown organs.

import { fill, make } from "./tables.js";

const kMostValues = 2000; // maximum length of a list
const kFirstLists = 3; // lists that are open at the start

/** A list of the values of a key, for multiple choice. */
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
 * A list for each key of labels with different values, those of the fewest values first; choices stay. Organs may have
 * many labels, such as lengths: all but the first lists are folded away.
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

/** The chosen values for each key of labels with choices. */
export function wantedLabels(parent) {
  const lists = [...parent.querySelectorAll("select")].filter((list) => list.selectedOptions.length > 0);
  return new Map(lists.map((list) =>
    [list.dataset.key, new Set([...list.selectedOptions].map((option) => option.value))]));
}

/**
 * A number for each organ, 0 for those that do not pass.
 * @param wanted  see wantedLabels: for each of its keys, the organ must have one of the values
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
