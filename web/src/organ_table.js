// The table of organs: by value, or by what costs precision.

import { classColor } from "./classes.js";
import { roving } from "./choice.js";
import { make } from "./dom.js";
import { columnStyle, counted, evenly, interval, kSigned, unitOfColumn, unitText, withError } from "./format.js";
import { cssOf, isKnown, kSure, lowerMedian } from "./numbers.js";
import { kPins, pinLetter } from "./page.js";

const kPrinted = 60; // rows on paper
const kRows = 200; // in the document at a time

/**
 * Organs that are shown by a key, the greatest first; those without one, NaN or "", last.
 * @param up  the least first  @param isReversed  the other way round
 */
export function organsInOrder(isShown, { of, up }, isReversed = false) {
  const all = [...isShown.keys()].filter((i) => isShown[i]);
  const keys = all.map(of);
  const isMissing = (key) => key === "" || Number.isNaN(key);
  const compare = typeof keys[0] === "string" ? (a, b) => a.localeCompare(b) : (a, b) => a - b;
  const sign = Boolean(up) === isReversed ? -1 : 1;
  const order = [...all.keys()].sort((a, b) => isMissing(keys[a]) - isMissing(keys[b]) || (isMissing(keys[a]) ? 0 : sign * compare(keys[a], keys[b])) || a - b);
  return order.map((i) => all[i]);
}

const isPhone = () => matchMedia("(max-width: 640px) and (min-height: 480px)").matches;

/** What fits beside the names on a phone first: the value and its error. */
const valueFirst = ({ organ, value, error, ...others }) => ({ organ, value, ...(error && { error }), ...others });

/** Numbers of some organs with the same decimals: `digits` of the usual one. */
function evenOf(of, organs, digits) {
  const usual = lowerMedian(organs.map((i) => Math.abs(of(i))));
  return (i) => (Number.isFinite(of(i)) ? evenly(of(i), usual, digits) : "");
}

/** A column of parts of a whole, in per cent. */
const partColumn = (title, of, organs, isIn) => ({ title, unit: "%", of: (i) => (isIn(i) ? of(i) : NaN), text: evenOf((i) => (isIn(i) ? 100 * of(i) : NaN), organs, 2), isNumber: true });

function areaColumn({ json, isSensor, shape: { areas } }, organs) {
  const isSmall = json.unit === "m" && lowerMedian(organs.map((i) => areas[i])) < 0.1;
  const text = evenOf((i) => (isSensor[i] ? NaN : areas[i] * (isSmall ? 1e4 : 1)), organs, 3);
  return { title: "Area", unit: isSmall ? "cm²" : json.unit && `${unitText(json.unit)}²`, of: (i) => areas[i], text, isNumber: true };
}

/** The value with its error, its interval and what follows from it. */
function valueColumns({ run, values, total, page, organs }) {
  const { mean, error, low, high } = values;
  const { show } = page.state;
  const isDifference = show === "difference";
  const style = columnStyle(values, organs, isDifference);
  const unit = unitOfColumn(page.unit, style);
  const sure = (number) => (i) => (isDifference || isKnown(mean[i], error[i]) ? number(i) : NaN);
  const relative = (i) => error[i] / Math.abs(mean[i]);
  const percents = evenOf((i) => 100 * relative(i), organs.filter((i) => isKnown(mean[i], error[i])), 2);
  const isClear = (i) => (Number.isFinite(mean[i]) ? Math.abs(mean[i]) >= kSure * error[i] ? "clear" : "not clear" : "");
  const weight = (i) => run.weightOf(page.column, i);
  return {
    value: { title: run.columnName(page.column), unit, of: sure((i) => mean[i]), text: (i) => withError(mean[i], error[i], isDifference ? kSigned : high[i], style), isNumber: true },
    interval: { title: "95 % interval", unit, text: (i) => interval({ mean: mean[i], error: error[i], low: low[i], high: high[i], isSigned: isDifference }, style), isNumber: true },
    ...(isDifference ? { clear: { title: "Difference is", of: (i) => Math.abs(mean[i]) / error[i], text: isClear } } : {
      error: { title: "Error", unit: "%", of: relative, text: (i) => (relative(i) > 0.5 ? "> 50" : mean[i] === 0 ? "" : percents(i)), isNumber: true },
      share: partColumn("Share of all", sure((i) => (mean[i] * weight(i)) / total), organs, (i) => run.isPlant[i]),
    }),
    ...(show === "error" && { cost: partColumn("Costs precision", (i) => (error[i] * weight(i)) / Math.abs(total), organs, (i) => run.isPlant[i]) }),
  };
}

/** The columns: a title, its unit, how organs are sorted by it, and a cell. */
export function columnsOf(page) {
  const { run, values, total } = page;
  const { heights } = run.shape;
  const { labels } = run.json.organs;
  const organs = [...page.isShown.keys()].filter((i) => page.isShown[i]);
  const span = run.json.high[2] - run.json.low[2];
  return {
    organ: { title: "Organ", of: (i) => i, up: true, text: null },
    ...(labels.kind || labels.class || run.organCount < run.count ? { kind: { title: "Kind", of: (i) => run.kindOf(i), up: true, text: (i) => run.kindOf(i) } } : {}),
    area: areaColumn(run, organs),
    height: { title: "Height", unit: run.json.unit, of: (i) => heights[i], text: (i) => evenly(heights[i], span), isNumber: true },
    ...valueColumns({ run, values, total, page, organs }),
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
    page.total = page.values.mean.reduce((sum, mean, i) => sum + (Number.isFinite(mean) && page.run.isPlant[i] ? mean * page.run.weightOf(page.column, i) : 0), 0);
    const columns = isPhone() ? valueFirst(columnsOf(page)) : columnsOf(page);
    const [, minus, asked] = /^(-?)(.*)$/.exec(page.state.sort);
    const key = columns[asked] ? asked : page.state.show === "error" ? "cost" : "value";
    const isReversed = minus !== "" && key === asked;
    this.order = organsInOrder(page.isShown, columns[key], isReversed);
    this.rows = make("tbody");
    roving(this.rows, ".link", (now) => this.rows.querySelectorAll(".link").forEach((link) => (link.tabIndex = link === now ? 0 : -1)));
    const head = Object.entries(columns).map(([name, { title, unit, of, isNumber, up }]) =>
      make("th", { scope: "col", class: isNumber && "number", "aria-sort": name === key && (Boolean(up) === isReversed ? "descending" : "ascending") },
        of ? make("button", { type: "button", "data-column": name, onclick: () => this.#sortBy(name === key && !isReversed ? `-${name}` : name) }, title) : make("span", {}, title),
        unit && make("small", {}, unit)));
    const focused = this.parent.contains(document.activeElement) ? document.activeElement.dataset.column : undefined;
    this.more = make("p", { class: "more" });
    this.parent.replaceChildren(make("table", {}, make("thead", {}, make("tr", {}, head)), this.rows), this.more);
    this.columns = columns;
    this.#fill();
    this.parent.querySelector(`[data-column="${focused}"]`)?.focus();
  }

  #sortBy(sort) {
    this.isOld = true;
    this.page.set({ sort, tab: "table" });
  }

  #fill() {
    const { order, from, most } = this;
    const rows = order.slice(from, from + most).map((organ, i) => this.#row(organ, i === 0));
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

  /** One organ: of all names, one takes part in the order of Tab, and arrows go through them. */
  #row(organ, isFirst) {
    const { page } = this;
    const cells = Object.entries(this.columns).map(([name, { text, isNumber }]) =>
      name === "organ" ? make("td", {}, make("span", { class: "mark" }), make("button", {
        type: "button", class: "link", tabindex: isFirst ? 0 : -1, onclick: () => page.pin(organ), onfocus: () => page.hover(organ), onblur: () => page.hover(null) }, page.run.organName(organ)))
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
