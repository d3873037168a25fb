// Scales of numbers, and their colours.

export const kSure = 1.96; // standard errors of a 95 % interval

/** Whether a number is known to 50 % or better, or without an error. */
export const isKnown = (mean, error) => Number.isFinite(mean) && !(error > 0.5 * Math.abs(mean));

/** Round numbers from low to high, about `count` of them. */
export function ticks(low, high, count) {
  if (!(high > low)) {
    return [low];
  }
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= raw);
  const result = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-9) + 1e-300; ++i) {
    result.push(Number((i * step).toPrecision(12)));
  }
  return result;
}

/** The minimum and maximum of the finite numbers; low > high if there are none. */
export function endsOf(numbers) {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < numbers.length; ++i) {
    if (Number.isFinite(numbers[i])) {
      low = Math.min(low, numbers[i]);
      high = Math.max(high, numbers[i]);
    }
  }
  return { low, high };
}

/** The value that a part of the area exceeds. Only the numbers of one bin are sorted. */
function exceededBy(numbers, areas, part, { low, high }) {
  const bins = 4096;
  const binOf = (value) => Math.min(bins - 1, Math.floor(((value - low) / (high - low)) * bins));
  const sums = new Float64Array(bins);
  let total = 0;
  for (let i = 0; i < numbers.length; ++i) {
    if (Number.isFinite(numbers[i])) {
      sums[binOf(numbers[i])] += areas[i];
      total += areas[i];
    }
  }
  let bin = bins - 1;
  let above = 0;
  while (bin > 0 && above + sums[bin] <= total * part) {
    above += sums[bin--];
  }
  const within = [];
  numbers.forEach((value, i) => Number.isFinite(value) && binOf(value) === bin && within.push(i));
  within.sort((a, b) => numbers[b] - numbers[a]);
  for (const i of within) {
    above += areas[i];
    if (above > total * part) {
      return numbers[i];
    }
  }
  return within.length > 0 ? numbers[within.at(-1)] : low;
}

/**
 * Ends of a colour scale: from 0, unless some numbers are negative, to the value that 0.5 % of the area and 0.5 % of the
 * organs exceed, so that neither a large organ nor many small ones darken all others. Numbers without an area count only
 * where there are no others.
 */
export function scaleOf(all, areas) {
  const numbers = all.map((number, i) => (areas[i] > 0 ? number : NaN));
  if (!numbers.some(Number.isFinite) && all.some(Number.isFinite)) {
    return scaleOf(all, all.map(() => 1));
  }
  const ends = endsOf(numbers);
  if (!(ends.high >= ends.low)) {
    return { low: 0, high: 1 };
  }
  const low = Math.min(0, ends.low);
  const usual = ends.high > ends.low ? Math.min(...[areas, areas.map(Math.sign)].map((weights) => exceededBy(numbers, weights, 1 / 200, ends))) : ends.high;
  const high = usual > low ? usual : ends.high;
  return { low, high: high > low ? high : low + 1 };
}

/** `count` colours of a map, red in the lowest of three bytes. */
function paletteOf(map, count) {
  return Int32Array.from({ length: count }, (_, i) => {
    const at = (i / (count - 1)) * (map.length - 1);
    const below = Math.min(map.length - 2, Math.floor(at));
    const mix = (k) => Math.round(map[below][k] + (at - below) * (map[below + 1][k] - map[below][k]));
    return mix(0) | (mix(1) << 8) | (mix(2) << 16);
  });
}

const kUnknown = 0xa9afab; // the colour of organs without a value

/** A number on a scale, from 0 to 1. @param scale  {low, high, isLog} */
export function partOf(number, { low, high, isLog }) {
  const part = isLog ? Math.log(Math.max(number, low) / low) / Math.log(high / low) : (number - low) / (high - low);
  return Math.min(1, Math.max(0, part));
}

/** Colours of numbers on a scale, red in the lowest of three bytes; grey for unknown numbers. */
export function colorsOf(numbers, scale, map) {
  const last = 1023;
  const palette = paletteOf(map, last + 1);
  return Int32Array.from(numbers, (number) =>
    Number.isFinite(number) ? palette[Math.round(last * partOf(number, scale))] : kUnknown);
}

/** "#rrggbb" or "rgb()" of a colour with red in the lowest of three bytes, and back. */
export const cssOf = (color) => `rgb(${color & 255},${(color >> 8) & 255},${(color >> 16) & 255})`;
export function packed(hex) {
  const rgb = parseInt(hex.slice(1), 16);
  return (rgb >> 16) | (rgb & 0xff00) | ((rgb & 255) << 16);
}

/** The number that a fraction of the weight is below. */
export function weightedQuantile(numbers, weights, fraction) {
  const known = [...numbers.keys()].filter((i) => Number.isFinite(numbers[i]) && weights[i] > 0);
  known.sort((a, b) => numbers[a] - numbers[b]);
  const total = known.reduce((sum, i) => sum + weights[i], 0);
  let below = 0;
  for (const i of known) {
    below += weights[i];
    if (below >= fraction * total) {
      return numbers[i];
    }
  }
  return NaN;
}

/** The number that half of some positive numbers do not exceed; NaN without any. */
export function lowerMedian(numbers) {
  const known = [...numbers].filter((number) => number > 0).sort((a, b) => a - b);
  return known[(known.length - 1) >> 1] ?? NaN;
}
