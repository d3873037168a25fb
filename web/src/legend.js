// The legend in the scene: a scale with marks, or the classes of errors; and how well organs are known.

import { kClasses, kGreys, kDark, kGrey } from "./classes.js";
import { byId, make } from "./dom.js";
import { many, percent, plain } from "./format.js";
import { endsOf, isKnown, partOf, ticks, weightedQuantile } from "./numbers.js";
import { isUnknown } from "./organ_colors.js";
import { kPins } from "./page.js";

const kApart = 0.12; // least distance of two marks, of the length of the scale

/** Round values on a scale. */
function roundOf({ low, high, isLog }, count) {
  if (!isLog) {
    return ticks(low, high, count);
  }
  const powers = [];
  for (let power = Math.ceil(Math.log10(low)); 10 ** power <= high; ++power) {
    powers.push(10 ** power);
  }
  return powers;
}

/** Both ends of a scale, and the round values that are not too near to them. */
function marksOf(scale, count) {
  const { low, high } = scale;
  const inner = roundOf(scale, count).filter((value) => {
    const part = partOf(value, scale);
    return part > kApart && part < 1 - kApart;
  });
  return [low, ...inner, high];
}

/** "Half of the organs are known to 0.6 % or better, the worst to 1 %" */
function knownWords({ values, classes, isShown, run }) {
  const parts = values.mean.map((mean, i) =>
    (classes[i] < kClasses.length && isShown[i] && run.isCounted[i] ? values.error[i] / Math.abs(mean) : NaN));
  const half = weightedQuantile(parts, new Uint8Array(parts.length).fill(1), 0.5);
  const worst = endsOf(parts).high;
  if (!Number.isFinite(half)) {
    return !isShown.includes(1) ? "" : values.mean.some((mean) => mean > 0) ? "No errors are known" : "No light at this time";
  }
  if (half > 0.5) {
    return `Most ${run.countedNoun}s are known to no better than 50 %: more paths are needed`;
  }
  const count = parts.reduce((sum, part) => sum + (Number.isFinite(part) ? 1 : 0), 0);
  return count === 1 ? `Known to ${percent(half, 1)}` : `Half of the ${run.countedNoun}s are known to ${percent(half, 1)} or better, the worst to ${worst > 0.5 ? "no better than 50 %" : percent(worst, 1)}`;
}

/** The highest value of organs that are known to 50 % or better. */
export const highestKnown = ({ mean, error }) => endsOf(mean.map((value, i) => (isKnown(value, error[i]) ? value : NaN))).high;

/** How many of the shown parts of plants are in each class of error. */
export function classCounts({ classes, isShown, run }) {
  const counts = new Array(kClasses.length + kGreys.length).fill(0);
  classes.forEach((number, i) => (counts[number] += isShown[i] && run.isCounted[i] ? 1 : 0));
  return counts;
}

/** How many of the shown parts of plants nothing is known of. */
export const countUnknown = ({ values: { mean, error }, isShown, run }) =>
  mean.reduce((sum, value, i) => sum + (isShown[i] && run.isCounted[i] && isUnknown(value, error[i]) ? 1 : 0), 0);

/** "12 organs unknown", with their stripes, and how many have no value; nothing, where there are none. */
function unknownWords(page) {
  const { values: { mean }, isShown, run } = page;
  const row = (count, kind, words, title) => count > 0 && page.state.show !== "difference" &&
    make("p", { class: "unknown", title }, make("i", { class: `swatch ${kind}` }), `${many(count, run.countedNoun)} ${words}`);
  const missing = mean.reduce((sum, value, i) => sum + (isShown[i] && run.isCounted[i] && Number.isNaN(value) ? 1 : 0), 0);
  return [row(countUnknown(page), "hatched", page.state.show === "error" ? "of these unknown" : "unknown", "The error is larger than the value, or no light was found"),
    row(missing, "missing", "without a value")].filter(Boolean);
}

/** The parts of the absorbed light that organs of each class of error take, without grey ones. */
function qualityOf({ classes, values, run, isShown, column }) {
  const sums = new Float64Array(kClasses.length);
  classes.forEach((number, i) => {
    if (number < kClasses.length && isShown[i] && run.isCounted[i]) {
      sums[number] += Math.abs(values.mean[i]) * run.weightOf(column, i);
    }
  });
  const total = sums.reduce((a, b) => a + b, 0);
  return total > 0 ? [...sums].map((sum) => sum / total) : [];
}

export class Legend {
  constructor(page, parent) {
    Object.assign(this, { page, parent, isFlat: matchMedia("(max-width: 640px) and (min-height: 480px)") });
    this.isFlat.addEventListener("change", () => this.draw());
    const isTouch = matchMedia("(pointer: coarse)").matches;
    this.hint = make("p", { id: "hint" }, isTouch ? "Tap an organ to read and pin it" : "Point at an organ to read it, click to pin it");
  }

  draw() {
    const { page } = this;
    const { state, run, timeline, entry } = page;
    if (!page.hasLight) {
      this.parent.replaceChildren(make("h2", { id: "legend-title" }, "No light was computed"), make("p", { class: "note", id: "legend-note" }, entry.name), this.hint);
      page.notify("legend");
      return;
    }
    const time = entry.name ? ` · ${timeline.wordsOf(entry)}` : "";
    const isError = state.show === "error";
    const column = run.columnName(page.column);
    const isDifference = state.show === "difference";
    const title = isError ? "How well it is known" : isDifference ? `${page.shownTitle === page.minus.title ? "This result" : page.shownTitle} − ${page.minus.title}` : column;
    const note = isError ? `standard error, % of the value${time}` : [isDifference && column, page.unit.replace(/^of /, "share of "), time.replace(" · ", "")].filter(Boolean).join(" · ");
    this.arrows = make("div");
    this.parent.replaceChildren(
      make("h2", { id: "legend-title", title: run.json.columns[page.column].quantity }, title), make("p", { class: "note", id: "legend-note" }, note),
      ...(isError ? [this.#classes()] : [this.#scale(), ...this.#quality()]), ...unknownWords(page), this.hint);
    this.mark();
    page.notify("legend");
  }

  #classes() {
    const counts = classCounts(this.page);
    const row = (color, name, count, kind) => {
      const swatch = make("i", { class: kind === "dark" ? "swatch hatched" : "swatch" });
      swatch.style.backgroundColor = color;
      return make("li", { class: kind && "grey" }, swatch, make("span", {}, name), make("span", {}, String(count)));
    };
    return make("ul", {}, kClasses.map(({ color, name }, i) => row(color, this.isFlat.matches ? kClasses[i].short : name, counts[i])),
      kGreys.filter(({ number }) => counts[number] > 0).map(({ number, name }) => row(kGrey, name, counts[number], number === kDark ? "dark" : "grey")));
  }

  #scale() {
    const { page } = this;
    const { scale } = page;
    const bar = make("div", { id: "legend-bar" });
    const stops = page.map.map((rgb) => `rgb(${rgb.join(",")})`).join(",");
    bar.style.backgroundImage = `linear-gradient(to ${this.isFlat.matches ? "right" : "top"},${stops})`;
    const position = (node, value) => {
      node.style[this.isFlat.matches ? "left" : "bottom"] = `${100 * partOf(value, scale)}%`;
      return node;
    };
    this.position = position;
    const highest = highestKnown(page.values);
    const signed = (value) => (page.state.show === "difference" && value > 0 ? `+${plain(value)}` : plain(value));
    const marks = marksOf(scale, 4).map((value, i, all) =>
      position(make("span", { class: `tick${i === 0 ? " first" : i === all.length - 1 ? " last" : ""}` }, signed(value)), value));
    const over = highest > scale.high && plain(highest) !== plain(scale.high) && make("span", { class: "over" }, `▲ up to ${plain(highest)}`);
    return make("div", { id: "legend-scale" }, bar, marks, over, this.arrows, page.state.show === "value" && [this.#end(1), this.#end(0)]);
  }

  /** A double click on an end of the scale edits it. */
  #end(k) {
    const { page } = this;
    const button = make("button", { type: "button", "aria-label": `Edit the ${k === 0 ? "lower" : "upper"} end of the scale`, title: "Double click to edit" });
    button.style[k === 0 ? "bottom" : "top"] = "-12px";
    const edit = () => {
      const { low, high } = page.scale;
      const input = make("input", { class: "end", "aria-label": button.getAttribute("aria-label"), value: String(Number([low, high][k].toPrecision(3))) });
      input.style[k === 0 ? "bottom" : "top"] = "-12px";
      const done = (isKept) => {
        const ends = [low, high];
        ends[k] = Number(input.value);
        input.remove();
        const isGood = isKept && input.value.trim() && ends[1] > ends[0];
        page.set({ ends: isGood ? ends : isKept && !input.value.trim() ? null : page.state.ends });
      };
      input.addEventListener("keydown", (event) => {
        event.stopPropagation();
        if (event.key === "Enter" || event.key === "Escape") {
          done(event.key === "Enter");
        }
      });
      button.after(input);
      input.select();
      input.focus();
    };
    button.addEventListener("dblclick", edit);
    button.addEventListener("keydown", (event) => event.key === "Enter" && edit());
    return button;
  }

  #quality() {
    const { page } = this;
    if (page.state.show === "difference") {
      return [make("p", { class: "known", title: page.minus.errors }, page.absent || "Grey: no clear difference (95 %)")];
    }
    const bar = make("div", { class: "quality", "aria-hidden": "true" });
    qualityOf(page).forEach((part, i) => {
      const piece = make("i");
      piece.style.flexGrow = part;
      piece.style.backgroundColor = kClasses[i].color;
      bar.append(piece);
    });
    const bounds = page.entry.point === -1 ? ". Errors are upper bounds, the sums of those of the points" : "";
    return [bar, make("p", { class: "known" }, page.absent || `${knownWords(page)}${bounds}`)];
  }

  /** Arrows at the values of organs that are pinned or pointed at. */
  mark() {
    const { page } = this;
    this.hint.hidden = page.pins.length > 0 || page.isBeside;
    if (page.state.show === "error" || !page.values || !this.position) {
      return;
    }
    const arrow = (organ, color) => {
      const node = this.position(make("i", { class: "arrow" }), page.values.mean[organ]);
      if (color) {
        node.style[this.isFlat.matches ? "borderTopColor" : "borderLeftColor"] = color;
      }
      return node;
    };
    const known = (organ) => Number.isFinite(page.values.mean[organ]);
    this.arrows.replaceChildren(...page.pins.flatMap((organ, i) => (known(organ) ? [arrow(organ, kPins[i])] : [])),
      ...(page.hovered !== null && known(page.hovered) ? [arrow(page.hovered)] : []));
  }
}
