// Which organs are shown.

/** Keys of labels that divide the organs, those of few values first. */
export function usefulLabels(labels) {
  return Object.entries(labels)
    .filter(([, { values, of }]) => values.length > 1 || of.includes(-1))
    .sort(([, one], [, other]) => one.values.length - other.values.length)
    .map(([key]) => key);
}

/** Whether a label is a range of numbers rather than a list. */
export const isRange = ({ values }) => values.length > 30 && values.every((value) => value !== "" && Number.isFinite(Number(value)));

/** Tests of the labels: a function of an organ for each key with a choice. */
function labelTests(labels, { labels: wanted, ranges }) {
  const lists = Object.entries(wanted).filter(([key, chosen]) => labels[key] && chosen.length > 0).map(([key, chosen]) => {
    const { values, of } = labels[key];
    const isWanted = values.map((value) => chosen.includes(value));
    return (organ) => of[organ] >= 0 && isWanted[of[organ]];
  });
  const spans = Object.entries(ranges).filter(([key]) => labels[key]).map(([key, [from, to]]) => {
    const { values, of } = labels[key];
    const numbers = values.map(Number);
    return (organ) => of[organ] >= 0 && numbers[of[organ]] >= from && numbers[of[organ]] <= to;
  });
  return [...lists, ...spans];
}

const isWithin = (number, ends) => ends === null || (number >= ends[0] && number <= ends[1]);

/** For each organ 1 if it passes the filters of the state, else 0. */
export function organsPassing(run, numbers, classes, state) {
  const tests = labelTests(run.json.organs.labels, state);
  const shown = new Uint8Array(run.count);
  for (let organ = 0; organ < run.count; ++organ) {
    const isKnown = state.show !== "difference" || Number.isFinite(numbers[organ]);
    shown[organ] = isKnown && (state.ground || !run.isGround[organ]) && (state.sensors || !run.isSensor[organ]) && tests.every((passes) => passes(organ)) &&
      (state.layer === null || run.layers.reaches(organ, state.layer)) && isWithin(numbers[organ], state.values) &&
      (state.errorClass === null || classes[organ] === state.errorClass) ? 1 : 0;
  }
  return shown;
}

/** Whether anything but the ground is filtered. */
export const isFiltered = (state) => state.values !== null || state.layer !== null || state.errorClass !== null ||
  Object.values(state.labels).some((chosen) => chosen.length > 0) || Object.keys(state.ranges).length > 0;

/** What shows all again. */
export const noFilters = () => ({ labels: {}, ranges: {}, values: null, layer: null, errorClass: null, ground: true, sensors: true });

/** Whether a result is about its sensors: it has more of them than parts of plants. @param isPlant, isSensor  flags of organs */
export function isOfSensors({ isPlant, isSensor }) {
  const count = (flags) => flags.reduce((sum, one) => sum + one, 0);
  return count(isSensor) > count(isPlant);
}

/** How much each organ counts in scales: its area, 0 for the ground below others; or 1 for sensors that a result is about. */
export function weightsOf({ isMeasured, isPlant, isGround, isSensor }, areas) {
  if (isMeasured) {
    return Float32Array.from(isSensor);
  }
  return isPlant.includes(1) ? areas.map((area, i) => (isGround[i] ? 0 : area)) : areas;
}
