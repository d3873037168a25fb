// The colour of each organ: by its value, its error or a difference. An organ of which nothing is known has stripes.

import { classColor } from "./classes.js";
import { colorsOf, kSure, packed } from "./numbers.js";

const kDifference = ["#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f4f1ec", "#fddbc7", "#f4a582", "#d6604d", "#b2182b"];
const kSmaller = packed("#c4c9c6"); // of differences smaller than their errors
export const kStriped = 1 << 24; // beside the three bytes of a colour
const kUnknown = kStriped | packed("#7d8581");

/** Whether nothing is known of an estimate: its error exceeds it, or no light was found, which does not mean that there is none. */
export const isUnknown = (mean, error) => error > Math.abs(mean) || (mean === 0 && Number.isNaN(error));

/** The colours of a scale, [red, green, blue] each. @param maps  of a result, by name */
export function colorMapOf({ show, map }, maps) {
  return show === "difference" ? kDifference.map((hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16))) : maps[map];
}

/** The colour of each organ, whether it is shown or not: red in the lowest of three bytes, and kStriped. */
export function organColors({ state: { show }, values: { mean, error }, classes, scale, map }) {
  if (show === "difference") {
    return colorsOf(mean, scale, map).map((color, i) => (Math.abs(mean[i]) < kSure * error[i] ? kSmaller : color));
  }
  const colors = show === "error" ? Int32Array.from(classes, (number) => packed(classColor(number))) : colorsOf(mean, scale, map);
  return colors.map((color, i) => (isUnknown(mean[i], error[i]) ? kUnknown : color));
}
