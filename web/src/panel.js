// The panel beside the scene: headline, colours, view. Filters are in filter_panel.js.

import { Check, Choice } from "./choice.js";
import { CompareField } from "./compare_field.js";
import { bandName, quantityName } from "./data.js";
import { make } from "./dom.js";
import { FilterSection } from "./filter_panel.js";
import { plain, withUnit } from "./format.js";
import { Headline } from "./headline.js";

const kViews = [["Oblique", 200, 14], ["Front", 180, 0], ["Right", 90, 0], ["Back", 0, 0], ["Left", 270, 0], ["Top", 180, 90]];
const kMaxButtons = 4; // bands as buttons

/** A section that folds, and remembers it as long as the browser lets it. */
export function section(title, isOpen, ...children) {
  const key = `quasimc-${title}`;
  const read = () => {
    try {
      return localStorage.getItem(key);
    } catch {
      return null;
    }
  };
  const node = make("details", { open: (read() ?? String(isOpen)) === "true" }, make("summary", {}, title), ...children);
  node.addEventListener("toggle", () => {
    try {
      localStorage.setItem(key, String(node.open));
    } catch {
      // Not remembered.
    }
  });
  return node;
}

export const field = (name, ...children) => make("div", { class: "field" }, make("span", { class: "name" }, name), ...children);

export class Panel {
  /** @param lookFrom  called with an azimuth and an elevation */
  constructor(page, parent, lookFrom) {
    Object.assign(this, { page, parent, lookFrom });
    this.filters = new FilterSection(page);
    this.compared = new CompareField(page);
    this.scene();
  }

  /** Builds what depends on the scene. */
  scene() {
    const top = make("section", { id: "headline", "aria-label": "Result" });
    this.headline = new Headline(this.page, top);
    this.colour = this.#colourSection();
    this.colour.hidden = !this.page.hasLight;
    this.parent.replaceChildren(top, this.colour, this.filters.build(), this.#viewSection());
  }

  #colourSection() {
    const { page } = this;
    const kinds = [...new Map(page.run.columns.map((column) => [column.quantity, column])).values()];
    this.quantity = make("select", { id: "quantity", "aria-label": "Quantity", onchange: () => page.set({ quantity: this.quantity.value, band: this.#bandOf(this.quantity.value), values: null, ends: null }) },
      kinds.map((kind) => make("option", { value: kind.quantity, title: kind.quantity }, quantityName(kind))));
    this.bandBox = make("div");
    this.show = new Choice("Show", [["value", "Value"], ["error", "Error"], ["difference", "Difference"]],
      (show) => page.set({ show, values: null, errorClass: null, ends: null }));
    this.showField = field("Show", this.show.node);
    this.maps = new Choice("Colours", Object.keys(page.run.colorMaps).map((name) => [name, "", name]), (map) => page.set({ map }), "maps");
    this.maps.buttons.forEach((button, name) => {
      const stops = page.run.colorMaps[name].filter((_, i) => i % 7 === 0).map((rgb) => `rgb(${rgb.join(",")})`);
      button.style.backgroundImage = `linear-gradient(to right,${stops.join(",")})`;
    });
    this.mapField = field("Colours", this.maps.node);
    this.same = new Check("same", `Same scale for all ${this.#timesWord}`, null, (sameScale) => page.set({ sameScale, time: page.state.time }));
    this.log = new Check("log", "Logarithmic scale", null, (isLog) => page.set({ isLog }));
    return section("Colour", true, field("Quantity", this.quantity), this.bandBox, this.showField, this.mapField,
      make("div", { class: "field" }, this.same.node, this.log.node), page.run.json.grows ? null : field("Compared with", this.compared.build()));
  }

  get #timesWord() {
    const { timeline, run } = this.page;
    return timeline.points.length > 0 ? timeline.kinds.days.toLowerCase() : run.json.grows ? "steps" : "times";
  }

  /** The band to show of a quantity: the same one, if it has it. */
  #bandOf(quantity) {
    const bands = this.page.run.columns.filter((column) => column.quantity === quantity).map(({ band }) => band);
    return bands.includes(this.page.state.band) ? this.page.state.band : bands[0];
  }

  #drawBands() {
    const { page } = this;
    const bands = page.run.columns.filter(({ quantity }) => quantity === page.state.quantity).map(({ band }) => band);
    this.bandBox.hidden = bands.length < 2;
    if (this.bandsShown !== bands.join()) {
      this.bandsShown = bands.join();
      const choose = (band) => page.set({ band, values: null, ends: null });
      if (bands.length <= kMaxButtons) {
        this.bands = new Choice("Band", bands.map((band) => [band, bandName(band)]), choose);
      } else {
        const list = make("select", { "aria-label": "Band", onchange: () => choose(list.value) }, bands.map((band) => make("option", { value: band }, bandName(band))));
        this.bands = { node: list, set: (band) => (list.value = band) };
      }
      this.bandBox.replaceChildren(field("Band", this.bands.node));
    }
    if (page.hasLight) {
      this.bands.set(page.state.band);
    }
  }

  #viewSection() {
    const { page } = this;
    const { run } = page;
    const views = make("div", { class: "views" }, kViews.map(([name, azimuth, elevation]) =>
      make("button", { type: "button", onclick: () => this.lookFrom(azimuth, elevation) }, name)));
    this.cut = new Choice("Cut", [["", "No cut"], ["x", "x"], ["y", "y"], ["z", "z"]], (cut) => page.set({ cut }), "choice small");
    this.cutAt = make("input", { type: "range", id: "cut-at", min: 0, max: 1000, "aria-label": "Position of the cut", oninput: () => page.set({ cutAt: this.cutAt.value / 1000 }) });
    this.cutText = make("p", { class: "soft", id: "cut-text" });
    const check = (id, text, key) => new Check(id, text, key, (isOn) => page.set({ [id]: isOn }));
    const hasSky = run.json.times.some(({ sky }) => sky);
    this.checks = {
      ...(run.json.organs.ground.length > 0 ? { ground: check("ground", "Ground", "G") } : {}),
      ...(run.organCount < run.count ? { sensors: check("sensors", "Sensors") } : {}),
      directions: check("directions", "Sun path and directions", "S"),
      ...(hasSky ? { dome: check("dome", "Sky dome") } : {}),
      shading: check("shading", "Depth shading"),
      ...(this.page.hasLight ? { beside: check("beside", "Plant beside its light") } : {}),
      ...(run.json.periods?.length > 0 ? { neighbours: check("neighbours", "Neighbours of the cell, pale") } : {}),
    };
    return section("View", true, views, field("Cut along", this.cut.node), this.cutAt, this.cutText,
      make("div", { class: "field" }, Object.values(this.checks).map(({ node }) => node)));
  }

  draw() {
    const { page } = this;
    const { state } = page;
    document.body.dataset.show = state.show;
    this.headline.draw();
    this.quantity.value = state.quantity;
    this.#drawBands();
    this.show.buttons.get("difference").hidden = page.minus === null;
    this.show.buttons.get("error").hidden = !page.hasErrors && state.show !== "error";
    this.showField.hidden = [...this.show.buttons.values()].every((button) => button.hidden || button === this.show.buttons.get("value"));
    this.show.set(state.show);
    this.maps.set(state.map);
    this.mapField.hidden = state.show !== "value";
    this.same.node.hidden = state.show !== "value" || page.timeline.steps.length < 2;
    this.same.set(state.sameScale);
    this.log.node.hidden = state.show !== "value" || !page.suitsLog;
    this.log.set(state.isLog);
    if (!page.run.json.grows) {
      this.compared.draw();
    }
    this.filters.draw();
    this.options();
  }

  /** Shows the choices of the view. */
  options() {
    const { state, run } = this.page;
    Object.entries(this.checks).forEach(([key, check]) => check.set(state[key]));
    this.cut.set(state.cut);
    this.cutAt.hidden = this.cutText.hidden = !state.cut;
    this.cutAt.value = 1000 * state.cutAt;
    if (state.cut) {
      const { from, to, middle } = cutEnds(run, state.cut);
      const text = `Shown up to ${state.cut} = ${withUnit(plain(from + (to - from) * state.cutAt + middle), run.json.unit)}`;
      this.cutText.textContent = text;
      this.cutAt.setAttribute("aria-valuetext", text);
    }
  }
}

/** The extent of a scene along an axis of its file: {normal, from, to, middle}; from and to are relative to the middle. */
export function cutEnds(run, axis) {
  const { axes, low, high, middle } = run.json;
  const normal = axes[axis];
  const along = (corner) => normal.reduce((sum, n, k) => sum + n * corner[k], 0);
  const ends = [along(low), along(high)].sort((a, b) => a - b);
  return { normal, from: ends[0], to: ends[1], middle: along(middle) };
}
