// Formats of numbers, and scales.

/** At most four digits. */
export function short(value) {
  if (!Number.isFinite(value)) {
    return "—";
  }
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) {
    return value.toExponential(3).replace(/\.?0*e/, "e");
  }
  return String(Number(value.toPrecision(4)));
}

/** "0.3697 ± 0.0009": the value with the digits that its error justifies. */
export function withError(mean, error) {
  if (!Number.isFinite(mean)) {
    return "not known";
  }
  if (!Number.isFinite(error) || error === 0) {
    return `${short(mean)} ± ${Number.isFinite(error) ? "0" : "?"}`;
  }
  const exponent = Math.floor(Math.log10(error)) - 1; // two digits of the error
  if (Math.abs(mean) >= 1e6 || (mean !== 0 && Math.abs(mean) < 1e-3) || exponent < -9 || exponent > 3) {
    return `${mean.toExponential(4)} ± ${error.toExponential(1)}`;
  }
  const digits = Math.max(0, -exponent);
  return `${mean.toFixed(digits)} ± ${error.toFixed(digits)}`;
}

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
 * Ends of a colour scale: from 0, unless some numbers are negative, to the value that 0.5 % of the area
 * exceeds, so that single organs do not darken all others.
 */
export function scaleOf(numbers, areas) {
  const ends = endsOf(numbers);
  if (!(ends.high >= ends.low)) {
    return { low: 0, high: 1 };
  }
  const low = Math.min(0, ends.low);
  const usual = ends.high > ends.low ? exceededBy(numbers, areas, 1 / 200, ends) : ends.high;
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

/** Colours of numbers on a scale, red in the lowest of three bytes: grey for unknown numbers, -1 for hidden organs. */
export function colorsOf(numbers, isShown, scale, map) {
  const kGrey = 0xc8c8c8;
  const last = 1023;
  const palette = paletteOf(map, last + 1);
  const factor = last / (scale.high - scale.low);
  const colors = new Int32Array(numbers.length);
  for (let i = 0; i < numbers.length; ++i) {
    const part = Math.round((numbers[i] - scale.low) * factor);
    const color = Number.isFinite(numbers[i]) ? palette[Math.min(last, Math.max(0, part))] : kGrey;
    colors[i] = isShown[i] ? color : -1;
  }
  return colors;
}

/** A number as text with its unit, if it has one: plants of simulators have none. */
export function withUnit(text, unit) {
  return unit ? `${text} ${unit}` : text;
}
