// The table of organs: by value, or by what costs precision.

import { classColor } from "./classes.js";
import { byId, make } from "./dom.js";
import { areaText, counted, evenly, interval, percent, plain, withError } from "./format.js";
import { cssOf, isKnown, kSure } from "./numbers.js";
import { kPins, pinLetter } from "./page.js";

const kPrinted = 60; // rows on paper
const kRows = 200; // in the document at a time

/** Organs that are shown by a key, the greatest first; those without one, NaN, last. @param up  the least first */
export function organsInOrder(isShown, { of, up }) {
  const all = [...isShown.keys()].filter((i) => isShown[i]);
  const keys = all.map(of);
  const compare = typeof keys[0] === "string" ? (a, b) => a.localeCompare(b)
    : (a, b) => (Number.isNaN(a) ? -Infinity : a) - (Number.isNaN(b) ? -Infinity : b) || 0;
  const order = [...all.keys()].sort((a, b) => (up ? 1 : -1) * compare(keys[a], keys[b]) || a - b);
  return order.map((i) => all[i]);
}

const isPhone = () => matchMedia("(max-width: 640px) and (min-height: 480px)").matches;

/** What fits beside the names on a phone first: the value and its error. */
const valueFirst = ({ organ, value, error, ...others }) => ({ organ, value, ...(error && { error }), ...others });

/** The columns: a title, how organs are sorted by it, and a cell. */
export function columnsOf(page) {
  const { run, values, total } = page;
  const { mean, error, low, high } = values;
  const { areas, heights } = run.shape;
  const { unit } = run.json;
  const relative = (i) => error[i] / Math.abs(mean[i]);
  const isDifference = page.state.show === "difference";
  const sure = (number) => (i) => (isDifference || isKnown(mean[i], error[i]) ? number(i) : NaN);
  const relativeError = { title: "Error", of: relative, text: (i) => (relative(i) > 0.5 ? "over 50 %" : mean[i] === 0 ? "" : percent(relative(i))), isNumber: true };
  const share = { title: "Share of all", of: sure((i) => mean[i] * areas[i]), text: (i) => (run.isPlant[i] ? percent((mean[i] * areas[i]) / total) : ""), isNumber: true };
  const isClear = (i) => (Number.isFinite(mean[i]) ? Math.abs(mean[i]) >= kSure * error[i] ? "clear" : "not clear" : "");
  const clear = { title: "Difference is", of: (i) => Math.abs(mean[i]) / error[i], text: isClear };
  return {
    organ: { title: "Organ", of: (i) => i, up: true, text: null },
    ...(run.json.organs.labels.kind || run.json.organs.labels.class || run.organCount < run.count ? { kind: { title: "Kind", of: (i) => run.kindOf(i), up: true, text: (i) => run.kindOf(i) } } : {}),
    area: { title: "Area", of: (i) => areas[i], text: (i) => (run.isSensor[i] ? "" : areaText(areas[i], unit)), isNumber: true },
    height: { title: unit ? `Height, ${unit}` : "Height", of: (i) => heights[i], text: (i) => evenly(heights[i], run.json.high[2] - run.json.low[2]), isNumber: true },
    value: { title: `${run.columnName(page.column)}${page.unit && `, ${page.unit}`}`, of: sure((i) => mean[i]), text: (i) => withError(mean[i], error[i], isDifference ? undefined : high[i]), isNumber: true },
    interval: { title: "95 % interval", text: (i) => interval(low[i], high[i], error[i]), isNumber: true },
    ...(isDifference ? { clear } : { error: relativeError, share }),
    ...(page.state.show !== "error" ? {} : { cost: { title: "Costs precision", of: (i) => (run.isPlant[i] ? error[i] * areas[i] : NaN), text: (i) => (run.isPlant[i] ? percent((error[i] * areas[i]) / Math.abs(total)) : ""), isNumber: true } }),
  };
}

export class OrganTable {
  constructor(page, parent) {
    Object.assign(this, { page, parent, from: 0 });
  }

  draw() {
    this.from = 0;
    this.isOld = true;
    this.show();
  }

  fold() {
    this.show();
  }

  /** The first rows, for paper. */
  print() {
    this.#build(kPrinted);
    const others = this.order.length - kPrinted;
    this.more.replaceChildren(...(others > 0 ? [`${counted(others)} more: save the table as CSV.`] : []));
    this.isOld = true;
  }

  /** Fills the table, if it is seen. */
  show() {
    if (this.isOld && this.page.values && !this.parent.hidden && this.parent.clientHeight > 0) {
      this.isOld = false;
      this.#build(kRows);
    }
  }

  #build(most) {
    const { page } = this;
    this.most = most;
    const { areas } = page.run.shape;
    page.total = page.values.mean.reduce((sum, mean, i) => sum + (Number.isFinite(mean) && page.run.isPlant[i] ? mean * areas[i] : 0), 0);
    const columns = isPhone() ? valueFirst(columnsOf(page)) : columnsOf(page);
    const key = columns[page.state.sort] ? page.state.sort : page.state.show === "error" ? "cost" : "value";
    this.order = organsInOrder(page.isShown, columns[key]);
    this.rows = make("tbody");
    const head = Object.entries(columns).map(([name, { title, of, isNumber, up }]) =>
      make("th", { scope: "col", class: isNumber && "number", "aria-sort": name === key && (up ? "ascending" : "descending") },
        of ? make("button", { type: "button", onclick: () => this.#sortBy(name) }, title) : title));
    this.more = make("p", { class: "more" });
    this.parent.replaceChildren(make("table", {}, make("thead", {}, make("tr", {}, head)), this.rows), this.more);
    this.columns = columns;
    this.#fill();
  }

  #sortBy(sort) {
    this.isOld = true;
    this.page.set({ sort, tab: "table" });
  }

  #fill() {
    const { order, from, most } = this;
    const rows = order.slice(from, from + most).map((organ) => this.#row(organ));
    this.rows.replaceChildren(...rows);
    const button = (text, to) => make("button", { type: "button", class: "button", onclick: () => {
      this.from = to;
      this.#fill();
      this.parent.scrollTop = 0;
    } }, text);
    this.more.replaceChildren(...(order.length > most ? [
      `Rows ${counted(from + 1)} to ${counted(Math.min(order.length, from + most))} of ${counted(order.length)}. `,
      ...(from > 0 ? [button("Previous", from - most)] : []), " ", ...(from + most < order.length ? [button("Next", from + most)] : [])] : []));
    this.mark();
  }

  #row(organ) {
    const { page } = this;
    const cells = Object.entries(this.columns).map(([name, { text, isNumber }]) =>
      name === "organ" ? make("td", {}, make("span", { class: "mark" }), make("button", { type: "button", class: "link", onclick: () => page.pin(organ) }, page.run.organName(organ)))
        : make("td", { class: isNumber && "number" }, text(organ)));
    return make("tr", { "data-organ": organ, onpointerenter: () => page.hover(organ), onpointerleave: () => page.hover(null) }, cells);
  }

  /** Letters of pinned organs, colours of others. */
  mark() {
    const { page } = this;
    this.rows?.querySelectorAll("tr").forEach((row) => {
      const organ = Number(row.dataset.organ);
      const pin = page.pins.indexOf(organ);
      const isSame = row.dataset.pin === String(pin) && row.dataset.color === String(page.colors[organ]);
      if (!isSame) {
        Object.assign(row.dataset, { pin, color: page.colors[organ] });
        row.classList.toggle("pinned", pin >= 0);
        const mark = make("i", { class: pin >= 0 ? "badge" : "swatch" }, pin >= 0 ? pinLetter(pin) : null);
        mark.style.backgroundColor = pin >= 0 ? kPins[pin] : page.state.show === "error" ? classColor(page.classes[organ]) : cssOf(page.colors[organ]);
        row.querySelector(".mark").replaceChildren(mark);
      }
    });
  }
}

/** The table of the organs that are shown as comma-separated values. */
export function tableText(page) {
  const { run, values, isShown } = page;
  const quote = (text) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const unit = page.unit ? ` [${page.unit}]` : "";
  const head = ["id", "organ", "kind", "area", "height", `${run.columnName(page.column)}${unit}`, "standard error", "95 % low", "95 % high"];
  const rows = [...isShown.keys()].filter((i) => isShown[i]).map((i) => [
    run.idOf(i), run.organName(i), run.kindOf(i), run.shape.areas[i], run.shape.heights[i], values.mean[i], values.error[i], values.low[i], values.high[i]]);
  const cell = (value) => quote(typeof value === "number" ? (Number.isFinite(value) ? String(Number(value.toPrecision(7))) : "") : value);
  return [head, ...rows].map((row) => row.map(cell).join(",")).join("\n") + "\n";
}
