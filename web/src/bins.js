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
  return { bins, has: (i, bin) => binOf[i] === bin, binOf, low: span.low, high: span.low + count * width, hasMore, highest: ends.high, last: span.high };
}

/** Organs by class of error. */
export function classBins({ classes, areas, isShown, isIn }) {
  const binOf = Int16Array.from(classes, (number, i) => (number < kClasses.length && isIn(i) ? number : -1));
  return { binOf, has: (i, bin) => binOf[i] === bin, bins: filled(binOf, kClasses.length, { areas, isShown }) };
}

/**
 * Layers of height of shown organs, without the ground: each part of an organ has its value.
 * @param layers  see LayerAreas
 * @param isMedian  medians over area instead of means
 * @returns {bins, low, high, has}: has(organ, bin) says whether an organ has a part in a layer; null without organs
 */
export function layersOf({ numbers, areas, layers, isShown, isMedian }) {
  const isIn = (i) => areas[i] > 0 && isShown[i] === 1;
  const found = layers.of(isIn);
  if (!found) {
    return null;
  }
  const { limits, areas: parts } = found;
  const count = limits.length - 1;
  const partOf = (i, bin) => (isIn(i) ? parts[i * count + bin] : 0);
  const organs = [...areas.keys()].filter(isIn);
  const bins = Array.from({ length: count }, (_, bin) => {
    const members = organs.filter((i) => partOf(i, bin) > 0);
    const known = members.filter((i) => Number.isFinite(numbers[i]));
    const sumOf = (of, some) => some.reduce((sum, i) => sum + of(i), 0);
    const meanOf = () => sumOf((i) => partOf(i, bin) * numbers[i], known) / sumOf((i) => partOf(i, bin), known);
    const medianOf = () => weightedQuantile(known.map((i) => numbers[i]), known.map((i) => partOf(i, bin)), 0.5);
    const mean = known.length === 0 ? NaN : isMedian ? medianOf() : meanOf();
    return { from: limits[bin], to: limits[bin + 1], area: sumOf((i) => partOf(i, bin), members), count: members.length, mean };
  });
  return { bins, low: limits[0], high: limits.at(-1), has: (i, bin) => partOf(i, bin) > 0 };
}

/**
 * Layers of a result, whose means have errors of their own. Organs belong to the layer of their middle.
 * @param layers  [{height_min, height_max, area, organs, mean, error, low, high}], from the lowest one up
 * @returns  as layersOf(), with the `error` and the interval of each
 */
export function givenLayers({ layers, heights, isShown }) {
  const bins = layers.map(({ height_min: from, height_max: to, area, organs: count, mean, error, low, high }) =>
    ({ from, to, area, count, mean: count > 0 ? mean : NaN, error, low, high }));
  const top = bins.at(-1).to;
  const isWithin = (height, { from, to }) => height >= from && (height < to || (height === top && to === top));
  return { bins, low: bins[0].from, high: top, has: (i, bin) => isShown[i] === 1 && isWithin(heights[i], bins[bin]) };
}
