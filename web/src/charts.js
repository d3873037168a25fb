// Area by value, and mean by height, of the organs that are shown.

import { kClasses } from "./classes.js";
import { classBins, givenLayers, layersOf, valueBins } from "./bins.js";
import { Choice } from "./choice.js";
import { differenceOfLayers } from "./comparison.js";
import { byId, svg } from "./dom.js";
import { layersOfResult } from "./energy.js";
import { areaText, kSigned, many, plain, unitOfColumn, unitText, withError, withUnit } from "./format.js";
import { colorsOf, cssOf, kSure } from "./numbers.js";
import { kPins } from "./page.js";
import { addBars, addWhisker, keepingFocus, startPlot } from "./plot.js";

/** The 95 % interval of a layer, that of the result if it has one; empty where it is not known. */
function whiskerOf({ mean, error, low, high }) {
  const ends = Number.isFinite(low) ? [low, high] : [mean - kSure * error, mean + kSure * error];
  return error > 0 && Number.isFinite(mean) ? ends : [];
}

/** The unit of areas of a whole, and by what they are multiplied: those of small plants are in square centimetres. */
function areaUnit(whole, unit) {
  return unit === "m" && whole < 1 ? { unit: "cm²", factor: 1e4 } : { unit: unit && `${unitText(unit)}²`, factor: 1 };
}

export class Charts {
  constructor(page) {
    this.page = page;
    this.by = new Choice("Count", [["area", "area"], ["count", "organs"]], (by) => page.set({ by }), "choice small");
    byId("by").append(this.by.node);
    const resized = new ResizeObserver(() => this.draw());
    ["histogram", "profile"].forEach((id) => resized.observe(byId(id))); // they widen when another one is hidden
    this.marks = [];
  }

  draw() {
    const { page } = this;
    if (!page.values || byId("charts").clientWidth === 0) {
      return;
    }
    this.by.set(page.state.by);
    this.pinsShown = page.state.pins.join();
    this.marks = [this.#drawValues(), this.#drawHeights()];
    this.mark();
  }

  /** Marks the bars of the organ that is pointed at, or else the last one pinned. */
  mark() {
    if (this.pinsShown !== undefined && this.pinsShown !== this.page.state.pins.join()) {
      this.draw();
      return;
    }
    this.marks.forEach((mark) => mark(this.page.hovered ?? this.page.pins.at(-1) ?? null));
  }

  #point(has, bar) {
    const { page } = this;
    if (bar === null) {
      page.point(null);
      byId("shown").textContent = page.shownWords();
      return;
    }
    const organs = [];
    page.isShown.forEach((shown, i) => shown && has(i, bar.bin) && organs.push(i));
    page.point(organs);
    byId("shown").textContent = `${bar.label}, marked in the scene`;
  }

  /** Bars stand on the same colours as the organs. */
  #colorOf(number) {
    const { page } = this;
    return cssOf(colorsOf([number], page.scale, page.map)[0]);
  }

  get #areaUnit() {
    const { json, shape, isPlant } = this.page.run;
    return areaUnit(shape.areas.reduce((sum, area, i) => sum + (isPlant[i] ? area : 0), 0), json.unit);
  }

  #drawValues() {
    const { page } = this;
    const isError = page.state.show === "error";
    const { isMeasured, countedNoun } = page.run;
    const byArea = page.state.by === "area" && !isMeasured; // sensors have none
    byId("by").hidden = isMeasured;
    byId("histogram-title").textContent = byArea ? "Organ area by value" : `${countedNoun[0].toUpperCase()}${countedNoun.slice(1)}s by value`;
    byId("histogram-unit").textContent = isError ? "error, %" : page.unit;
    const { areas } = page.run.shape;
    const isIn = (i) => page.run.isCounted[i] === 1;
    const data = { mean: page.values.mean, classes: page.classes, areas, isShown: page.isShown, isIn, scale: page.usual };
    const found = isError ? classBins(data) : valueBins(data);
    if (!found) {
      byId("histogram").textContent = page.absent || `No ${countedNoun} has a value.`;
      return () => {};
    }
    const part = byArea ? "area" : "count";
    const most = Math.max(...found.bins.map(({ all }) => all[part]));
    const { unit, factor } = byArea ? this.#areaUnit : { unit: `${countedNoun}s`, factor: 1 };
    const high = most * factor || 1;
    return keepingFocus(byId("histogram"), () => {
      const x = isError ? { low: 0, high: kClasses.length, ticks: kClasses.slice(1).map((_, i) => i + 1), format: (i) => plain(100 * kClasses[i - 1].below) }
        : { low: found.low, high: found.high, last: found.hasMore ? this.#lastNumber(found) : undefined };
      const plot = startPlot(byId("histogram"), byId("histogram-title").textContent, { x, y: { low: 0, high, unit, grid: true, ticks: byArea ? undefined : Math.min(3, high) } });
      byId("histogram-unit").textContent = isError ? "error, %" : unitOfColumn(page.unit, { power: plot.power.x });
      if (found.hasMore) {
        plot.node.append(svg("text", { x: plot.box.right, y: plot.box.bottom + 14, "text-anchor": "end" }, "more"));
      }
      const bars = found.bins.flatMap((bin, i) => this.#valueBar(plot, bin, i, { part, factor, isError, found }));
      const mark = addBars(plot.node, bars, {
        onPoint: (bar) => this.#point(found.has, bar),
        onPress: (bar) => this.#press(isError ? "errorClass" : "values", isError ? bar.bin : [bar.from, bar.to]),
      });
      this.#addPins(plot, found, isError);
      return (organ) => mark((bin) => organ !== null && found.has(organ, bin));
    });
  }

  /** The greatest number that does not cover "more", at the right end of the axis. */
  #lastNumber({ low, high, last }) {
    const kMore = 40; // pixels
    return Math.min(last, high - ((high - low) * kMore) / Math.max(kMore, byId("histogram").clientWidth));
  }

  #valueBar({ node, x, y }, bin, i, { part, factor, isError, found }) {
    if (bin.all[part] === 0) {
      return [];
    }
    const noun = this.page.run.countedNoun;
    const [from, to] = isError ? [i + 0.04, i + 0.96] : [found.low + ((found.high - found.low) * i) / found.bins.length, found.low + ((found.high - found.low) * (i + 1)) / found.bins.length];
    const boxOf = (amount) => ({
      x: x(from), width: Math.max(2, x(to) - x(from) - 1), y: Math.min(y(amount * factor), y(0) - 1), height: Math.max(1, y(0) - y(amount * factor)),
    });
    node.append(svg("rect", { class: "all", ...boxOf(bin.all[part]) }));
    const span = isError ? `error ${kClasses[i].name}` : bin.isMore ? `more than ${plain(bin.from)}, up to ${plain(bin.to)}` : `${plain(bin.from)} to ${plain(bin.to)}`;
    const count = bin.shown.count === bin.all.count ? many(bin.shown.count, noun) : `${bin.shown.count} of ${many(bin.all.count, noun)}`;
    const area = this.page.run.isMeasured ? "" : `, ${areaText(bin.shown.area, this.page.run.json.unit)}`;
    const label = `${isError ? span : `${span} ${this.page.unit}`}: ${count}${area}`;
    const { top, bottom } = { top: y(y ? bin.all[part] * factor : 0), bottom: y(0) };
    return [{
      bin: i, box: { ...boxOf(bin.shown[part]), ...(bin.shown[part] === 0 && { height: 0 }) }, color: isError ? kClasses[i].color : this.#colorOf(bin.isMore ? bin.from : (bin.from + bin.to) / 2), label, from: bin.from, to: bin.to,
      hit: { x: x(from), width: Math.max(3, x(to) - x(from)), y: Math.min(top, bottom - 24), height: Math.max(24, bottom - top) },
    }];
  }

  /** Triangles below the axis: pinned organs. */
  #addPins({ node, x, box }, found, isError) {
    const { page } = this;
    page.pins.forEach((organ, i) => {
      const bin = found.binOf[organ];
      if (bin >= 0) {
        const at = isError ? bin + 0.5 : found.low + ((found.high - found.low) * (bin + 0.5)) / found.bins.length;
        node.append(svg("path", { d: `M${x(at)} ${box.bottom + 1}l5 7h-10z`, fill: kPins[i] }));
      }
    });
  }

  #press(key, value) {
    const { state } = this.page;
    this.page.set({ [key]: JSON.stringify(state[key]) === JSON.stringify(value) ? null : value });
  }

  #drawHeights() {
    const { page } = this;
    const { unit } = page.run.json;
    const isError = page.state.show === "error";
    byId("profile-title").textContent = isError ? "Median error by height" : "Mean by height";
    byId("profile-unit").textContent = isError ? "%" : page.unit;
    const hasArea = page.state.show === "value"; // bars of other modes need not begin where the area does
    byId("profile-area").hidden = !hasArea;
    const found = this.#layers(isError);
    const known = found?.bins.map(({ mean }) => mean).filter(Number.isFinite) ?? [];
    this.#sayErrors(found);
    if (known.length === 0) {
      byId("profile").textContent = page.absent || "No organ shown has a value.";
      return () => {};
    }
    const whiskers = found.bins.map(whiskerOf);
    const ends = [...known, ...whiskers.flat()];
    const most = Math.max(...found.bins.map(({ area }) => area));
    const ofAreas = this.#areaUnit;
    return keepingFocus(byId("profile"), () => {
      const plot = startPlot(byId("profile"), "Mean by height", {
        x: { low: Math.min(0, ...ends), high: Math.max(0, ...ends) || 1, grid: true }, y: { low: found.low, high: found.high, unit, ticks: 4 },
        top: hasArea && { low: 0, high: most * ofAreas.factor } });
      byId("profile-unit").textContent = isError ? "%" : unitOfColumn(page.unit, { power: plot.power.x });
      const bars = found.bins.flatMap((bin, i) => (Number.isFinite(bin.mean) ? [this.#layerBar(plot, bin, i, isError)] : []));
      const mark = addBars(plot.node, bars, { onPoint: (bar) => this.#point(found.has, bar), onPress: (bar) => this.#press("layer", [bar.from, bar.to]) });
      found.bins.forEach(({ from, to }, i) => whiskers[i].length > 0 && addWhisker(plot, whiskers[i], (from + to) / 2));
      if (hasArea) {
        this.#addArea(plot, found.bins, ofAreas);
      }
      return (organ) => mark((bin) => organ !== null && found.has(organ, bin));
    });
  }

  /** Area in each layer, as a dotted outline on the upper axis. */
  #addArea({ node, y, top, power }, bins, { unit, factor }) {
    byId("profile-area").textContent = `organ area${unit && `, ${unitOfColumn(unit, { power: power.top })}`}`;
    const points = bins.flatMap(({ from, to, area }) => [from, to].map((height) => `${top(area * factor)},${y(height)}`));
    node.append(svg("polyline", { class: "area", points: points.join(" "), "pointer-events": "none" }));
  }

  /** The layers of the result while all plants are shown, as only they have errors; else those of the shown organs. */
  #layers(isError) {
    const { page } = this;
    const { run, values } = page;
    const { heights, areas } = run.shape;
    const isShown = page.isShown.map((shown, i) => (run.isPlant[i] ? shown : 0));
    const isWhole = page.isShown.every((shown, i) => shown || !run.isPlant[i]);
    const layers = isWhole ? this.#givenLayers() : null;
    if (layers) {
      return givenLayers({ layers, heights, isShown });
    }
    const numbers = isError ? values.mean.map((mean, i) => (page.classes[i] < kClasses.length ? (100 * values.error[i]) / Math.abs(mean) : NaN)) : values.mean;
    return layersOf({ numbers, areas, layers: run.layers, isShown, isMedian: isError });
  }

  /** The layers that the result has, or the differences of those that both results have; null for none. */
  #givenLayers() {
    const { run, time, column, state, minus } = this.page;
    if (state.show === "error") {
      return null;
    }
    const kind = run.json.columns[column];
    const own = layersOfResult(this.page.head, kind, run.factorOf(time, column));
    return state.show === "value" ? own : differenceOfLayers(own, minus.layers(time, column));
  }

  /** Whether bars have 95 % intervals; of differences also why not. */
  #sayErrors(found) {
    const isKnown = found?.bins.some(({ error }) => error > 0) ?? false;
    const isDifference = this.page.state.show === "difference";
    const node = byId("profile-errors");
    node.hidden = !isKnown && !isDifference;
    node.className = isKnown ? "whisker" : "";
    node.textContent = isKnown ? "95 %" : "errors not known";
    node.title = isKnown ? "" : "Errors of layers are known where all plants are shown and both results have the same layers (layer_heights), of means, not of sums.";
  }

  #layerBar({ x, y, box }, bin, i, isError) {
    const top = y(bin.to);
    const tall = Math.max(2, y(bin.from) - top - 1.5);
    const high = this.page.state.show === "difference" ? kSigned : bin.high;
    const mean = isError ? `median error ${plain(bin.mean, 2)} %` : `mean ${withUnit(withError(bin.mean, bin.error, high), this.page.unit)}${bin.error >= 0 ? "" : " (error not known)"}`;
    const { unit } = this.page.run.json;
    const color = isError ? kClasses.find(({ below }) => bin.mean < 100 * below).color : this.#colorOf(bin.mean);
    return {
      bin: i, color, from: bin.from, to: bin.to,
      box: { x: Math.min(x(0), x(bin.mean)), width: Math.max(2, Math.abs(x(bin.mean) - x(0))), y: top, height: tall },
      hit: { x: box.left, width: box.right - box.left, y: top, height: tall },
      label: `height ${plain(bin.from)} to ${withUnit(plain(bin.to), unit)}: ${mean}, ${many(bin.count, "organ")}, ${areaText(bin.area, unit)}`,
    };
  }
}
