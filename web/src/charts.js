// Area by value, and mean by height, of the organs that are shown.

import { kClasses } from "./classes.js";
import { classBins, givenLayers, layersOf, valueBins } from "./bins.js";
import { Choice } from "./choice.js";
import { differenceOfLayers } from "./comparison.js";
import { byId, svg } from "./dom.js";
import { layersOfResult } from "./energy.js";
import { areaText, many, plain, unitText, withError, withUnit } from "./format.js";
import { colorsOf, cssOf, kSure } from "./numbers.js";
import { kPins } from "./page.js";
import { addBars, addWhisker, keepingFocus, startPlot } from "./plot.js";

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

  #point(binOf, bar) {
    const { page } = this;
    if (bar === null) {
      page.point(null);
      byId("shown").textContent = page.shownWords();
      return;
    }
    const organs = [];
    binOf.forEach((bin, i) => bin === bar.bin && page.isShown[i] && organs.push(i));
    page.point(organs);
    byId("shown").textContent = `${bar.label}, marked in the scene`;
  }

  /** Bars stand on the same colours as the organs. */
  #colorOf(number) {
    const { page } = this;
    return cssOf(colorsOf([number], page.scale, page.map)[0]);
  }

  #drawValues() {
    const { page } = this;
    const isError = page.state.show === "error";
    const { isMeasured, countedNoun } = page.run;
    const byArea = page.state.by === "area" && !isMeasured; // sensors have none
    byId("by").hidden = isMeasured;
    byId("histogram-title").textContent = byArea ? "Organ area by value" : `${countedNoun[0].toUpperCase()}${countedNoun.slice(1)}s by value`;
    byId("histogram-unit").textContent = isError ? "class of error" : page.unit;
    const { areas } = page.run.shape;
    const isIn = (i) => page.run.isCounted[i] === 1;
    const data = { mean: page.values.mean, classes: page.classes, areas, isShown: page.isShown, isIn, scale: page.usual };
    const found = isError ? classBins(data) : valueBins(data);
    if (!found) {
      byId("histogram").textContent = page.absent || `No ${countedNoun} has a value.`;
      return () => {};
    }
    const part = byArea ? "area" : "count";
    const factor = byArea && page.run.json.unit === "m" && Math.max(...found.bins.map(({ all }) => all.area)) < 0.01 ? 1e4 : 1;
    const unit = byArea ? factor === 1e4 ? "cm²" : page.run.json.unit && `${unitText(page.run.json.unit)}²` : `${countedNoun}s`;
    const high = Math.max(...found.bins.map(({ all }) => all[part])) * factor || 1;
    return keepingFocus(byId("histogram"), () => {
      const x = isError ? { low: 0, high: kClasses.length, ticks: [] }
        : { low: found.low, high: found.high, ...(found.hasMore ? { ticks: undefined } : {}), format: (v) => (v > found.last * (1 + 1e-9) && found.hasMore ? "" : plain(v)) };
      const plot = startPlot(byId("histogram"), byId("histogram-title").textContent, { x, y: { low: 0, high, unit, grid: true, ticks: byArea ? undefined : Math.min(3, high) } });
      if (isError) {
        kClasses.forEach(({ short }, i) => plot.node.append(svg("text", { x: plot.x(i + 0.5), y: plot.box.bottom + 14, "text-anchor": "middle" }, short)));
      } else if (found.hasMore) {
        plot.node.append(svg("text", { x: plot.box.right, y: plot.box.bottom + 14, "text-anchor": "end" }, "more"));
      }
      const bars = found.bins.flatMap((bin, i) => this.#valueBar(plot, bin, i, { part, factor, isError, found }));
      const mark = addBars(plot.node, bars, {
        onPoint: (bar) => this.#point(found.binOf, bar),
        onPress: (bar) => this.#press(isError ? "errorClass" : "values", isError ? bar.bin : [bar.from, bar.to]),
      });
      this.#addPins(plot, found, isError);
      return (organ) => mark(organ === null ? -1 : found.binOf[organ]);
    });
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
    const ends = found.bins.flatMap(({ mean, error }) => (error > 0 ? [mean - kSure * error, mean + kSure * error] : [mean])).filter(Number.isFinite);
    return keepingFocus(byId("profile"), () => {
      const plot = startPlot(byId("profile"), "Mean by height", {
        x: { low: Math.min(0, ...ends), high: Math.max(0, ...ends) || 1, grid: true }, y: { low: found.low, high: found.high, unit, ticks: 4 } });
      const bars = found.bins.flatMap((bin, i) => (Number.isFinite(bin.mean) ? [this.#layerBar(plot, bin, i, isError)] : []));
      const mark = addBars(plot.node, bars, { onPoint: (bar) => this.#point(found.binOf, bar), onPress: (bar) => this.#press("layer", [bar.from, bar.to]) });
      found.bins.forEach(({ mean, error, from, to }) => error > 0 && addWhisker(plot, [mean - kSure * error, mean + kSure * error], (from + to) / 2));
      if (hasArea) {
        this.#addArea(plot, found.bins);
      }
      return (organ) => mark(organ === null ? -1 : found.binOf[organ]);
    });
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
    return layersOf({ numbers, areas, heights, isShown, isMedian: isError });
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
    const high = Math.max(2, y(bin.from) - top - 1.5);
    const mean = isError ? `median error ${plain(bin.mean, 2)} %` : `mean ${withUnit(bin.error > 0 ? withError(bin.mean, bin.error) : plain(bin.mean), this.page.unit)}`;
    const { unit } = this.page.run.json;
    const color = isError ? kClasses.find(({ below }) => bin.mean < 100 * below).color : this.#colorOf(bin.mean);
    return {
      bin: i, color, from: bin.from, to: bin.to,
      box: { x: Math.min(x(0), x(bin.mean)), width: Math.max(2, Math.abs(x(bin.mean) - x(0))), y: top, height: high },
      hit: { x: box.left, width: box.right - box.left, y: top, height: high },
      label: `height ${plain(bin.from)} to ${withUnit(plain(bin.to), unit)}: ${mean}, ${many(bin.count, "organ")}, ${areaText(bin.area, unit)}`,
    };
  }

  /** Area in each layer, as a dotted outline over the width. */
  #addArea({ node, y, box }, bins) {
    const most = Math.max(...bins.map(({ area }) => area));
    byId("profile-area").textContent = `leaf area ≤ ${areaText(most, this.page.run.json.unit)}`;
    const x = (area) => box.left + 0.92 * (area / most) * (box.right - box.left);
    const points = bins.flatMap(({ from, to, area }) => [`${x(area)},${y(from)}`, `${x(area)},${y(to)}`]);
    node.append(svg("polyline", { class: "area", points: points.join(" "), "pointer-events": "none" }));
  }
}
