// What the page shows: the choices of the user, the numbers that follow from them, and the parts that draw them.

import { areaMean, classesOf } from "./classes.js";
import { ColorScale } from "./color_scale.js";
import { Comparison, givenDifference } from "./comparison.js";
import { byId } from "./dom.js";
import { noFilters, organsPassing } from "./filters.js";
import { allPlants, plantLight } from "./energy.js";
import { counted, kSigned, many, withError, withUnit } from "./format.js";
import { colorMapOf, organColors } from "./organ_colors.js";
import { plantColors } from "./plant.js";
import { AddressKeeper, addressOf, startOf } from "./state.js";

export const kPins = ["#cf318e", "#bf5400", "#1b73d5", "#148460", "#8f54dd", "#7d7617"];
export const pinLetter = (i) => "ABCDEF"[i];

const nothing = (n) => () => new Float32Array(n).fill(NaN);

/** What is shown first: what sensors measure, if the result is about them; undefined without columns. */
export const firstColumn = ({ columns, isMeasured }) =>
  (isMeasured ? columns.find(({ quantity }) => quantity === "incident_upper") : undefined) ?? columns[0];

export class Page {
  /** @param run  RunData  @param timeline  see timeline.js  @param live  of a run in progress or a sweep, see live_page.js and sweep.js */
  constructor(run, timeline, chosen, live = null) {
    Object.assign(this, { run, timeline, live, other: null, hovered: null, pointed: null, parts: [], absent: "" });
    this.colorScale = new ColorScale(this);
    const grows = run.json.grows === true;
    const start = { ...startOf(innerWidth, innerHeight), beside: grows, sameScale: grows || timeline.points.length > 0 };
    this.state = { ...structuredClone(start), ...chosen };
    this.address = new AddressKeeper(() => addressOf(this.state, start));
    this.#checkChoices();
  }

  /** Replaces choices that this result does not have. */
  #checkChoices() {
    const { run, state } = this;
    const known = run.columnOf(state.quantity, state.band);
    if (known < 0 || !run.columns.some(({ number }) => number === known)) {
      const same = run.columns.find(({ quantity }) => quantity === state.quantity) ?? firstColumn(run);
      Object.assign(state, { quantity: same?.quantity ?? "", band: same?.band ?? "" });
    }
    if (!["value", "error", ...(this.minus ? ["difference"] : [])].includes(state.show)) {
      state.show = "value";
    }
    state.map = run.colorMaps[state.map] ? state.map : "viridis";
    state.pins = state.pins.filter((id) => run.organOfId(String(id)) >= 0).slice(0, kPins.length);
    this.entry = this.timeline.find(state.time) ?? this.timeline.first((step) => this.lightOf(step));
    state.time = this.entry.key;
  }

  /** What is taken away in the mode "difference": {title, result, errors, onlyFirst, onlyOther, values}; null if there is nothing. */
  get minus() {
    if (this.comparison?.run !== this.run || this.comparison?.other !== this.other) {
      this.comparison = this.other ? new Comparison(this.run, this.other) : null;
    }
    return this.comparison ?? givenDifference(this.run);
  }

  /** Takes another result away, see Comparison. null: only the one that this result was written with */
  compare(other) {
    this.other = other;
    return this.set({ show: other ? "difference" : "value", values: null, errorClass: null, ends: null });
  }

  /** The low and high corner of all states of a growing plant, in the coordinates of the scene; null for others. */
  get extent() {
    return this.run.json.grows ? this.live?.extent ?? null : null;
  }

  /** The name of what is shown: the title, or that of the point of a sweep. */
  get shownTitle() {
    const { points, days } = this.timeline;
    return points.includes(this.entry) || (days.length > 0 && points.length > 0) ? this.entry.name : this.run.json.title;
  }

  get time() {
    return this.run.json.times.length === 1 ? 0 : this.entry.index;
  }

  get column() {
    return Math.max(0, this.run.columnOf(this.state.quantity, this.state.band));
  }

  get unit() {
    return this.hasLight ? this.run.unit(this.time, this.column) : "";
  }

  /** Estimates of all plants of the shown column at entries of the timeline, null where there are none. A promise. */
  async meansOf(entries) {
    const { quantity, band } = this.run.json.columns[this.column];
    const factor = this.run.factorOf(this.#timeAt(entries), this.column);
    const found = entries.map((entry) => allPlants(this.headOf(entry), quantity, band, factor));
    if (found.some(Boolean) || !this.run.json.grows || !this.live?.allValues) {
      return found;
    }
    return (await this.live.allValues(this.column)).map(({ values, areas }) => values && { mean: areaMean(values.mean, areas), error: NaN });
  }

  /** The time of the result that has the unit of entries of the timeline, of which some may be of other results. */
  #timeAt(entries) {
    const index = entries.find((entry) => entry.index >= 0)?.index ?? 0;
    return this.run.json.times.length > 1 ? index : 0;
  }

  /** The unit of the shown column at entries of the timeline. */
  unitAt(entries) {
    return this.hasLight ? this.run.unit(this.#timeAt(entries), this.column) : "";
  }

  /** The band by which light is counted. */
  get band() {
    return this.state.band || (this.run.json.columns.find(({ band }) => band)?.band ?? "");
  }

  get head() {
    return this.run.headOf(this.time);
  }

  /** The result at an entry without its organs; of a run in progress, as far as it is loaded. */
  headOf(entry) {
    return this.live ? this.live.headOf(entry) : this.run.headOf(entry.index);
  }

  /** The light that the plants take at a time: the height of its bar. */
  lightOf(step) {
    return this.live ? this.live.lightOf(step, this.band) : plantLight(this.headOf(step), this.band);
  }

  /** The light that the plants take on a day. */
  dayLight(day) {
    return allPlants(this.headOf(day), "absorbed_flux", this.band)?.mean ?? 0;
  }

  /** The time of most light on the day of an entry. */
  brightestBeside(entry) {
    const { timeline } = this;
    const beside = timeline.points.length > 0 ? timeline.steps : timeline.stepsBeside(entry);
    return beside.reduce((best, step) => (this.lightOf(step) > this.lightOf(best) ? step : best), beside[0]);
  }

  /** Whether the result has the shown quantity at an entry: sums over times lack fractions. */
  hasAt({ point, index }) {
    const { values } = this.run.json.times[index] ?? {};
    return point === -1 ? this.run.json.columns[this.column].band !== "" : values === undefined || values[this.column] >= 0;
  }

  /** The values of an organ at entries of the timeline, see RunData.course. */
  courseOf(entries, column, organ) {
    return this.live ? this.live.course(entries, column, this.run.idOf(organ)) : this.run.course(entries.map(({ index }) => index), column, organ);
  }

  /** "70 of 77 organs shown" */
  shownWords() {
    const { run } = this;
    const shown = (isSensor) => this.isShown.reduce((sum, one, i) => sum + (run.isSensor[i] === isSensor ? one : 0), 0);
    const count = shown(0);
    const sensors = run.organCount < run.count ? `, ${counted(shown(1))} of ${many(run.count - run.organCount, "sensor")}` : "";
    const alone = this.state.show === "difference" ? this.minus.onlyFirst + this.minus.onlyOther : 0;
    return `${counted(count)} of ${many(run.organCount, "organ")}${sensors} shown${alone > 0 ? `, ${counted(alone)} in one result only` : ""}`;
  }

  /** Whether light was computed: models grow without it, too. */
  get hasLight() {
    return this.run.columns.length > 0;
  }

  /** Whether the plant in its own colours is beside its light. */
  get isBeside() {
    return this.state.beside && this.hasLight;
  }

  get pins() {
    return this.state.pins.map((id) => this.run.organOfId(String(id)));
  }

  /** Changes choices and draws again. Several parts of the page listen; see `parts`. */
  set(changes) {
    Object.assign(this.state, changes);
    this.address.later();
    const keys = Object.keys(changes);
    const isOnly = (...names) => keys.every((key) => names.includes(key));
    if (isOnly("pins")) {
      this.mark();
    } else if (isOnly("panel", "drawer", "tab", "theme", "view")) {
      this.notify("fold");
    } else if (isOnly("directions", "dome", "shading", "beside", "neighbours", "cut", "cutAt")) {
      this.notify("options");
    } else if (keys.some((key) => ["quantity", "band", "time"].includes(key)) || keys.includes("show")) {
      return this.update();
    } else {
      this.paint();
    }
    return Promise.resolve();
  }

  notify(what) {
    this.parts.forEach((part) => part[what]?.());
  }

  /** Shows an entry of the timeline. */
  goTo(entry) {
    if (!entry?.isKnown || entry.key === this.entry.key) {
      return Promise.resolve();
    }
    return this.live ? this.live.select(entry) : this.set({ time: entry.key, values: null, ends: null });
  }

  /** Another result, or another state of it. */
  async replace(run, timeline, key) {
    const areSame = (one, other) => one === other || JSON.stringify(one) === JSON.stringify(other);
    const isNewScene = run.shape !== this.run.shape || !areSame(run.json.organs, this.run.json.organs);
    this.run = run;
    this.timeline = timeline;
    this.state.time = key;
    this.address.later();
    this.#checkChoices();
    if (isNewScene) {
      this.hovered = null;
      this.notify("scene");
    }
    await this.update();
  }

  /** Reads the numbers of the chosen column and time, and shows them. */
  async update() {
    const { run, state } = this;
    this.entry = this.timeline.find(state.time) ?? this.entry;
    const { time, column } = this;
    const step = run.has(time, column) ? null : this.brightestBeside(this.entry);
    if (step && step !== this.entry && this.hasAt(step) && !this.timeline.steps.includes(this.entry)) {
      return this.goTo(step);
    }
    const [values, difference] = await Promise.all([
      run.values(time, column), state.show === "difference" ? this.minus.values(time, column) : null]);
    const isLate = () => time !== this.time || column !== this.column || run !== this.run; // the choice has changed in the meantime
    if (isLate()) {
      return;
    }
    this.absent = values === null && run.has(time, column) ? "The program ended before this page had loaded these values."
      : state.show === "difference" && difference === null ? `“${this.minus.title}” has no such values.` : "";
    const none = nothing(run.count);
    const found = (state.show === "difference" ? difference : values) ?? { mean: none(), error: none(), low: none(), high: none() };
    await this.colorScale.find(found);
    if (isLate()) {
      return;
    }
    this.values = found;
    this.paint();
    this.notify("time");
  }

  /** Whether any organ has an error. */
  get hasErrors() {
    return this.values?.error.some(Number.isFinite) ?? true;
  }

  /** Whether a logarithmic scale shows more. */
  get suitsLog() {
    return this.colorScale.suitsLog;
  }

  /** The ends of the scale, unless the user has set others. */
  get usual() {
    return this.colorScale.usual;
  }

  /** Shows the organs that pass the filters. */
  paint() {
    const { run, state, values } = this;
    if (!values) {
      return;
    }
    this.scale = this.colorScale.shown;
    this.classes = classesOf(values, run.shape.areas);
    this.isShown = organsPassing(run, values.mean, this.classes, state);
    this.colors = this.hasLight ? organColors(this) : plantColors(run);
    this.notify("draw");
    this.mark();
  }

  get map() {
    return colorMapOf(this.state, this.run.colorMaps);
  }

  /** Shows what is pinned and pointed at. */
  mark() {
    this.notify("mark");
  }

  hover(organ) {
    if (organ !== this.hovered) {
      this.hovered = organ;
      this.mark();
    }
  }

  /** Dims all organs but these. @param organs  null: none is dimmed */
  point(organs) {
    this.pointed = organs && new Set(organs);
    this.mark();
  }

  pin(organ) {
    const id = this.run.idOf(organ);
    const { pins } = this.state;
    if (pins.map(String).includes(String(id))) {
      this.set({ pins: pins.filter((other) => String(other) !== String(id)) });
    } else {
      this.set({ pins: [...pins.slice(-(kPins.length - 1)), id] });
    }
  }

  /** The estimate of an organ with its unit, as text. */
  describe(organ) {
    const { mean, error, high } = this.values;
    return withUnit(withError(mean[organ], error[organ], this.state.show === "difference" ? kSigned : high[organ]), this.unit);
  }

  clearFilters() {
    this.set(noFilters());
  }

  /** Has a text read out. */
  say(text) {
    byId("said").textContent = text;
  }
}
