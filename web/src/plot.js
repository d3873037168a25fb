// Axes and bars of charts, in CSS pixels.

import { svg } from "./dom.js";
import { evenly, plain, powerOf, unitOfColumn } from "./format.js";
import { ticks } from "./numbers.js";
import { roving } from "./choice.js";

const kUsual = [440, 180]; // of charts that are not in the document yet

const kMargin = 18; // right of the plane: half of a time, in pixels
const kRow = 14; // height of a row of text
const kHalfLetter = 3.2;

/** Round numbers on an axis, more than asked for where these would be one or two: they alone do not give a scale. */
function enoughTicks({ low, high }, count) {
  const found = ticks(low, high, count);
  return found.length > 2 || !(high > low) ? found : ticks(low, high, 2 * count);
}

/** An axis with a grid that ends at one of its lines, so that no bar ends beyond the last number. */
function ended(axis, count) {
  const [first, next] = Array.isArray(axis.ticks) || !axis.grid ? [] : enoughTicks(axis, axis.ticks ?? count);
  const step = next - first;
  return step > 0 ? { ...axis, high: step * Math.ceil(axis.high / step - 1e-9) } : axis;
}

/** An axis with its ticks and their texts: with the same decimals, and a power of ten that goes to the unit. */
function withTicks(axis, count) {
  const list = Array.isArray(axis.ticks) ? axis.ticks : enoughTicks({ ...axis, high: axis.last ?? axis.high }, axis.ticks ?? count);
  const power = axis.format ? 0 : powerOf(Math.max(...list.map(Math.abs)));
  const apart = list.length > 1 ? (list[1] - list[0]) / 10 ** power : 0;
  return { ...axis, list, power, format: axis.format ?? ((number) => (apart > 0 && number !== 0 ? evenly(number / 10 ** power, apart, 1) : plain(number / 10 ** power))) };
}

function addText(node, x, y, anchor, text) {
  node.append(svg("text", { x, y, "text-anchor": anchor }, text));
}

/** Numbers along an edge, without those that would cover the one before. @param to  from numbers to pixels */
function addNumbers(node, { list, format }, to, y, width) {
  let end = -Infinity;
  for (const tick of list) {
    const text = format(tick);
    const half = kHalfLetter * text.length;
    const isBeyond = to(tick) + half > width;
    const from = to(tick) - (isBeyond ? 2 : 1) * half;
    if (from > end) {
      addText(node, to(tick), y, isBeyond ? "end" : "middle", text);
      end = from + 2 * half + 4;
    }
  }
}

/**
 * An empty chart as large as its parent.
 * @param x, y  {low, high, ticks: count or list, last: the greatest number, format, unit}
 * @param top  another axis along x, above the plane
 * @returns {node, x, y, top, box}: functions from numbers to pixels, and the ends of the plane
 */
export function startPlot(parent, label, { x: givenX, y: givenY, top: givenTop, left = 44 }) {
  const width = Math.max(120, parent.clientWidth || kUsual[0]);
  const height = Math.max(80, parent.clientHeight || kUsual[1]);
  const [across, up] = [Math.max(2, Math.min(6, width / 90)), Math.max(2, height / 60)];
  const x = withTicks(givenX, across);
  const y = withTicks(ended(givenY, up), up);
  const top = givenTop && withTicks(ended({ ...givenTop, grid: true }, 2), 2);
  const box = { left, right: width - kMargin, top: y.unit || top ? kRow + 8 : 10, bottom: height - 20 };
  const node = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: "xMinYMin meet", role: "group", "aria-label": label });
  const along = ({ low, high }) => (v) => box.left + ((v - low) / (high - low || 1)) * (box.right - box.left);
  const [toX, toTop] = [along(x), top && along(top)];
  const toY = (v) => box.bottom - ((v - y.low) / (y.high - y.low || 1)) * (box.bottom - box.top);
  for (const tick of x.grid ? x.list : []) {
    node.append(svg("line", { class: "axis", x1: toX(tick), x2: toX(tick), y1: box.top, y2: box.bottom }));
  }
  addNumbers(node, x, toX, box.bottom + 14, width);
  for (const tick of y.list) {
    if (y.grid) {
      node.append(svg("line", { class: "axis", x1: box.left, x2: box.right, y1: toY(tick), y2: toY(tick) }));
    }
    addText(node, box.left - 6, toY(tick) + 4, "end", y.format(tick));
  }
  if (top) {
    addNumbers(node, top, toTop, box.top - 5, width);
  }
  if (y.unit) {
    addText(node, box.left - (top ? 14 : 6), box.top - 8, "end", unitOfColumn(y.unit, y));
  }
  node.append(svg("line", { class: "base", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom }));
  parent.replaceChildren(node);
  return { node, x: toX, y: toY, top: toTop, box, power: { x: x.power, y: y.power, top: top?.power ?? 0 } };
}

/**
 * Adds bars that can be pointed at and pressed, by mouse or key: one stop of Tab, arrows go through them.
 * @param bars  [{bin, box, hit, color, label, from, to}]; without a box only `hit` is there
 * @param acts  onPoint(bin or null), onPress(bar)
 * @returns (isIn) => marks the bars of bins
 */
export function addBars(node, bars, { onPoint, onPress }) {
  const made = new Map();
  const shapes = new Map(bars.filter(({ box }) => box).map((bar) => [bar.bin, svg("rect", { class: "bar", ...bar.box, fill: bar.color, rx: 1 })]));
  node.append(...shapes.values());
  for (const bar of bars) {
    const hit = svg("rect", {
      class: "hit", ...bar.hit, role: "button", tabindex: made.size === 0 ? 0 : -1, "aria-label": bar.label, "data-bin": bar.bin,
      onpointerenter: () => onPoint(bar), onpointerleave: () => onPoint(null),
      onfocus: () => hit.matches(":focus-visible") && onPoint(bar), onblur: () => onPoint(null), onclick: () => onPress(bar),
      onkeydown: (event) => {
        if (event.key === "Enter" || event.key === " ") {
          event.preventDefault();
          event.stopPropagation();
          onPress(bar);
        }
      },
    }, svg("title", {}, bar.label));
    made.set(bar.bin, hit);
    node.append(hit);
  }
  roving(node, ".hit", (now) => made.forEach((hit) => hit.setAttribute("tabindex", hit === now ? 0 : -1)));
  return (isIn) => made.forEach((hit, bin) => {
    shapes.get(bin)?.classList.toggle("holds", isIn(bin));
    hit.setAttribute("aria-current", String(isIn(bin)));
  });
}

/** An error bar along x, with a light rim that shows it on bars. @param ends  in numbers */
export function addWhisker({ node, x, y }, ends, at) {
  const [from, to] = ends.map(x);
  const middle = y(at);
  const path = `M${from} ${middle}H${to}M${from} ${middle - 3}v6M${to} ${middle - 3}v6`;
  node.append(svg("path", { class: "error rim", d: path, "pointer-events": "none" }), svg("path", { class: "error", d: path, "pointer-events": "none" }));
}

/** An error bar along y, open at the end of the plane. @param isBound  whether its middle is not said */
export function addUpright({ node, y, box }, { low, high }, at, color, isBound) {
  const [from, to] = [low, high].map((end) => Math.min(box.bottom, Math.max(box.top, y(end))));
  const cap = y(high) < box.top ? "" : `M${at - 3} ${to}h6`;
  const path = `M${at} ${from}V${to}M${at - 3} ${from}h6${cap}`;
  node.append(svg("path", { class: isBound ? "upright bound" : "upright", d: path, stroke: color, "pointer-events": "none" }));
}

/** Draws a chart anew; the focused bar stays focused. */
export function keepingFocus(parent, draw) {
  const bin = parent.contains(document.activeElement) ? document.activeElement.dataset.bin : undefined;
  const result = draw();
  if (bin !== undefined) {
    parent.querySelector(`[data-bin="${bin}"]`)?.focus();
  }
  return result;
}
