// Organs in bins of value, class of error or height.

import { kClasses } from "./classes.js";
import { endsOf, weightedQuantile } from "./numbers.js";

/** Ends of an axis, widened if all numbers are equal. */
function widened(low, high) {
  const about = 0.1 * Math.abs(low) || 0.5;
  return high > low ? { low, high } : { low: low - about, high: low + about };
}

/** The bin of each number, one of `count` between the ends, those beyond in the first and last; -1 for numbers left out. */
function binsOf(numbers, count, { low, high }, isIn) {
  const width = (high - low) / count;
  return Int16Array.from(numbers, (number, i) =>
    (Number.isFinite(number) && isIn(i) ? Math.min(count - 1, Math.max(0, Math.floor((number - low) / width))) : -1));
}

/** What each bin holds: area and count of all and of shown organs. */
function filled(binOf, count, { areas, isShown }) {
  const bins = Array.from({ length: count }, () => ({ all: { area: 0, count: 0 }, shown: { area: 0, count: 0 } }));
  binOf.forEach((bin, i) => {
    if (bin >= 0) {
      for (const part of isShown[i] ? ["all", "shown"] : ["all"]) {
        bins[bin][part].area += areas[i];
        ++bins[bin][part].count;
      }
    }
  });
  return bins;
}

/**
 * Organs by value. The last bin is "more": it holds what is beyond the usual values, so that a few organs do not press
 * all others together.
 * @returns {bins, binOf, low, high, hasMore, highest}; null if no organ has a value
 */
export function valueBins({ mean, areas, isShown, isIn, scale }) {
  const ends = endsOf(mean.filter((_, i) => isIn(i)));
  if (!(ends.high >= ends.low)) {
    return null;
  }
  const kBins = 24;
  const low = Math.min(scale.low, ends.low);
  const hasMore = ends.high > scale.high * (1 + 1e-9) && scale.high > low;
  const span = widened(low, hasMore ? scale.high : Math.max(ends.high, scale.high));
  const width = (span.high - span.low) / kBins;
  const count = hasMore ? kBins + 2 : kBins; // a gap before the last one
  const inside = binsOf(mean, kBins, span, isIn);
  const binOf = hasMore ? inside.map((bin, i) => (bin >= 0 && mean[i] > span.high ? count - 1 : bin)) : inside;
  const bins = filled(binOf, count, { areas, isShown }).map((bin, i) => {
    const isMore = hasMore && i === count - 1;
    return { ...bin, from: isMore ? span.high : span.low + i * width, to: isMore ? ends.high : span.low + (i + 1) * width, isMore };
  });
  return { bins, binOf, low: span.low, high: span.low + count * width, hasMore, highest: ends.high, last: span.high };
}

/** Organs by class of error. */
export function classBins({ classes, areas, isShown, isIn }) {
  const binOf = Int16Array.from(classes, (number, i) => (number < kClasses.length && isIn(i) ? number : -1));
  return { binOf, bins: filled(binOf, kClasses.length, { areas, isShown }) };
}

/** Layers of height of shown organs, without the ground: area-weighted means, or medians. */
export function layersOf({ numbers, areas, heights, isShown, isMedian }, count = 10) {
  const isIn = (i) => areas[i] > 0 && isShown[i] === 1;
  const known = endsOf(heights.map((height, i) => (isIn(i) ? height : NaN)));
  if (!(known.high >= known.low)) {
    return null;
  }
  const ends = known.high > known.low ? known : widened(known.low, known.high);
  const layers = known.high > known.low ? count : 1;
  const thick = (ends.high - ends.low) / layers;
  const binOf = binsOf(heights, layers, ends, isIn);
  const bins = Array.from({ length: layers }, (_, k) => ({ from: ends.low + k * thick, to: ends.low + (k + 1) * thick, area: 0, count: 0, sum: 0, valued: 0, members: [] }));
  binOf.forEach((bin, i) => {
    if (bin < 0) {
      return;
    }
    bins[bin].area += areas[i];
    ++bins[bin].count;
    if (Number.isFinite(numbers[i])) {
      bins[bin].sum += areas[i] * numbers[i];
      bins[bin].valued += areas[i];
      bins[bin].members.push(i);
    }
  });
  const meanOf = (bin) => (bin.valued > 0 ? bin.sum / bin.valued : NaN);
  const medianOf = ({ members }) => weightedQuantile(members.map((i) => numbers[i]), members.map((i) => areas[i]), 0.5);
  return { binOf, low: ends.low, high: ends.high, bins: bins.map((bin) => ({ ...bin, mean: isMedian ? medianOf(bin) : meanOf(bin) })) };
}

/**
 * Layers of a result, whose means have errors of their own.
 * @param layers  [{height_min, height_max, area, organs, mean, error}], from the lowest one up
 * @returns  as layersOf(), with the `error` of each
 */
export function givenLayers({ layers, heights, isShown }) {
  const bins = layers.map(({ height_min: from, height_max: to, area, organs: count, mean, error }) => ({ from, to, area, count, mean: count > 0 ? mean : NaN, error }));
  const high = bins.at(-1).to;
  const binOf = Int16Array.from(heights, (height, i) =>
    (isShown[i] ? bins.findIndex(({ from, to }) => height >= from && (height < to || (height === high && to === high))) : -1));
  return { binOf, low: bins[0].from, high, bins };
}
