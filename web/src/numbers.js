// Numbers as people read them, and scales.

/** Four digits, no more than are needed. */
export function short(value) {
  if (!Number.isFinite(value)) {
    return "—";
  }
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) {
    return value.toExponential(3);
  }
  return String(Number(value.toPrecision(4)));
}

/** "0.3697 ± 0.0009": the value as far as its error lets it be known. */
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

/**
 * Ends of a scale of colours: from 0, unless some are negative, to what a two-hundredth of the area
 * exceeds, so that single organs do not darken all others.
 */
export function scaleOf(numbers, areas) {
  const known = [];
  let least = 0;
  let total = 0;
  for (let i = 0; i < numbers.length; ++i) {
    if (Number.isFinite(numbers[i])) {
      known.push(i);
      least = Math.min(least, numbers[i]);
      total += areas[i];
    }
  }
  known.sort((a, b) => numbers[b] - numbers[a]);
  let above = 0;
  let high = known.length > 0 ? numbers[known[0]] : 1;
  for (const i of known) {
    high = numbers[i];
    above += areas[i];
    if (above > total / 200) {
      break;
    }
  }
  if (known.length > 0 && !(high > least)) {
    high = numbers[known[0]];
  }
  return { low: least, high: high > least ? high : least + 1 };
}

/** The colour [r, g, b] of a number on a scale; grey what is not known. */
export function colorOf(value, scale, map) {
  if (!Number.isFinite(value)) {
    return [200, 200, 200];
  }
  const part = Math.min(1, Math.max(0, (value - scale.low) / (scale.high - scale.low)));
  const at = part * (map.length - 1);
  const below = Math.min(map.length - 2, Math.floor(at));
  const rest = at - below;
  const low = map[below];
  const high = map[below + 1];
  const mix = (k) => Math.round(low[k] + rest * (high[k] - low[k]));
  return [mix(0), mix(1), mix(2)];
}
