// The number one came for, and where the light goes.

import { make } from "./dom.js";
import { lightBudget } from "./energy.js";
import { estimate, kUnknownText, percent } from "./format.js";

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

  draw() {
    const { page, parent } = this;
    const { timeline, entry, band } = page;
    const budget = lightBudget(page, entry, band);
    const time = entry.name ? `, ${timeline.wordsOf(entry)}` : "";
    parent.hidden = budget === null;
    if (!budget) {
      parent.replaceChildren();
      return;
    }
    if (!(budget.plants > 0)) {
      parent.replaceChildren(make("p", { class: "what" }, `The plants absorb${time}`), make("h3", {}, "No light at this time"));
      return;
    }
    const plants = budget.parts.find(({ key }) => key === "plants")?.part;
    const incoming = `${percent(plants, 3)} of ${budget.isPerGround ? "incoming" : "the"} ${band || "light"}${budget.isPerGround ? "" : " that enters the scene"}`;
    parent.replaceChildren(
      make("p", { class: "what" }, `The plants absorb${time}`),
      numberNode(budget.plants, budget.error, budget.unit),
      make("p", { class: "of" }, `${budget.isPerGround ? "of ground · " : ""}${incoming}`),
      this.#bar(budget.parts), this.#list(budget.parts));
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
    return make("div", { class: "light-parts" }, parts.map(({ key, name, part }) =>
      [make("i", { class: `swatch part-${key}` }), make("span", {}, name), make("span", {}, `${(100 * part).toFixed(1)} %`)]));
  }
}
