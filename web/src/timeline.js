// The times of a result, or the frames of a run in progress, in the order of the strip.

import { clockText, dateText, periodText, readTime } from "./format.js";

/** The date some days after another one. */
const daysAfter = (date, days) => new Date(Date.parse(date) + 864e5 * days).toISOString().slice(0, 10);

/** Names of a step of whole days: it has no hour. */
function describePeriod(label, date, hours) {
  const name = periodText(`${date}/${daysAfter(date, Math.round(hours / 24) - 1)}`);
  return { label, name, short: dateText(date), date, start: null, hours };
}

/** Names of a time step: {name: "13:00 – 14:00", short: "13:00", ...} */
function describe(label, seconds) {
  const time = readTime(label);
  if (!time || time.hour === null) {
    return { label, name: label, short: label.replace(/^step /, ""), date: time?.date ?? null, start: null, hours: 0 };
  }
  const hours = seconds / 3600;
  if (hours >= 24) {
    return describePeriod(label, time.date, hours);
  }
  const name = hours > 0 ? `${clockText(time.hour)} – ${clockText(time.hour + hours)}` : clockText(time.hour);
  return { label, name, short: clockText(time.hour), date: time.date, start: time.hour, hours };
}

export class Timeline {
  /**
   *  @param steps, days  entries in order  @param total  entry of the sum, null for none  @param single  the only time of a run without times
   *  @param points  of a sweep: they are the steps, or the days if they have hours
   */
  constructor({ steps, days = [], total = null, single = null, points = [] }) {
    Object.assign(this, { steps, days, total, single, points });
    const dates = [...new Set(steps.map(({ date }) => date))];
    this.hasClock = steps.length > 0 && steps.every(({ start }) => start !== null);
    this.dates = this.hasClock ? dates : [];
    this.hasPeriods = steps.length > 0 && steps.every(({ hours }) => hours >= 24);
  }

  /** The times of a finished result. The `index` of each is its number in the result. */
  static ofRun(run) {
    const all = run.json.times.map((time, index) => ({ ...time, index }));
    const of = (part) => all.filter((time) => time.part === part);
    const steps = of("time_steps").map(({ label, index }) => ({ ...describe(label, run.headOf(index)?.seconds ?? 0), index, key: label, isKnown: true }));
    const days = of("days").map(({ label, index }) => ({ label, date: label, index, key: label, isKnown: true, name: periodText(label) }));
    const [total] = of("total");
    const name = days.length > 1 ? "All days" : days[0]?.label.includes("/") ? `Sum of ${days[0].name}` : "Sum of the day";
    return new Timeline({ steps, days, total: total ? { index: total.index, key: "sum", isKnown: true, name } : null, single: of("")[0] ?? null });
  }

  /**
   * The frames of a run in progress, and the times that are still to be computed.
   * @param frames  [{label, number}]
   * @param all  labels of all times in their order, as far as they are known
   */
  static ofFrames(frames, all = []) {
    const steps = frames.map((frame, index) => ({ ...describe(frame.label, 3600), index, key: `frame-${frame.number}`, isKnown: true, frame }));
    const newest = Math.max(-1, ...frames.map(({ label }) => all.indexOf(label))); // nights are not among them
    const coming = all.slice(newest + 1);
    return new Timeline({ steps: [...steps, ...coming.map((label) => ({ ...describe(label, 3600), index: -1, key: `coming-${label}`, isKnown: false }))] });
  }

  /**
   * The points of a sweep, with the hours of the one that is shown, if it has those of one day.
   * @param names  see pointNames  @param shown  index of a point  @param run  its RunData  @param weights  of a sum of all, null for none
   */
  static ofPoints(names, shown, run, weights) {
    const own = Timeline.ofRun(run);
    const hasHours = own.total !== null && own.hasClock && own.dates.length === 1;
    const last = run.json.times.length - 1;
    const points = names.map((name, point) => ({
      ...name, label: name.name, date: hasHours && point === shown ? own.dates[0] : null, start: null, hours: 0,
      point, index: point === shown ? last : -1, key: `point-${point + 1}`, isKnown: true,
    }));
    const kind = names.every(({ isDate }) => isDate) ? "days" : "points";
    const whole = weights?.reduce((sum, weight) => sum + weight, 0);
    const name = kind === "days" && own.total && Number.isInteger(whole) ? `${whole} days` : `All ${kind}`; // weights count days
    const total = weights ? { point: -1, index: 0, key: "sum", isKnown: true, name, note: `weighted ${own.total ? "sum" : "mean"} of ${points.length}` } : null;
    const steps = hasHours ? own.steps.map((step) => ({ ...step, point: shown, key: `${points[shown].key} ${step.label}` })) : points;
    return new Timeline({ steps, days: hasHours ? points : [], total, points });
  }

  /** The entry of a point of a sweep. */
  point(number) {
    return this.points[number];
  }

  /** The names of kinds of entries: {total, days, steps}. */
  get kinds() {
    const points = this.points.every(({ isDate }) => isDate) ? "Days" : "Points";
    const isSweep = this.points.length > 0;
    const steps = this.hasClock ? "Hours" : isSweep ? points : "Steps";
    return { total: this.days.length > 1 || isSweep ? "All" : "Day", days: isSweep ? points : "Days", steps };
  }

  /** The name of a list of bars: "steps", "points". */
  kindOf(bars) {
    const { days, steps } = this.kinds;
    return (bars === this.points ? days : steps).toLowerCase();
  }

  get isEmpty() {
    return this.all.length < 2 || (this.hasPeriods && this.steps.length === 1);
  }

  /** All that can be chosen. */
  get all() {
    return [...(this.total ? [this.total] : []), ...this.days, ...this.steps];
  }

  /** What is shown first: the sum, or the time of most light. */
  first(lightOf) {
    const brightest = this.steps.reduce((best, step) => (best === null || lightOf(step) > lightOf(best) ? step : best), null);
    return this.total ?? this.days[0] ?? brightest ?? { index: this.single?.index ?? 0, key: "", isKnown: true, name: "" };
  }

  find(key) {
    return this.all.find((entry) => entry.key === key) ?? null;
  }

  /** The steps of the day that an entry belongs to; all, where there are no days. */
  stepsBeside(entry) {
    const date = entry?.date ?? this.dates[0];
    return this.hasClock && this.dates.length > 1 ? this.steps.filter((step) => step.date === date) : this.steps;
  }

  /** The bars of the strip while an entry is shown: points of a sweep, unless one of the hours is chosen. */
  bars(entry) {
    const isSweep = this.points.length > 0;
    return isSweep && !this.steps.includes(entry) ? this.points
      : this.stepsBeside(this.steps.includes(entry) || this.days.includes(entry) ? entry : null);
  }

  /** The steps whose light an entry adds up, or its day's. */
  stepsOf(entry) {
    if (this.hasPeriods) {
      return entry === this.total ? this.steps : this.steps.filter(({ date }) => date === entry.date.split("/")[0]);
    }
    const isSum = entry === this.total;
    return this.stepsBeside(!isSum && entry.date ? entry : null);
  }

  /** The title of an entry, and a note on it. @param lightOf  the light of a step */
  titleOf(entry, lightOf) {
    if (entry.note) {
      return { title: entry.name, note: entry.note };
    }
    if (entry === this.total) {
      const hours = this.steps.reduce((sum, step) => sum + (this.hasClock && lightOf(step) > 0 ? step.hours : 0), 0);
      const lit = hours > 0 ? `, ${Math.round(hours * 10) / 10} h of light` : "";
      return { title: entry.name, note: this.days.length > 1 ? `${this.days.length} days${lit}` : `${this.days[0]?.name ?? ""}${lit}`.replace(/^, /, "") };
    }
    if (this.days.includes(entry)) {
      return { title: entry.name, note: "sum of the day" };
    }
    if (entry.start === null || entry.start === undefined) {
      return { title: entry.name, note: entry.hours >= 24 ? "mean, nights included" : "" };
    }
    return { title: entry.short, note: `${entry.hours === 0 ? "at this instant" : entry.hours === 1 ? "mean of the hour" : "mean"}, ${dateText(entry.date)}` };
  }

  /** A text for the legend: "sum of the day", "13:00 – 14:00". */
  wordsOf(entry) {
    return entry === this.total ? entry.name[0].toLowerCase() + entry.name.slice(1) : this.days.includes(entry) ? entry.isDate === false ? entry.name : `sum of ${entry.name}` : entry.name;
  }
}
