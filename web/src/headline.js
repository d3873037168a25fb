// The number one came for, and where the light goes.

import { bandName } from "./data.js";
import { make } from "./dom.js";
import { allPlants, lightBudget, lightDifference } from "./energy.js";
import { isPart, lightOfShown } from "./shown_light.js";
import { estimate, kSigned, kUnknownText, many, percentWithError, withError, withUnit } from "./format.js";
import { kSure } from "./numbers.js";

/** "32.75 ± 0.02 mol m⁻²" in sizes */
export function numberNode(mean, error, unit, high) {
  const text = estimate(mean, error, high);
  return make("p", { class: "number" }, text.value, text.error && make("span", { class: "error" }, `\u00a0±\u00a0${text.error}`),
    unit && text.value !== kUnknownText && make("span", { class: "unit" }, ` ${unit}`));
}

export class Headline {
  constructor(page, parent) {
    Object.assign(this, { page, parent });
  }

  async draw() {
    const { page, parent } = this;
    const { timeline, entry, band } = page;
    const whole = lightBudget(page, entry, band);
    const asked = (this.asked = {});
    const isOfShown = whole && page.state.show !== "difference" && !page.run.isMeasured && isPart(page);
    const budget = isOfShown ? await lightOfShown(page, whole) : whole;
    if (asked !== this.asked) {
      return; // another one is drawn already
    }
    const isAbout = page.run.isMeasured ? this.#measured() : null;
    const time = entry.name ? `, ${timeline.wordsOf(entry)}` : "";
    parent.hidden = budget === null;
    if (!budget) {
      parent.replaceChildren();
      return;
    }
    if (isAbout) {
      parent.replaceChildren(...isAbout, ...this.#rest(budget));
      return;
    }
    const isDifference = page.state.show === "difference";
    const difference = isDifference ? lightDifference(budget, page.minus.result, page.run.json.times[page.time], band) : null;
    if (difference) {
      parent.replaceChildren(...this.#difference(budget, difference, time));
      return;
    }
    const what = `${budget.subject ?? "All organs absorb"}${isDifference ? " in this result alone" : ""}${time}`;
    if (!(budget.plants > 0) && !budget.subject) {
      parent.replaceChildren(make("p", { class: "what" }, what), make("h3", {}, "No light at this time"));
      return;
    }
    parent.replaceChildren(
      make("p", { class: "what" }, what),
      numberNode(budget.plants, budget.error, budget.unit),
      ...[this.#shareWords(budget), this.#meanWords(budget), budget.note].filter(Boolean).map((words) => make("p", { class: "of" }, words)),
      ...this.#rest(budget));
  }

  /** The mean, the least and the greatest of what sensors measure; null if they do not measure what is shown. */
  #measured() {
    const { page } = this;
    const { values: { mean, error, high }, run: { isSensor }, timeline, entry, unit } = page;
    const known = [...mean.keys()].filter((i) => isSensor[i] && page.isShown[i] && Number.isFinite(mean[i]));
    if (known.length === 0) {
      return null;
    }
    const meanOf = (numbers) => known.reduce((sum, i) => sum + numbers[i], 0) / known.length;
    const inOrder = known.sort((a, b) => mean[a] - mean[b]);
    const [low, most] = [inOrder[0], inOrder.at(-1)].map((i) => estimate(mean[i], error[i], high[i]).value);
    const number = numberNode(meanOf(mean), meanOf(error), unit);
    number.title = "The error is an upper bound: the mean of those of the sensors.";
    return [make("p", { class: "what" }, `${many(known.length, "sensor")}, mean${entry.name ? `, ${timeline.wordsOf(entry)}` : ""}`), number,
      make("p", { class: "of" }, `from ${low} to ${withUnit(most, unit)}`)];
  }

  /** "−6.15 ± 0.08 mol m⁻² of ground · 12 % less than “Maize”" */
  #difference({ unit, isPerGround }, { mean, error, part, partError }, time) {
    const title = `“${this.page.minus.title}”`;
    const isClear = Math.abs(mean) >= kSure * (error || 0) && mean !== 0;
    const size = Number.isFinite(part) ? `${percentWithError(Math.abs(part), partError)} ` : "";
    const words = isClear ? `${size}${mean > 0 ? "more" : "less"} than ${title}` : `no clear difference from ${title}`;
    return [make("p", { class: "what" }, `All organs absorb, difference${time}`), numberNode(mean, error, unit, kSigned),
      make("p", { class: "of" }, `${isPerGround ? "of ground · " : ""}${words}`)];
  }

  /** "of ground · 88.4 ± 0.2 % of incoming PAR" in a cell. */
  #shareWords({ parts, isPerGround }) {
    const plants = parts.find(({ key }) => key === "plants");
    return [isPerGround && "of ground", plants && `${percentWithError(plants.part, plants.error)} of incoming ${bandName(this.page.band) || "light"}`].filter(Boolean).join(" · ");
  }

  /** The mean per area outside of a cell: there it is what can be compared. */
  #meanWords({ parts, subject }) {
    const { page } = this;
    const { entry, band, run } = page;
    const column = run.columnOf("absorbed_flux_density", band);
    const found = parts.length > 0 || subject || column < 0 ? null : allPlants(page.headOf(entry), "absorbed_flux_density", band);
    const factor = column < 0 ? 1 : run.factorOf(page.time, column);
    return found && `mean per area ${withUnit(withError(found.mean * factor, found.error * factor, found.high * factor), run.unit(page.time, column)).replaceAll(" ", "\u00a0")}`;
  }

  /** Where the light goes: its parts, or what is known of the rest. */
  #rest({ parts, rest, unit }) {
    return parts.length > 0 ? [this.#bar(parts), this.#list(parts)]
      : [make("div", { class: "light-parts" }, rest.map(({ key, name, light, error }) =>
        [make("i", { class: `swatch part-${key}` }), make("span", {}, name), make("span", {}, withUnit(withError(light, error), unit))]))];
  }

  #bar(parts) {
    const bar = make("div", { class: "light-bar", "aria-hidden": "true" });
    for (const { key, part } of parts) {
      const piece = make("i", { class: `part-${key}` });
      piece.style.flexGrow = part;
      bar.append(piece);
    }
    return bar;
  }

  #list(parts) {
    return make("div", { class: "light-parts" }, parts.map(({ key, name, part, error }) =>
      [make("i", { class: `swatch part-${key}` }), make("span", {}, name), make("span", {}, percentWithError(part, error))]));
  }
}
