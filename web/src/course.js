// Through the day, or along steps: pinned organs with their errors, and all plants.

import { byId, make, svg } from "./dom.js";
import { clockText, kUnknownText, unitOfColumn, withError, withUnit } from "./format.js";
import { isKnown, kSure } from "./numbers.js";
import { kPins, pinLetter } from "./page.js";
import { addBars, addUpright, keepingFocus, startPlot } from "./plot.js";

const kOfText = "currentColor";

/** The 95 % interval of an estimate: that of the result, if it has one. */
function endsOf({ mean, error, low, high }) {
  const half = error > 0 ? kSure * error : 0;
  return Number.isFinite(low) && Number.isFinite(high) ? { low, high } : { low: mean - half, high: mean + half };
}

const isSure = (one) => Boolean(one) && isKnown(one.mean, one.error);

/** What the axis spans: what is known, as the bounds of others would press it together; these where nothing is known. */
function rangeOf(estimates) {
  const found = estimates.filter((one) => one && Number.isFinite(one.mean));
  const sure = found.filter(isSure);
  return (sure.length > 0 ? sure : found).flatMap((one) => [one.mean, endsOf(one).high]);
}

/**
 * Where steps are on the axis: hours and numbers at their true distances, others one by one.
 * @returns {order, at, isTrue}: steps in their order on the axis
 */
export function positionsOf(steps) {
  const hasClock = steps.every(({ start }) => start !== null);
  const values = steps.map(({ start, hours, value }) => (hasClock ? start + hours / 2 : value));
  const isTrue = values.every(Number.isFinite) && new Set(values).size === values.length;
  const order = [...steps.keys()].sort((a, b) => (isTrue ? values[a] - values[b] : a - b));
  return { order, at: isTrue ? order.map((i) => values[i]) : order, isTrue };
}

/** Lists of neighbours that pass a test. */
function runsOf(list, passes) {
  const runs = [[]];
  list.forEach((one) => (passes(one) ? runs.at(-1).push(one) : runs.push([])));
  return runs.filter((run) => run.length > 0);
}

/**
 * A course: a line with its band, or points with error bars. What is known to no better than 50 % has a bar alone.
 * @param shift  of bars without a value, which would cover each other, in pixels
 * @returns the pixel of its letter, at its maximum; undefined for none
 */
function addCourse(plot, at, course, { isPoints, hasLine, color, shift = 0 }) {
  const { node, x, y, box } = plot;
  const inside = (pixel) => Math.min(box.bottom, Math.max(box.top, pixel));
  const known = course.map((one, i) => (one && Number.isFinite(one.mean) ? { ...one, ...endsOf(one), x: x(at[i]), y: y(one.mean) } : null));
  for (const run of runsOf(known, isSure)) {
    const edge = (key) => (one) => `${one.x},${inside(y(one[key]))}`;
    const hasDots = isPoints || run.length === 1;
    if (!hasDots) {
      node.append(svg("polygon", { class: "band", points: [...run.map(edge("high")), ...run.map(edge("low")).reverse()].join(" "), fill: color, "pointer-events": "none" }));
    }
    if (hasLine) {
      node.append(svg("polyline", { class: color === kOfText ? "mean" : "line", stroke: color, points: run.map((one) => `${one.x},${one.y}`).join(" "), "pointer-events": "none" }));
    }
    for (const one of hasDots ? run : []) {
      if (one.high > one.low) {
        addUpright(plot, one, one.x, color);
      }
      node.append(svg("circle", { class: "point", cx: one.x, cy: one.y, r: 3, fill: color }));
    }
  }
  known.filter((one) => one && !isSure(one)).forEach((one) => addUpright(plot, one, one.x + shift, color, true));
  const found = (known.some(isSure) ? known.filter(isSure) : known.filter(Boolean)).sort((one, other) => other.mean - one.mean)[0];
  return found && [found.x + (isSure(found) ? 0 : shift), inside(found.y)];
}

export class Course {
  constructor(page) {
    this.page = page;
    new ResizeObserver(() => this.draw()).observe(byId("course"));
  }

  /** Courses of organs and of all plants along the steps, as the page can have them. */
  async #read(steps) {
    const { page } = this;
    const { column } = page;
    const pins = await Promise.all(page.pins.map((organ) => page.courseOf(steps, column, organ)));
    return { pins, all: await page.meansOf(steps) };
  }

  async draw() {
    const { page } = this;
    const steps = page.timeline.bars(page.entry);
    const isThere = steps.length > 1 && page.state.show !== "difference";
    byId("course-chart").hidden = !isThere;
    byId("charts").classList.toggle("two", !isThere);
    if (!isThere || byId("course").clientWidth === 0 || !page.values) {
      return;
    }
    const asked = (this.asked = {});
    const found = await this.#read(steps);
    if (asked === this.asked) {
      this.#show(steps, found);
    }
  }

  mark() {
    const pins = this.page.state.pins.join();
    if (pins !== this.pinsShown) {
      this.pinsShown = pins;
      this.draw();
    }
  }

  time() {
    this.draw();
  }

  #show(given, { pins: givenPins, all: givenAll }) {
    const { page } = this;
    const { order, at, isTrue } = positionsOf(given);
    const [steps, all] = [given, givenAll].map((list) => order.map((i) => list[i]));
    const pins = givenPins.map((course) => order.map((i) => course?.[i] ?? null));
    const hasClock = steps[0].start !== null;
    const isPoints = page.timeline.points.includes(steps[0]);
    byId("course-title").textContent = hasClock ? "Through the day" : steps[0].by ? `By ${steps[0].by}` : `Along the ${page.timeline.kindOf(given)}`;
    const values = rangeOf([...all, ...pins.flat()]);
    byId("course-mean").hidden = !all.some(Boolean);
    if (values.length === 0) {
      byId("course-unit").textContent = "";
      byId("course").replaceChildren(make("p", {}, "Click an organ to see its course."));
      return;
    }
    const x = this.#axis(steps, at, hasClock);
    keepingFocus(byId("course"), () => {
      const plot = startPlot(byId("course"), "Through the time steps", { x, y: { low: Math.min(0, ...values), high: Math.max(...values) || 1, grid: true, ticks: 3 } });
      const isDays = page.timeline.days.includes(steps[0]) && steps[0].isDate;
      byId("course-unit").textContent = `${unitOfColumn(page.unitAt(steps), { power: plot.power.y })}${isDays ? "\u00a0d⁻¹" : ""}`;
      this.#addNow(plot, steps, at);
      const style = { isPoints, hasLine: !isPoints || isTrue };
      addCourse(plot, at, all, { ...style, color: kOfText });
      const letters = pins.map((course, i) => [addCourse(plot, at, course, { ...style, color: kPins[i], shift: 4 * (i - (pins.length - 1) / 2) }), i]);
      letters.forEach(([top, i]) => top && plot.node.append(svg("circle", { cx: top[0], cy: top[1], r: 8, fill: kPins[i] }), svg("text", { class: "letter", x: top[0], y: top[1] }, pinLetter(i))));
      this.#addHits(plot, steps, at, { pins, all });
    });
  }

  #axis(steps, at, hasClock) {
    const [low, high] = [Math.min(...at), Math.max(...at)];
    const beside = 0.04 * (high - low);
    return hasClock ? { low: Math.floor(low - 0.5), high: Math.ceil(high + 0.5), format: clockText, ticks: this.#hours(low, high) }
      : { low: low - beside, high: high + beside, format: (x) => steps[at.indexOf(x)].short, ticks: at };
  }

  #hours(low, high) {
    const step = [1, 2, 3, 6].find((hours) => (high - low) / hours <= Math.max(3, byId("course").clientWidth / 75)) ?? 6;
    return Array.from({ length: 25 }, (_, i) => i).filter((hour) => hour % step === 0 && hour >= low - 0.5 && hour <= high + 0.5);
  }

  /** A band behind the time that is shown. */
  #addNow({ node, x, box }, steps, at) {
    const i = steps.findIndex(({ key }) => key === this.page.entry.key);
    if (i >= 0) {
      const { start, hours } = steps[i];
      const [from, to] = start !== null ? [x(start), x(start + Math.max(hours, 0.2))] : [x(at[i]) - 8, x(at[i]) + 8];
      const left = Math.max(box.left, from);
      node.prepend(svg("rect", { class: "now", x: left, width: Math.max(2, Math.min(box.right, to) - left), y: box.top, height: box.bottom - box.top }));
    }
  }

  /** Each step can be pointed at, to read its numbers, and pressed, to show it. */
  #addHits({ node, x, box }, steps, at, { pins, all }) {
    const { page } = this;
    const edge = (i, other) => (at[other] === undefined ? x(at[i]) + 8 * (other - i) : (x(at[i]) + x(at[other])) / 2);
    const textOf = (one) => withError(one.mean, one.error, one.high);
    const bars = steps.map((step, i) => {
      const parts = [["mean of all organs", all[i]], ...pins.map((course, k) => [`${pinLetter(k)} ${page.run.organName(page.pins[k])}`, course[i]])];
      const words = parts.filter(([, one]) => one && Number.isFinite(one.mean)).map(([name, one]) => `${name} ${textOf(one)}`);
      const from = Math.max(box.left, edge(i, i - 1));
      return { bin: i, step, label: `${step.name}: ${words.length > 0 ? withUnit(words.join(", "), page.unitAt(steps)) : kUnknownText}`, hit: { x: from, width: Math.max(1, Math.min(box.right, edge(i, i + 1)) - from), y: box.top, height: box.bottom - box.top } };
    });
    addBars(node, bars, {
      onPoint: (bar) => (byId("shown").textContent = bar ? bar.label : page.shownWords()),
      onPress: ({ step }) => page.goTo(step),
    });
  }
}
