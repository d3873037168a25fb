// Axes and bars of charts, in CSS pixels.

import { svg } from "./dom.js";
import { plain } from "./format.js";
import { ticks } from "./numbers.js";
import { roving } from "./choice.js";

const kUsual = [440, 180]; // of charts that are not in the document yet

const kMargin = 18; // right of the plane: half of a time, in pixels
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

/**
 * An empty chart as large as its parent.
 * @param x, y  {low, high, ticks: count or list, format}; no ticks: no labels
 * @returns {node, x, y, box}: functions from numbers to pixels, and the ends of the plane
 */
export function startPlot(parent, label, { x, y: given, left = 44 }) {
  const width = Math.max(120, parent.clientWidth || kUsual[0]);
  const height = Math.max(80, parent.clientHeight || kUsual[1]);
  const y = ended(given, Math.max(2, height / 60));
  const box = { left, right: width - kMargin, top: 10, bottom: height - 20 };
  const node = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: "xMinYMin meet", role: "group", "aria-label": label });
  const toX = (v) => box.left + ((v - x.low) / (x.high - x.low || 1)) * (box.right - box.left);
  const toY = (v) => box.bottom - ((v - y.low) / (y.high - y.low || 1)) * (box.bottom - box.top);
  const listOf = (axis, count) => (Array.isArray(axis.ticks) ? axis.ticks : enoughTicks(axis, axis.ticks ?? count));
  const format = (axis) => axis.format ?? ((v) => plain(v));
  for (const tick of listOf(x, Math.max(2, Math.min(6, width / 90)))) {
    if (x.grid) {
      node.append(svg("line", { class: "axis", x1: toX(tick), x2: toX(tick), y1: box.top, y2: box.bottom }));
    }
    const text = format(x)(tick);
    const isBeyond = toX(tick) + kHalfLetter * text.length > width;
    node.append(svg("text", { x: toX(tick), y: box.bottom + 14, "text-anchor": isBeyond ? "end" : "middle" }, text));
  }
  for (const tick of listOf(y, Math.max(2, height / 60))) {
    if (y.grid) {
      node.append(svg("line", { class: "axis", x1: box.left, x2: box.right, y1: toY(tick), y2: toY(tick) }));
    }
    node.append(svg("text", { x: box.left - 6, y: toY(tick) + 4, "text-anchor": "end" }, format(y)(tick)));
  }
  if (y.unit) {
    node.append(svg("text", { x: 0, y: 6, "text-anchor": "start" }, y.unit));
  }
  node.append(svg("line", { class: "base", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom }));
  parent.replaceChildren(node);
  return { node, x: toX, y: toY, box };
}

/**
 * Adds bars that can be pointed at and pressed, by mouse or key: one stop of Tab, arrows go through them.
 * @param bars  [{bin, box, hit, color, label, from, to}]
 * @param acts  onPoint(bin or null), onPress(bar)
 * @returns (bin) => marks the bar of a bin; -1 for none
 */
export function addBars(node, bars, { onPoint, onPress }) {
  const made = new Map();
  const shapes = new Map(bars.map((bar) => [bar.bin, svg("rect", { class: "bar", ...bar.box, fill: bar.color, rx: 1 })]));
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
  return (bin) => made.forEach((hit, own) => {
    shapes.get(own).classList.toggle("holds", own === bin);
    hit.setAttribute("aria-current", String(own === bin));
  });
}

/** An error bar along x, with a light rim that shows it on bars. @param ends  in numbers */
export function addWhisker({ node, x, y }, ends, at) {
  const [from, to] = ends.map(x);
  const middle = y(at);
  const path = `M${from} ${middle}H${to}M${from} ${middle - 3}v6M${to} ${middle - 3}v6`;
  node.append(svg("path", { class: "error rim", d: path, "pointer-events": "none" }), svg("path", { class: "error", d: path, "pointer-events": "none" }));
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
