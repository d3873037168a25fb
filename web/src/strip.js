// The strip of times: a bar for each, the night, days above; play, and what is shown.

import { Choice } from "./choice.js";
import { byId, make, svg } from "./dom.js";
import { allPlants } from "./energy.js";
import { clockText, withError, withUnit } from "./format.js";
import { kPins } from "./page.js";

const kMaxBars = 200; // then an area
const kMaxWide = 64; // of bars without hours, pixels
const kEvery = 700; // milliseconds a time, when played

const icon = (path) => svg("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, svg("path", { d: path }));
const kPlay = "M4 2l10 6-10 6z";
const kPause = "M3 2h4v12H3zM9 2h4v12H9z";

export class Strip {
  constructor(page, parent) {
    Object.assign(this, { page, parent });
    this.isNarrow = matchMedia("(max-width: 640px) and (min-height: 480px)");
    this.isStill = matchMedia("(prefers-reduced-motion: reduce)");
    this.button = make("button", { type: "button", class: "play", "aria-label": "Play", title: "Play (Space)", onclick: () => this.play() }, icon(kPlay));
    this.now = make("p", { class: "now" });
    this.period = make("div", { id: "period" });
    this.strip = make("div", { id: "strip", role: "slider", tabindex: "0", "aria-label": "Time" });
    this.follow = make("button", { type: "button", class: "button", hidden: true, onclick: () => page.live.follow() }, "Follow");
    parent.append(this.button, this.now, this.period, this.follow, this.strip);
    new ResizeObserver(() => this.time()).observe(this.strip);
    this.#listen();
    this.scene();
  }

  scene() {
    this.#fillPeriods();
  }

  #fillPeriods() {
    const { timeline } = this.page;
    const { kinds } = timeline;
    const hasDays = timeline.days.length > 1;
    const options = [
      ...(timeline.total ? [["sum", kinds.total]] : []), ...(hasDays ? [["day", kinds.days]] : []),
      ...(timeline.steps.length > 0 && (timeline.total || hasDays) ? [["step", kinds.steps]] : []),
    ];
    const key = options.join();
    if (this.periodsShown !== key) {
      this.periodsShown = key;
      this.choice = options.length > 1 ? new Choice("Show", options, (kind) => this.#usePeriod(kind)) : null;
      this.period.replaceChildren(...(this.choice ? [this.choice.node] : []));
    }
  }

  /** A period can't be chosen where the quantity has no values. */
  #enable(name, isThere) {
    const button = this.choice?.buttons.get(name);
    if (button) {
      button.disabled = !isThere;
      button.title = isThere ? "" : "This quantity has values for single times only";
    }
  }

  #periodOf(entry) {
    const { timeline } = this.page;
    return entry === timeline.total ? "sum" : timeline.days.includes(entry) ? "day" : "step";
  }

  async #usePeriod(kind) {
    const { page } = this;
    if (page.entry === page.timeline.total && page.timeline.points.length > 0 && kind !== "sum") {
      await page.goTo(page.timeline.points.reduce((best, point) => (page.lightOf(point) > page.lightOf(best) ? point : best)));
    }
    const { timeline, entry } = page;
    const day = timeline.days.find(({ date }) => date === (entry.date ?? timeline.dates[0])) ?? timeline.days[0];
    page.goTo({ sum: timeline.total, day, step: page.brightestBeside(entry) }[kind]);
  }

  /** Draws all anew. */
  time() {
    const { page, parent } = this;
    const { timeline, entry } = page;
    const isEmpty = timeline.isEmpty;
    parent.hidden = isEmpty;
    if (isEmpty) {
      return;
    }
    this.#fillPeriods();
    const kind = this.#periodOf(entry);
    this.choice?.set(kind);
    Object.entries({ sum: timeline.total, day: timeline.days[0] }).forEach(([name, one]) => this.#enable(name, !one || page.hasAt(one)));
    const { title, note } = timeline.titleOf(entry, (step) => page.lightOf(step));
    this.now.replaceChildren(make("b", { id: "time-title" }, title), make("span", {}, `${note}${page.state.show === "difference" ? " · bars: this result alone" : ""}`.replace(/^ · /, "")));
    this.button.hidden = this.isStill.matches || timeline.steps.length < 2;
    this.strip.dataset.sum = kind === "step" ? "no" : "yes";
    this.follow.hidden = page.live?.isFollowing ?? true;
    this.steps = timeline.bars(entry);
    this.hasClock = this.steps.every(({ start }) => start !== null);
    this.#drawBars();
    this.#describe();
  }

  draw() {
    this.#describe();
  }

  /** Pinned organs as lines, as long as the charts are folded. */
  fold() {
    if (this.isFolded !== !this.page.state.drawer) {
      this.time();
    }
  }

  mark() {
    if (this.isFolded && this.pinsShown !== this.page.state.pins.join()) {
      this.time();
    }
  }

  #describe() {
    const { page, strip } = this;
    const { timeline, entry } = page;
    const { quantity, band } = page.run.json.columns[page.column];
    const all = allPlants(page.head, quantity, band, page.run.factorOf(page.time, page.column));
    const mean = all && page.state.show !== "difference" ? `, mean ${withUnit(withError(all.mean, all.error, all.high), page.unit)}` : "";
    const at = Math.max(0, timeline.all.indexOf(entry));
    strip.setAttribute("aria-valuemin", "0");
    strip.setAttribute("aria-valuemax", String(timeline.all.length - 1));
    strip.setAttribute("aria-valuenow", String(at));
    strip.setAttribute("aria-valuetext", `${timeline.titleOf(entry, (step) => page.lightOf(step)).title}${mean}`);
  }

  /** {from, to}: the span of each step on the axis, from 0 to 1. */
  #spans() {
    const n = this.steps.length;
    return this.steps.map(({ start, hours }, i) => (this.hasClock ? { from: start / 24, to: Math.min(1, (start + Math.max(hours, 0.25)) / 24) } : { from: i / n, to: (i + 1) / n }));
  }

  #drawBars() {
    const { page, strip, steps } = this;
    const width = Math.max(100, strip.clientWidth);
    const hasDays = page.timeline.days.length > 1 && steps !== page.timeline.points;
    const [top, high] = [hasDays ? 20 : 2, this.isNarrow.matches ? 32 : 44];
    const node = svg("svg", { width, height: top + high + 18, "aria-hidden": "true" });
    const spans = this.#spans();
    const lights = steps.map((step) => page.lightOf(step));
    const most = Math.max(...lights.filter(Number.isFinite), 1e-30);
    const y = (light) => top + high - Math.max(1, (high * light) / most);
    if (this.hasClock) {
      this.#addNight(node, spans, width, top, high);
    }
    steps.length > kMaxBars ? this.#addArea(node, spans, lights, width, y, top + high) : this.#addSteps(node, spans, lights, width, y, top + high);
    node.append(svg("line", { class: "base", x1: 0, x2: width, y1: top + high, y2: top + high }));
    this.#addTicks(node, spans, width, top + high + 13);
    if (hasDays) {
      this.#addDays(node, width);
    }
    this.isFolded = !page.state.drawer;
    this.pinsShown = page.state.pins.join();
    if (this.isFolded) {
      this.#addPins(node, spans, width, top, high);
    }
    strip.replaceChildren(node);
    Object.assign(this, { spans, width, top });
  }

  /** Hours without a step: the night, or what is still to come. */
  #addNight(node, spans, width, top, high) {
    let at = 0;
    for (const { from, to } of [...spans, { from: 1, to: 1 }]) {
      if (from - at > 0.02) {
        const isToCome = this.page.live?.follow && from === 1;
        node.append(svg("rect", { class: isToCome ? "unknown" : "night", x: at * width, width: (from - at) * width - 1, y: isToCome ? top + high - 4 : top, height: isToCome ? 4 : high, rx: 2 }));
        if ((from - at) * width > 60 && !isToCome) {
          node.append(svg("text", { x: ((at + from) / 2) * width, y: top + high / 2 + 4, "text-anchor": "middle" }, "night"));
        }
      }
      at = Math.max(at, to);
    }
  }

  #addSteps(node, spans, lights, width, y, bottom) {
    const { entry } = this.page;
    this.steps.forEach((step, i) => {
      const whole = Math.max(1.5, (spans[i].to - spans[i].from) * width - 1);
      const wide = this.hasClock ? whole : Math.min(whole, kMaxWide);
      const x = spans[i].from * width + 0.5 + (whole - wide) / 2;
      const isKnown = Number.isFinite(lights[i]);
      if (step === entry || step.key === entry.key) {
        node.append(svg("rect", { class: "frame", x: x - 1, width: wide + 2, y: 1, height: bottom, rx: 3 }));
      }
      const top = isKnown ? y(lights[i]) : bottom - 5;
      node.append(svg("rect", { class: `${isKnown ? "step" : "unknown"}${step.key === entry.key ? " chosen" : ""}`, x, width: wide, y: top, height: bottom - top, rx: 1 }));
    });
  }

  #addArea(node, spans, lights, width, y, bottom) {
    const points = this.steps.flatMap((_, i) => [`${spans[i].from * width},${y(lights[i] || 0)}`, `${spans[i].to * width},${y(lights[i] || 0)}`]);
    node.append(svg("polygon", { class: "step", points: [`0,${bottom}`, ...points, `${width},${bottom}`].join(" ") }));
    const at = this.steps.indexOf(this.page.entry);
    if (at >= 0) {
      node.append(svg("rect", { class: "frame", x: spans[at].from * width - 2, width: 4, y: 1, height: bottom }));
    }
  }

  #addTicks(node, spans, width, y) {
    const text = (x, words, anchor = "middle") => node.append(svg("text", { x, y, "text-anchor": anchor }, words));
    if (this.hasClock) {
      const step = width > 700 ? 3 : 6;
      for (let hour = 0; hour <= 24; hour += step) {
        text((hour / 24) * width, clockText(hour), hour === 0 ? "start" : hour === 24 ? "end" : "middle");
      }
      return;
    }
    const half = (short) => 3.2 * short.length;
    let end = -Infinity; // of the last text: those that would touch it are left out
    this.steps.forEach(({ short }, i) => {
      const x = Math.min(width - half(short), Math.max(half(short), ((spans[i].from + spans[i].to) / 2) * width));
      if (x - half(short) >= end + 12 && 2 * half(short) <= width) {
        text(x, short);
        end = x + half(short);
      }
    });
  }

  /** A row of day sums above the hours. */
  #addDays(node, width) {
    const { timeline, entry } = this.page;
    const { days } = timeline;
    const lightOf = (day) => this.page.dayLight(day);
    const most = Math.max(...days.map(lightOf), 1e-30);
    days.forEach((day, i) => {
      const high = Math.max(1, (14 * lightOf(day)) / most);
      const isChosen = day === entry || day.date === entry.date;
      node.append(svg("rect", { class: `step day${isChosen ? " chosen" : ""}`, x: (i / days.length) * width + 0.5, width: Math.max(1, width / days.length - 1), y: 15 - high, height: high }));
    });
  }

  async #addPins(node, spans, width, top, high) {
    const { page } = this;
    for (const [i, organ] of page.pins.entries()) {
      const course = (await page.courseOf(this.steps, page.column, organ)).map((one) => one?.mean ?? NaN);
      const most = Math.max(...course.filter(Number.isFinite), 1e-30);
      const points = course.flatMap((mean, k) => (Number.isFinite(mean) ? [`${((spans[k].from + spans[k].to) / 2) * width},${top + high - (high * mean) / most}`] : []));
      node.append(svg("polyline", { class: "pin", stroke: kPins[i], points: points.join(" ") }));
    }
  }

  #listen() {
    const { strip } = this;
    const pick = (event) => {
      const { left, top, width } = strip.getBoundingClientRect();
      const part = (event.clientX - left) / width;
      const { days, points } = this.page.timeline;
      if (days.length > 1 && this.steps !== points && event.clientY - top < 18) {
        this.page.goTo(days[Math.min(days.length - 1, Math.max(0, Math.floor(part * days.length)))]);
        return;
      }
      const distance = ({ from, to }) => Math.max(from - part, part - to, 0);
      const nearest = this.spans.reduce((best, span, i) => (distance(span) < distance(this.spans[best]) ? i : best), 0);
      this.page.goTo(this.steps[nearest]);
    };
    strip.addEventListener("pointerdown", (event) => {
      strip.setPointerCapture(event.pointerId);
      this.stop();
      pick(event);
    });
    strip.addEventListener("pointermove", (event) => event.buttons === 1 && strip.hasPointerCapture(event.pointerId) && pick(event));
    strip.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      const end = { Home: 0, End: -1 }[event.key];
      if (step || end !== undefined) {
        event.preventDefault();
        step ? this.step(step) : this.page.goTo(this.steps.at(end));
      }
    });
  }

  /** Goes on by times; from a sum into its first time. */
  step(by) {
    const { timeline, entry } = this.page;
    const all = timeline.steps.includes(entry) ? timeline.steps : this.steps;
    const at = all.findIndex(({ key }) => key === entry.key);
    const next = at < 0 ? (by > 0 ? all[0] : all.at(-1)) : all[at + by];
    this.page.goTo(next);
  }

  get isPlaying() {
    return this.timer !== undefined;
  }

  /** Plays the times on one scale, or stops. */
  play() {
    if (this.isPlaying || this.isStill.matches) {
      this.stop();
      return;
    }
    this.page.set({ sameScale: true, time: this.page.state.time });
    this.page.say("Playing, on one scale for all times");
    const go = async () => {
      const known = this.steps.filter(({ isKnown }) => isKnown);
      const at = known.findIndex(({ key }) => key === this.page.entry.key);
      await this.page.goTo(known[(at + 1) % known.length]);
    };
    this.timer = setInterval(go, kEvery);
    go();
    this.#showButton(kPause, "Pause");
  }

  stop() {
    clearInterval(this.timer);
    this.timer = undefined;
    this.#showButton(kPlay, "Play");
  }

  #showButton(path, name) {
    this.button.replaceChildren(icon(path));
    this.button.setAttribute("aria-label", name);
  }
}
