// The strip of times: choosing one, playing them, and what is shown.

import { Choice } from "./choice.js";
import { byId, make, svg } from "./dom.js";
import { allPlants } from "./energy.js";
import { withError, withUnit } from "./format.js";
import { addPins, stripPicture } from "./strip_bars.js";

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

  #drawBars() {
    const { page, strip } = this;
    const picture = stripPicture(page, this.steps, Math.max(100, strip.clientWidth), this.isNarrow.matches ? 32 : 44);
    this.isFolded = !page.state.drawer;
    this.pinsShown = page.state.pins.join();
    if (this.isFolded) {
      addPins(picture);
    }
    strip.replaceChildren(picture.node);
    this.spans = picture.spans;
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
