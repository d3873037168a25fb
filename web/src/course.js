// Through the day, or along steps: pinned organs with their errors, and all plants.

import { byId, make, svg } from "./dom.js";
import { clockText } from "./format.js";
import { kPins, pinLetter } from "./page.js";
import { startPlot } from "./plot.js";
import { quantityName } from "./data.js";
import { kSure } from "./numbers.js";

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

  #show(steps, { pins, all }) {
    const { page } = this;
    const hasClock = steps.every(({ start }) => start !== null);
    const at = steps.map(({ start, hours }, i) => (hasClock ? start + hours / 2 : i));
    byId("course-title").textContent = hasClock ? "Through the day" : steps[0].by ? `By ${steps[0].by}` : `Along the ${page.timeline.kindOf(steps)}`;
    const isDays = page.timeline.days.includes(steps[0]) && steps[0].isDate;
    byId("course-unit").textContent = `${page.unitAt(steps)}${isDays ? "\u00a0d⁻¹" : ""}`;
    const isSure = ({ mean, error }) => error > 0 && error < 0.5 * Math.abs(mean); // others would press all together
    const values = [...all, ...pins.flat()].filter(Boolean).flatMap((one) => [one.mean, one.mean + (isSure(one) ? kSure * one.error : 0)]).filter(Number.isFinite);
    if (values.length === 0) {
      byId("course").replaceChildren(make("p", {}, "Click an organ to see its course."));
      return;
    }
    const x = hasClock ? { low: Math.floor(Math.min(...at) - 0.5), high: Math.ceil(Math.max(...at) + 0.5), format: clockText, ticks: this.#hours(at) }
      : { low: 0, high: steps.length - 1, format: (i) => steps[i]?.short ?? "", ticks: this.#few(steps.length) };
    const plot = startPlot(byId("course"), "Through the time steps", { x, y: { low: Math.min(0, ...values), high: Math.max(...values) || 1, grid: true, ticks: 3 } });
    this.#addNow(plot, steps);
    this.#addMean(plot, at, all);
    const letters = pins.map((course, i) => this.#addPin(plot, at, course, i));
    plot.node.append(...letters.flat());
  }

  #hours(at) {
    const step = [1, 2, 3, 6].find((hours) => (Math.max(...at) - Math.min(...at)) / hours <= Math.max(3, byId("course").clientWidth / 75)) ?? 6;
    return Array.from({ length: 25 }, (_, i) => i).filter((hour) => hour % step === 0 && hour >= Math.min(...at) - 0.5 && hour <= Math.max(...at) + 0.5);
  }

  #few(count) {
    const step = Math.max(1, Math.ceil(count / 6));
    return Array.from({ length: count }, (_, i) => i).filter((i) => i % step === 0);
  }

  /** A band behind the time that is shown. */
  #addNow({ node, x, box }, steps) {
    const i = steps.findIndex(({ key }) => key === this.page.entry.key);
    if (i >= 0) {
      const { start, hours } = steps[i];
      const [from, to] = start !== null ? [start, start + Math.max(hours, 0.2)] : [i - 0.3, i + 0.3];
      const left = Math.max(box.left, x(from));
      node.prepend(svg("rect", { class: "now", x: left, width: Math.max(2, Math.min(box.right, x(to)) - left), y: box.top, height: box.bottom - box.top }));
    }
  }

  #addMean({ node, x, y, box }, at, all) {
    const points = all.flatMap((found, i) => (found ? [[x(at[i]), y(found.mean)]] : []));
    node.append(svg("polyline", { class: "mean", points: points.map((point) => point.join()).join(" ") }));
    if (points.length > 0) {
      const name = quantityName(this.page.run.json.columns[this.page.column]);
      const isRight = points[0][0] > (box.left + box.right) / 2;
      node.append(svg("text", { x: points[0][0], y: 8, "text-anchor": isRight ? "end" : "start" }, "mean of all organs", svg("title", {}, name)));
    }
  }

  /** A line with its band. @returns nodes of its letter, at the maximum */
  #addPin({ node, x, y, box }, at, course, i) {
    const known = course.flatMap((one, k) => (one && Number.isFinite(one.mean) ? [{ ...one, at: at[k] }] : []));
    if (known.length === 0) {
      return [];
    }
    const inside = (pixel) => Math.min(box.bottom, Math.max(box.top, pixel));
    const edge = (one, sign) => `${x(one.at)},${inside(y(one.mean + sign * (one.error > 0 ? kSure * one.error : 0)))}`;
    node.append(svg("polygon", { points: [...known.map((one) => edge(one, 1)), ...known.map((one) => edge(one, -1)).reverse()].join(" "), fill: kPins[i], "fill-opacity": 0.2 }));
    node.append(svg("polyline", { class: "line", stroke: kPins[i], points: known.map((one) => `${x(one.at)},${y(one.mean)}`).join(" ") }));
    const top = known.reduce((best, one) => (one.mean > best.mean ? one : best));
    return [svg("circle", { cx: x(top.at), cy: y(top.mean), r: 8, fill: kPins[i] }), svg("text", { class: "letter", x: x(top.at), y: y(top.mean) }, pinLetter(i))];
  }
}
