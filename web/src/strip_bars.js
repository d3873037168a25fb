// The picture of the strip of times: a bar for each, the night, days above, and pinned organs.

import { svg } from "./dom.js";
import { clockText } from "./format.js";
import { kPins } from "./page.js";

const kMaxBars = 200; // then an area
const kMaxWide = 32; // of bars without hours, pixels
const kMaxApart = 96; // of their middles

/** {from, to}: the span of each step on the axis, from 0 to 1. */
function spansOf(steps, hasClock, width) {
  const n = Math.max(steps.length, width / kMaxApart);
  return steps.map(({ start, hours }, i) => (hasClock ? { from: start / 24, to: Math.min(1, (start + Math.max(hours, 0.25)) / 24) } : { from: i / n, to: (i + 1) / n }));
}

/** Hours without a step: the night, or what is still to come. */
function addNight({ page, node, spans, width, top, bottom }) {
  let at = 0;
  for (const { from, to } of [...spans, { from: 1, to: 1 }]) {
    if (from - at > 0.02) {
      const isToCome = page.live?.follow && from === 1;
      node.append(svg("rect", { class: isToCome ? "unknown" : "night", x: at * width, width: (from - at) * width - 1, y: isToCome ? bottom - 4 : top, height: isToCome ? 4 : bottom - top, rx: 2 }));
      if ((from - at) * width > 60 && !isToCome) {
        node.append(svg("text", { x: ((at + from) / 2) * width, y: (top + bottom) / 2 + 4, "text-anchor": "middle" }, "night"));
      }
    }
    at = Math.max(at, to);
  }
}

function addSteps({ page: { entry }, steps, hasClock, node, spans, lights, width, top, bottom, y }) {
  steps.forEach((step, i) => {
    const whole = Math.max(1.5, (spans[i].to - spans[i].from) * width - 1);
    const wide = hasClock ? whole : Math.min(whole, kMaxWide);
    const x = spans[i].from * width + 0.5 + (whole - wide) / 2;
    const isKnown = Number.isFinite(lights[i]);
    const isChosen = step.key === entry.key;
    if (isChosen) {
      node.append(svg("rect", { class: "frame", x: x - 1, width: wide + 2, y: top - 1, height: bottom - top + 1, rx: 3 }));
    }
    const end = isKnown ? y(lights[i]) : bottom - 5;
    node.append(svg("rect", { class: `${isKnown ? "step" : "unknown"}${isChosen ? " chosen" : ""}`, x, width: wide, y: end, height: bottom - end, rx: 1 }));
  });
}

function addArea({ page, steps, node, spans, lights, width, top, bottom, y }) {
  const points = steps.flatMap((_, i) => [`${spans[i].from * width},${y(lights[i] || 0)}`, `${spans[i].to * width},${y(lights[i] || 0)}`]);
  node.append(svg("polygon", { class: "step", points: [`0,${bottom}`, ...points, `${width},${bottom}`].join(" ") }));
  const at = steps.indexOf(page.entry);
  if (at >= 0) {
    node.append(svg("rect", { class: "frame", x: spans[at].from * width - 2, width: 4, y: top - 1, height: bottom - top + 1 }));
  }
}

function addTicks({ steps, hasClock, node, spans, width, bottom }) {
  const text = (x, words, anchor = "middle") => node.append(svg("text", { x, y: bottom + 13, "text-anchor": anchor }, words));
  if (hasClock) {
    const step = width > 700 ? 3 : 6;
    for (let hour = 0; hour <= 24; hour += step) {
      text((hour / 24) * width, clockText(hour), hour === 0 ? "start" : hour === 24 ? "end" : "middle");
    }
    return;
  }
  const half = (short) => 3.2 * short.length;
  let end = -Infinity; // of the last text: those that would touch it are left out
  steps.forEach(({ short }, i) => {
    const x = Math.min(width - half(short), Math.max(half(short), ((spans[i].from + spans[i].to) / 2) * width));
    if (x - half(short) >= end + 12 && 2 * half(short) <= width) {
      text(x, short);
      end = x + half(short);
    }
  });
}

/** A row of day sums above the hours. */
function addDays({ page, node, width }) {
  const { timeline: { days }, entry } = page;
  const lights = days.map((day) => page.dayLight(day));
  const most = Math.max(...lights, 1e-30);
  days.forEach((day, i) => {
    const high = Math.max(1, (14 * lights[i]) / most);
    const isChosen = day === entry || day.date === entry.date;
    node.append(svg("rect", { class: `step day${isChosen ? " chosen" : ""}`, x: (i / days.length) * width + 0.5, width: Math.max(1, width / days.length - 1), y: 15 - high, height: high }));
  });
}

/** Adds the courses of pinned organs as lines. @param picture  see stripPicture */
export async function addPins({ page, steps, node, spans, width, top, bottom }) {
  for (const [i, organ] of page.pins.entries()) {
    const course = (await page.courseOf(steps, page.column, organ)).map((one) => one?.mean ?? NaN);
    const most = Math.max(...course.filter(Number.isFinite), 1e-30);
    const points = course.flatMap((mean, k) => (Number.isFinite(mean) ? [`${((spans[k].from + spans[k].to) / 2) * width},${bottom - ((bottom - top) * mean) / most}`] : []));
    node.append(svg("polyline", { class: "pin", stroke: kPins[i], points: points.join(" ") }));
  }
}

/**
 * The picture of entries of the timeline.
 * @param width, high  of all, and of the highest bar, CSS pixels
 * @returns {page, steps, node, spans, width, top, bottom, ...}: the svg element, the span of each entry from 0 to 1, and the ends of bars
 */
export function stripPicture(page, steps, width, high) {
  const hasDays = page.timeline.days.length > 1 && steps !== page.timeline.points;
  const hasClock = steps.every(({ start }) => start !== null);
  const top = hasDays ? 20 : 2;
  const bottom = top + high;
  const lights = steps.map((step) => page.lightOf(step));
  const most = Math.max(...lights.filter(Number.isFinite), 1e-30);
  const node = svg("svg", { width, height: bottom + 18, "aria-hidden": "true" });
  const picture = { page, steps, hasClock, node, spans: spansOf(steps, hasClock, width), lights, width, top, bottom, y: (light) => bottom - Math.max(1, (high * light) / most) };
  if (hasClock) {
    addNight(picture);
  }
  steps.length > kMaxBars ? addArea(picture) : addSteps(picture);
  node.append(svg("line", { class: "base", x1: 0, x2: hasClock ? width : width * picture.spans.at(-1).to, y1: bottom, y2: bottom }));
  addTicks(picture);
  if (hasDays) {
    addDays(picture);
  }
  return picture;
}
