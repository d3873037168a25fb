// Histogram and height profile, as SVG; both are lists of buttons as well.

import { short, ticks } from "./numbers.js";

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

/** An empty chart with axes. @returns its svg, and where values of x and y stand */
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

/** A bar that can be pressed, by mouse or key. */
function button(svg, attributes, label, onPress) {
  const bar = add(svg, "rect", { class: "bar", tabindex: 0, role: "button", "aria-label": label, ...attributes });
  add(bar, "title", {}, label);
  bar.addEventListener("click", onPress);
  bar.addEventListener("keydown", (event) => {
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      onPress();
    }
  });
}

/**
 * How many of the organs shown have which value. @param onRange  called with the ends of a bar
 * that is pressed
 */
export function drawHistogram(parent, numbers, isShown, title, onRange) {
  let low = Infinity;
  let high = -Infinity;
  numbers.forEach((value) => {
    if (Number.isFinite(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  });
  const bins = 24;
  const width = (high - low) / bins;
  const all = new Array(bins).fill(0);
  const shown = new Array(bins).fill(0);
  numbers.forEach((value, organ) => {
    if (Number.isFinite(value)) {
      const bin = width > 0 ? Math.min(bins - 1, Math.floor((value - low) / width)) : 0;
      ++all[bin];
      shown[bin] += isShown(organ) ? 1 : 0;
    }
  });
  if (!(high >= low)) {
    parent.textContent = "No organ has this number.";
    return;
  }
  const { svg, x, y } = start(parent, "Histogram", [low, high > low ? high : low + 1], [0, Math.max(...all)], title,
    Number.isInteger);
  for (let bin = 0; bin < bins; ++bin) {
    const from = low + bin * width;
    const to = bin === bins - 1 ? high : from + width;
    const place = (count) => ({
      x: x(from), width: Math.max(2, x(to) - x(from) - 1), y: y(count), height: Math.max(0, y(0) - y(count)),
    });
    if (all[bin] > 0) {
      add(svg, "rect", { class: "all", ...place(all[bin]) });
      button(svg, place(shown[bin]), `${short(from)} to ${short(to)}: ${shown[bin]} of ${all[bin]} organs`,
        () => onRange(from, to));
    }
  }
}

/**
 * Means over the organs shown, weighted by area, in layers of height. @param onRange  called with
 * the ends of a layer that is pressed
 */
export function drawProfile(parent, numbers, heights, areas, isShown, title, onRange) {
  let low = Infinity;
  let high = -Infinity;
  heights.forEach((h, organ) => {
    if (areas[organ] > 0) {
      low = Math.min(low, h);
      high = Math.max(high, h);
    }
  });
  const layers = high > low ? 12 : 1;
  const thick = (high - low) / layers;
  const sums = Array.from({ length: layers }, () => ({ area: 0, sum: 0, count: 0 }));
  numbers.forEach((value, organ) => {
    if (Number.isFinite(value) && areas[organ] > 0 && isShown(organ)) {
      const layer = sums[thick > 0 ? Math.min(layers - 1, Math.floor((heights[organ] - low) / thick)) : 0];
      layer.area += areas[organ];
      layer.sum += areas[organ] * value;
      ++layer.count;
    }
  });
  const means = sums.map((layer) => (layer.area > 0 ? layer.sum / layer.area : NaN));
  const known = means.filter(Number.isFinite);
  if (known.length === 0) {
    parent.textContent = "No organ is shown that has this number.";
    return;
  }
  const ends = [Math.min(0, ...known), Math.max(0, ...known) || 1];
  const { svg, x, y } = start(parent, "Height profile", ends, [low, high > low ? high : low + 1], title);
  means.forEach((mean, i) => {
    if (Number.isFinite(mean)) {
      const from = low + i * thick;
      const to = i === layers - 1 ? high : from + thick;
      const top = y(to || from + 1);
      button(svg,
        { x: Math.min(x(0), x(mean)), width: Math.max(2, Math.abs(x(mean) - x(0))), y: top, height: Math.max(2, y(from) - top - 1) },
        `height ${short(from)} to ${short(to)}: mean ${short(mean)} of ${sums[i].count} organs`,
        () => onRange(from, to));
    }
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
  for (const [key, name] of [["worst_error", "worst organ"], ["median_error", "median"]]) {
    const places = known.map((round) => [x(log(round.paths)), y(log(100 * round[key]))]);
    add(svg, "polyline", { class: `error ${key}`, fill: "none", points: places.map((place) => place.join(",")).join(" ") });
    places.forEach(([cx, cy]) => add(svg, "circle", { class: `dot ${key}`, cx, cy, r: 3 }));
    add(svg, "text", { x: places[0][0] + 6, y: places[0][1] - 6 }, name);
  }
}
