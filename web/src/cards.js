// Cards of pinned organs, and how they compare.

import { classColor, kClasses, kDark, kFaint } from "./classes.js";
import { make, svg } from "./dom.js";
import { areaText, columnStyle, counted, estimate, evenly, interval, kSigned, percent, plain, unitOfColumn, withError, withUnit } from "./format.js";
import { numberNode } from "./headline.js";
import { cssOf, isKnown, kSure } from "./numbers.js";
import { kPins, pinLetter } from "./page.js";

const kMaxColumns = 60; // in "All numbers"

const iconButton = (label, path, onclick) => make("button", { type: "button", class: "icon", "aria-label": label, title: label, onclick },
  svg("svg", { viewBox: "0 0 20 20", "aria-hidden": "true" }, svg("path", { d: path })));
const kCross = "M5 5l10 10M15 5L5 15";
const kTarget = "M10 3v4M10 13v4M3 10h4M13 10h4M10 10v.1";
const kCopy = "M7 7V4h9v9h-3M4 7h9v9H4z";

const letterBadge = (i) => {
  const badge = make("span", { class: "badge" }, pinLetter(i));
  badge.style.backgroundColor = kPins[i];
  return badge;
};

/** Numbers of many digits with a few of them. */
const shortLabel = (value) => (value.length > 6 && Number.isFinite(Number(value)) ? plain(Number(value)) : value);

/** "+170 ± 9 %" against the first one, or that there is no clear difference. */
function comparedWords(one, other) {
  const difference = other.mean - one.mean;
  const error = Math.hypot(one.error || 0, other.error || 0);
  if (!(Math.abs(difference) >= kSure * error) || difference === 0) {
    return "no clear difference";
  }
  const part = Math.abs(100 * difference / one.mean);
  const own = Math.abs(100 * other.mean / one.mean) * Math.hypot(one.error / one.mean, other.error / other.mean);
  return isKnown(part, own) ? `${difference > 0 ? "+" : "−"}${withError(part, own)} %` : difference > 0 ? "more" : "less";
}

export class Cards {
  /** @param zoom  called with an organ */
  constructor(page, parent, zoom) {
    Object.assign(this, { page, parent, zoom });
  }

  draw() {
    this.shown = null;
    this.mark();
  }

  mark() {
    const { page, parent } = this;
    const key = page.state.pins.join();
    if (key === this.shown) {
      return;
    }
    const open = new Set([...parent.querySelectorAll("details[open]")].map(({ dataset }) => dataset.organ));
    this.shown = key;
    const { pins } = page;
    document.body.dataset.pins = pins.length > 0 ? "yes" : "no";
    if (pins.length === 0) {
      parent.replaceChildren();
      return;
    }
    parent.replaceChildren(
      make("div", { class: "top" }, make("h2", {}, `Pinned organs (${pins.length})`), make("span", { class: "space" }), iconButton("Unpin all", kCross, () => page.set({ pins: [] }))),
      ...(pins.length > 1 ? [this.#compared(pins)] : []),
      ...pins.map((organ, i) => this.#card(organ, i, open)));
  }

  #card(organ, i, open) {
    const { page } = this;
    const { run, values } = page;
    const { unit } = run.json;
    const labels = Object.entries(run.json.organs.labels).filter(([, { of }]) => of[organ] >= 0).map(([key, { values: all, of }]) => `${key} ${shortLabel(all[of[organ]])}`);
    const about = [run.isSensor[organ] ? run.idOf(organ) : `id ${run.idOf(organ)}`, run.isSensor[organ] ? "" : areaText(run.shape.areas[organ], unit), `${withUnit(evenly(run.shape.heights[organ], run.json.high[2] - run.json.low[2]), unit)} high`, this.#rank(organ), ...labels.slice(0, 4)];
    const text = () => `${run.organName(organ)} (id ${run.idOf(organ)}): ${page.describe(organ)}, ${run.columnName(page.column)}`;
    return make("article", { class: "card", "aria-label": run.organName(organ) },
      make("div", { class: "name" }, letterBadge(i), make("h3", {}, run.organName(organ)),
        iconButton("Zoom to it", kTarget, () => this.zoom(organ)), iconButton("Copy", kCopy, () => this.#copy(text())), iconButton(`Unpin ${run.organName(organ)}`, kCross, () => page.pin(organ))),
      make("p", { class: "about" }, about.filter(Boolean).join(" · ")),
      numberNode(values.mean[organ], values.error[organ], page.unit, this.#highOf(organ)),
      this.#sure(organ), this.#all(organ, open));
  }

  async #copy(text) {
    await navigator.clipboard?.writeText(text).catch(() => {});
    this.page.say("Copied");
  }

  #highOf(organ) {
    return this.#isDifference ? kSigned : this.page.values.high[organ];
  }

  get #isDifference() {
    return this.page.state.show === "difference";
  }

  #rank(organ) {
    const { mean } = this.page.values;
    const { isPlant } = this.page.run;
    if (!Number.isFinite(mean[organ]) || !isPlant[organ] || this.#isDifference) {
      return "";
    }
    const rank = mean.reduce((count, value, i) => count + (isPlant[i] && value > mean[organ] ? 1 : 0), 1);
    return `rank ${rank} of ${counted(isPlant.reduce((sum, one) => sum + one, 0))}`;
  }

  #sure(organ) {
    const { classes, values } = this.page;
    const number = classes[organ];
    const swatch = make("i", { class: "swatch" });
    swatch.style.backgroundColor = this.#isDifference ? cssOf(this.page.colors[organ]) : classColor(number);
    const isClear = Math.abs(values.mean[organ]) >= kSure * (values.error[organ] || 0);
    const relative = values.error[organ] / Math.abs(values.mean[organ]);
    const words = this.#isDifference ? isClear ? "a clear difference" : "no clear difference" : number === kDark ? "no light found" : number === kFaint ? "too faint to matter" : number >= kClasses.length ? "error not known"
      : relative > 0.5 ? "known to no better than 50 %" : `known to ${percent(relative)}`;
    const of = Object.fromEntries(Object.entries(values).map(([key, numbers]) => [key, numbers[organ]]));
    const ends = Number.isFinite(of.low) ? `95 %: ${interval({ ...of, isSigned: this.#isDifference })}` : "";
    return make("p", { class: "sure" }, swatch, make("span", {}, words), ends && make("span", {}, ends));
  }

  /** All quantities and bands, read when they are asked for. */
  #all(organ, open) {
    const { page } = this;
    const box = make("div", {});
    const key = page.run.idOf(organ);
    const fill = async () => {
      const { run, time } = page;
      const columns = run.columns.length <= kMaxColumns ? run.columns : run.columns.filter(({ band }) => !band || band === page.state.band);
      const found = await Promise.all(columns.map(({ number }) => run.values(time, number)));
      box.replaceChildren(make("table", {}, make("tbody", {}, columns.flatMap(({ number }, i) => (found[i] ? [make("tr", {},
        make("th", { scope: "row" }, run.columnName(number)),
        make("td", { class: "number" }, withUnit(withError(found[i].mean[organ], found[i].error[organ], found[i].high[organ]), run.unit(time, number))))] : [])))));
    };
    const details = make("details", { open: open.has(key), "data-organ": key, ontoggle: () => details.open && fill() }, make("summary", {}, "All numbers"), box);
    return details;
  }

  #compared(pins) {
    const { mean, error } = this.page.values;
    const of = (organ) => ({ mean: mean[organ], error: error[organ] });
    const style = columnStyle(this.page.values, pins, this.#isDifference);
    const rows = pins.map((organ, i) => make("tr", {}, make("th", { scope: "row" }, letterBadge(i)),
      make("td", { class: "number" }, this.#valueText(organ, style)),
      !this.#isDifference && make("td", { class: "number" }, i === 0 ? "" : comparedWords(of(pins[0]), of(organ)))));
    return make("section", { class: "card compared" }, make("h3", {}, "Compared"),
      make("table", {}, make("thead", {}, make("tr", {}, make("th", {}), make("th", { class: "number", scope: "col" }, unitOfColumn(this.page.unit, style) || "value"), !this.#isDifference && make("th", { class: "number", scope: "col" }, "against A"))), make("tbody", {}, rows)));
  }

  #valueText(organ, style) {
    const { mean, error } = this.page.values;
    const { value, error: own } = estimate(mean[organ], error[organ], this.#highOf(organ), style);
    return [value, own && make("span", { class: "error" }, ` ± ${own}`)];
  }
}
