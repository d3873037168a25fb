// Filters in the panel: chips and lists of labels, ranges, and what the charts have filtered.

import { make } from "./dom.js";
import { isFiltered, isRange, noFilters, usefulLabels } from "./filters.js";
import { plain, withUnit } from "./format.js";
import { kClasses } from "./classes.js";
import { field, section } from "./panel.js";

const kMaxChips = 12; // values of a label as chips
const kMaxListed = 200; // values in a list at a time
const kFirstLabels = 3; // labels that are not folded away

const letters = new Intl.Collator(undefined, { numeric: true });

export class FilterSection {
  constructor(page) {
    this.page = page;
  }

  build() {
    const { page } = this;
    const { labels } = page.run.json.organs;
    const keys = usefulLabels(labels);
    this.drawers = [];
    this.active = make("div", { class: "chips field", id: "active" });
    this.clear = make("button", { type: "button", class: "link", onclick: () => page.set(noFilters()) }, "Clear filters");
    const isIndex = (key) => key.length === 1; // i and j of arrays and grids
    const first = keys.filter((key) => !isIndex(key)).slice(0, kFirstLabels);
    const others = keys.filter((key) => !first.includes(key));
    const fieldsOf = (some) => some.map((key) => this.#field(key, labels[key], isIndex(key)));
    const fields = fieldsOf(first);
    const more = others.length > 0 ? make("details", {}, make("summary", {}, "More labels"), fieldsOf(others)) : null;
    const none = keys.length === 0 && make("p", { class: "soft field" }, "Organs have no labels. Click a bar of a chart to filter.");
    return section("Filter", true, this.active, make("div", { class: "field" }, this.clear), none, fields, more);
  }

  #field(key, label, isIndex) {
    const name = isIndex ? `Index ${key}` : key[0].toUpperCase() + key.slice(1);
    if (isRange(label)) {
      return field(name, this.#range(key, label));
    }
    const counts = new Array(label.values.length).fill(0);
    label.of.forEach((value) => value >= 0 && ++counts[value]);
    const inOrder = [...label.values.keys()].sort((a, b) => letters.compare(label.values[a], label.values[b]));
    const values = inOrder.map((i) => ({ value: label.values[i], count: counts[i] }));
    return field(name, values.length <= kMaxChips ? this.#chips(key, values) : this.#list(key, values));
  }

  #toggle(key, value) {
    const chosen = this.page.state.labels[key] ?? [];
    const now = chosen.includes(value) ? chosen.filter((other) => other !== value) : [...chosen, value];
    this.page.set({ labels: { ...this.page.state.labels, [key]: now } });
  }

  #chip(key, { value, count }) {
    const chip = make("button", { type: "button", class: "chip", "aria-pressed": "false", title: value, onclick: () => this.#toggle(key, value) },
      value || "(empty)", " ", make("small", {}, String(count)));
    this.drawers.push(({ labels }) => chip.setAttribute("aria-pressed", String((labels[key] ?? []).includes(value))));
    return chip;
  }

  #chips(key, values) {
    return make("div", { class: "chips", role: "group", "aria-label": key }, values.map((value) => this.#chip(key, value)));
  }

  /** Chosen values as chips, and a list of those that have the typed letters. */
  #list(key, values) {
    const list = make("div", { class: "chips pick", role: "group", "aria-label": key });
    const input = make("input", { type: "text", class: "text", "aria-label": `Find ${key}`, placeholder: `Find among ${values.length}`, oninput: () => fill() });
    const drawers = [];
    const fill = () => {
      const text = input.value.trim().toLowerCase();
      const chosen = this.page.state.labels[key] ?? [];
      const found = values.filter(({ value }) => chosen.includes(value) || (text && value.toLowerCase().includes(text))).slice(0, kMaxListed);
      const before = this.drawers;
      this.drawers = [];
      list.replaceChildren(...(found.length > 0 ? [this.#chips(key, found)] : text ? [make("span", { class: "soft" }, "No value has these letters.")] : []));
      drawers.splice(0, drawers.length, ...this.drawers);
      this.drawers = before;
      drawers.forEach((draw) => draw(this.page.state));
    };
    this.drawers.push(fill);
    return [input, list];
  }

  /** Two ends of a numeric label. */
  #range(key, { values }) {
    const numbers = values.map(Number);
    const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
    const end = (k, name) => make("input", {
      type: "text", inputmode: "decimal", "aria-label": `${key} ${name}`, placeholder: `${name} ${plain([low, high][k], 3)}`,
      onchange: () => this.#setRange(key, ends, [low, high]),
    });
    const ends = [end(0, "from"), end(1, "to")];
    this.drawers.push(({ ranges }) => ends.forEach((input, k) => {
      input.value = ranges[key] && ranges[key][k] !== [low, high][k] ? plain(ranges[key][k], 3) : "";
    }));
    return make("div", { class: "ends" }, ends);
  }

  #setRange(key, inputs, usual) {
    const read = inputs.map((input, k) => {
      const number = Number(input.value.replace(/[\s,]/g, "").replace("−", "-"));
      return input.value.trim() && Number.isFinite(number) ? number : usual[k];
    });
    const ranges = { ...this.page.state.ranges };
    delete ranges[key];
    this.page.set({ ranges: read.some((x, k) => x !== usual[k]) ? { ...ranges, [key]: read } : ranges });
  }

  draw() {
    const { page } = this;
    const { state, run } = page;
    this.drawers.forEach((draw) => draw(state));
    const chip = (text, changes) => make("button", { type: "button", class: "chip on", "aria-label": `Remove the filter ${text}`, onclick: () => page.set(changes) }, `${text} ✕`);
    const ends = ([low, high], unit) => `${plain(low)} – ${withUnit(plain(high), unit)}`;
    this.active.replaceChildren(...[
      state.values && chip(`Value ${ends(state.values, page.unit)}`, { values: null }),
      state.layer && chip(`Height ${ends(state.layer, run.json.unit)}`, { layer: null }),
      state.errorClass !== null && chip(`Error ${kClasses[state.errorClass]?.name ?? "unknown"}`, { errorClass: null }),
    ].filter(Boolean));
    this.active.hidden = this.active.children.length === 0;
    this.clear.parentElement.hidden = !isFiltered(state);
  }
}
