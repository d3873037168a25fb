// Histogram and height profile, as SVG; both are lists of buttons as well.

import { endsOf, short, ticks } from "./numbers.js";

const kSvg = "http://www.w3.org/2000/svg";
const kWidth = 480;
const kHeight = 220;
const kLeft = 58;
const kBottom = 36;

function add(parent, name, attributes, text) {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, value);
  }
  if (text !== undefined) {
    made.textContent = text;
  }
  parent.append(made);
  return made;
}

/** An empty chart with axes. @returns its svg, and the scales of x and y */
function start(parent, label, [x0, x1], [y0, y1], xTitle, isYTick = () => true, isXTick = () => true) {
  parent.replaceChildren();
  const svg = add(parent, "svg", { viewBox: `0 0 ${kWidth} ${kHeight}`, role: "group", "aria-label": label });
  const x = (v) => kLeft + ((v - x0) / (x1 - x0 || 1)) * (kWidth - kLeft - 12);
  const y = (v) => kHeight - kBottom - ((v - y0) / (y1 - y0 || 1)) * (kHeight - kBottom - 12);
  add(svg, "path", { class: "axis", fill: "none", d: `M${kLeft} 8V${kHeight - kBottom}H${kWidth - 8}` });
  for (const tick of ticks(x0, x1, 5).filter(isXTick)) {
    add(svg, "text", { x: x(tick), y: kHeight - kBottom + 14, "text-anchor": "middle" }, short(tick));
  }
  for (const tick of ticks(y0, y1, 4).filter(isYTick)) {
    add(svg, "text", { x: kLeft - 5, y: y(tick) + 4, "text-anchor": "end" }, short(tick));
  }
  add(svg, "text", { x: (kLeft + kWidth) / 2, y: kHeight - 5, "text-anchor": "middle" }, xTitle);
  return { svg, x, y };
}

/**
 * Adds bars that can be pressed and pointed at, by mouse or key.
 * @param binOf  the number of its bar for each organ, -1 for none
 * @param bars  {bin, place, label, from, to} of each
 * @param acts  onRange is called with the ends of a bar that is pressed, onPoint with the organs and
 *     the label of the one that is pointed at, null when it no longer is
 * @returns (organ) => the ends of its bar, which is highlighted; null for none
 */
function addBars(svg, binOf, bars, { onRange, onPoint }) {
  const made = new Map();
  for (const { bin, place, label, from, to } of bars) {
    const bar = add(svg, "rect", { class: "bar", tabindex: 0, role: "button", "aria-label": label, "data-bin": bin, ...place });
    add(bar, "title", {}, label);
    const point = () => {
      const organs = [];
      binOf.forEach((own, organ) => own === bin && organs.push(organ));
      onPoint(organs, label);
    };
    const listen = (events, act) => events.forEach((event) => bar.addEventListener(event, act));
    listen(["pointerenter", "focus"], point);
    listen(["pointerleave", "blur"], () => onPoint(null));
    listen(["click"], () => onRange(from, to));
    listen(["keydown"], (event) => {
      if (event.key === "Enter" || event.key === " ") {
        event.preventDefault();
        onRange(from, to);
      }
    });
    made.set(bin, { bar, ends: `${short(from)} to ${short(to)}` });
  }
  return (organ) => {
    const own = organ === null ? undefined : made.get(binOf[organ]);
    for (const each of made.values()) {
      each.bar.classList.toggle("holds", each === own);
      each.bar.setAttribute("aria-current", String(each === own));
    }
    return own?.ends ?? null;
  };
}

/** Redraws a chart; the focused bar stays focused. */
function keepingFocus(parent, draw) {
  const bin = parent.contains(document.activeElement) ? document.activeElement.dataset.bin : undefined;
  const result = draw();
  if (bin !== undefined) {
    parent.querySelector(`[data-bin="${bin}"]`)?.focus();
  }
  return result;
}

const kNoBars = () => null;

/** Ends of an axis, widened if all numbers are equal. */
function widened(low, high) {
  const about = 0.1 * Math.abs(low) || 0.5;
  return high > low ? { low, high } : { low: low - about, high: low + about };
}

/** The bin of each number, one of `bins` between the ends; -1 for numbers that are left out. */
function binsOf(numbers, bins, { low, high }, isIn) {
  const width = (high - low) / bins;
  const result = new Int16Array(numbers.length).fill(-1);
  for (let organ = 0; organ < numbers.length; ++organ) {
    if (Number.isFinite(numbers[organ]) && isIn(organ)) {
      result[organ] = width > 0 ? Math.min(bins - 1, Math.floor((numbers[organ] - low) / width)) : 0;
    }
  }
  return result;
}

/**
 * Histogram of the values of shown organs. The last bar includes outliers, so that a few organs do not press all
 * others into one bar.
 * @param usual  value that few organs exceed  @param absent  reason for missing numbers
 * @param acts, @returns  see addBars
 */
export function drawHistogram(parent, { numbers, isShown, title, usual, absent }, acts) {
  const { low, high } = endsOf(numbers);
  if (!(high >= low)) {
    parent.textContent = absent || "No organ has a value.";
    return kNoBars;
  }
  const bins = high > low ? 24 : 1;
  const isOpen = usual > low && high > low + 1.5 * (usual - low);
  const ends = isOpen ? { low, high: low + ((usual - low) * bins) / (bins - 2) } : widened(low, high);
  const width = (ends.high - ends.low) / bins;
  const all = new Array(bins).fill(0);
  const shown = new Array(bins).fill(0);
  const binOf = binsOf(numbers, bins, ends, () => true);
  for (let organ = 0; organ < binOf.length; ++organ) {
    if (binOf[organ] >= 0) {
      ++all[binOf[organ]];
      shown[binOf[organ]] += isShown[organ];
      binOf[organ] = isShown[organ] ? binOf[organ] : -1;
    }
  }
  return keepingFocus(parent, () => {
    const { svg, x, y } = start(parent, "Histogram", [ends.low, ends.high], [0, Math.max(...all)],
      title, Number.isInteger);
    if (isOpen) {
      add(svg, "text", { x: kWidth - 8, y: 20, "text-anchor": "end" }, `last bar up to ${short(high)}`);
    }
    const bars = [];
    for (let bin = 0; bin < bins; ++bin) {
      const from = ends.low + bin * width;
      const to = bin === bins - 1 ? Math.max(high, ends.high) : from + width;
      const place = (count) => ({
        x: x(from), width: Math.max(2, x(from + width) - x(from) - 1), y: y(count), height: Math.max(0, y(0) - y(count)),
      });
      if (all[bin] > 0) {
        add(svg, "rect", { class: "all", ...place(all[bin]) });
        const label = `${short(from)} to ${short(to)}: ${shown[bin]} of ${all[bin]} organ${all[bin] === 1 ? "" : "s"}`;
        bars.push({ bin, place: place(shown[bin]), label, from, to });
      }
    }
    return addBars(svg, binOf, bars, acts);
  });
}

/**
 * Area-weighted means of shown organs in layers of height.
 * @param acts, @returns  see addBars
 */
export function drawProfile(parent, { numbers, isShown, title, heights, areas }, acts) {
  const known = endsOf(heights.map((height, organ) => (areas[organ] > 0 ? height : NaN)));
  const layers = known.high > known.low ? 12 : 1;
  const ends = widened(known.low, known.high);
  const { low, high } = ends;
  const thick = (high - low) / layers;
  const layerOf = binsOf(heights, layers, ends,
    (organ) => areas[organ] > 0 && isShown[organ] === 1 && Number.isFinite(numbers[organ]));
  const sums = Array.from({ length: layers }, () => ({ area: 0, sum: 0, count: 0 }));
  layerOf.forEach((number, organ) => {
    if (number >= 0) {
      sums[number].area += areas[organ];
      sums[number].sum += areas[organ] * numbers[organ];
      ++sums[number].count;
    }
  });
  const means = sums.map((layer) => (layer.area > 0 ? layer.sum / layer.area : NaN));
  const told = means.filter(Number.isFinite);
  if (told.length === 0) {
    parent.textContent = "No organ shown has a value.";
    return kNoBars;
  }
  return keepingFocus(parent, () => {
    const { svg, x, y } = start(parent, "Height profile", [Math.min(0, ...told), Math.max(0, ...told) || 1],
      [low, high], title);
    const bars = means.map((mean, bin) => {
      const from = low + bin * thick;
      const to = bin === layers - 1 ? high : from + thick;
      const top = y(to);
      const place = {
        x: Math.min(x(0), x(mean)), width: Math.max(2, Math.abs(x(mean) - x(0))), y: top, height: Math.max(2, y(from) - top - 1),
      };
      const label = `height ${short(from)} to ${short(to)}: mean ${short(mean)} of ${sums[bin].count} organ${sums[bin].count === 1 ? "" : "s"}`;
      return { bin, place, label, from, to };
    });
    return addBars(svg, layerOf, bars.filter(({ bin }) => Number.isFinite(means[bin])), acts);
  });
}

/** The median and the worst error after each round, per cent, both axes logarithmic. */
export function drawConvergence(parent, rounds) {
  const known = rounds.filter((round) => round.median_error > 0 && round.worst_error > 0);
  if (known.length < 2) {
    return;
  }
  const log = Math.log10;
  const errors = known.flatMap((round) => [100 * round.median_error, 100 * round.worst_error]);
  const ends = [Math.floor(log(Math.min(...errors))), Math.ceil(log(Math.max(...errors)))];
  const paths = [log(known[0].paths), log(known.at(-1).paths)];
  const { svg, x, y } = start(parent, "Convergence", paths, ends, "paths per replicate", () => false, () => false);
  for (let power = ends[0]; power <= ends[1]; ++power) {
    add(svg, "text", { x: kLeft - 5, y: y(power) + 4, "text-anchor": "end" }, `${power > 3 ? `1e${power}` : short(10 ** power)} %`);
  }
  known.forEach((round, i) => {
    const anchor = i + 1 === known.length ? "end" : "middle";
    add(svg, "text", { x: x(log(round.paths)), y: kHeight - kBottom + 14, "text-anchor": anchor }, String(round.paths));
  });
  for (const [key, name, below] of [["worst_error", "largest", -6], ["median_error", "median", 16]]) {
    const places = known.map((round) => [x(log(round.paths)), y(log(100 * round[key]))]);
    add(svg, "polyline", { class: `error ${key}`, fill: "none", points: places.map((place) => place.join(",")).join(" ") });
    places.forEach(([cx, cy]) => add(svg, "circle", { class: `dot ${key}`, cx, cy, r: 3 }));
    add(svg, "text", { x: places[0][0] + 6, y: places[0][1] + below }, name);
  }
}
