// Find: organs by name, id or label, with their values.

import { byId, make } from "./dom.js";
import { cssOf } from "./numbers.js";

const kHits = 8;

/** The first organs that fit a text: {organs, count}. "plant=3" finds by a label. */
function findOrgans(run, text) {
  const wanted = text.trim().toLowerCase();
  const organs = [];
  let count = 0;
  const [key, value] = wanted.split("=").map((part) => part.trim());
  const label = value !== undefined && Object.entries(run.json.organs.labels).find(([name]) => name.toLowerCase() === key)?.[1];
  const fits = label ? (i) => label.of[i] >= 0 && label.values[label.of[i]].toLowerCase() === value
    : (i) => run.organName(i).toLowerCase().includes(wanted);
  const byNumber = run.organOfId(wanted);
  if (byNumber >= 0) {
    organs.push(byNumber);
  }
  for (let i = 0; i < run.count && wanted; ++i) {
    if (fits(i)) {
      ++count;
      if (organs.length < kHits && i !== byNumber) {
        organs.push(i);
      }
    }
  }
  return { organs, count: Math.max(count, organs.length) };
}

export class Find {
  /** @param go  called with an organ that was chosen */
  constructor(page, go) {
    Object.assign(this, { page, go, at: -1, hits: [] });
    this.input = byId("find");
    this.list = byId("hits");
    this.input.addEventListener("input", () => this.#search());
    this.input.addEventListener("focus", () => this.#search());
    this.input.addEventListener("blur", () => this.close());
    this.input.addEventListener("keydown", (event) => this.#key(event));
    byId("find-button").addEventListener("click", () => this.open());
  }

  scene() {
    const { run } = this.page;
    const example = run.organName(Math.min(run.count - 1, 4));
    this.input.placeholder = `Find “${example.slice(0, 18)}”`;
  }

  open() {
    document.body.dataset.find = "on";
    this.input.focus();
    this.input.select();
  }

  close() {
    this.list.hidden = true;
    this.input.setAttribute("aria-expanded", "false");
    document.body.dataset.find = "off";
  }

  #search() {
    const { run } = this.page;
    const text = this.input.value;
    const { organs, count } = findOrgans(run, text);
    this.hits = organs;
    this.at = organs.length > 0 ? 0 : -1;
    const none = `No organ is called “${text.trim()}”. Names look like “${run.organName(0)}”, ids like ${run.idOf(0)}.`;
    this.list.replaceChildren(...organs.map((organ, i) => this.#hit(organ, i)),
      ...(organs.length === 0 ? [make("li", { class: "none" }, none)] : count > organs.length ? [make("li", { class: "none" }, `and ${count - organs.length} more`)] : []));
    this.list.hidden = text.trim() === "";
    this.input.setAttribute("aria-expanded", String(!this.list.hidden));
    this.#show();
    if (!this.list.hidden) {
      this.page.say(organs.length === 0 ? none : `${count} found`);
    }
  }

  #hit(organ, i) {
    const { page } = this;
    const swatch = make("i", { class: "swatch" });
    swatch.style.backgroundColor = cssOf(page.colors[organ]);
    return make("li", { role: "option", id: `hit-${i}`, "aria-selected": "false", onpointerdown: (event) => {
      event.preventDefault();
      this.#choose(organ);
    } }, swatch, page.run.organName(organ), make("span", { class: "soft" }, page.describe(organ)));
  }

  #show() {
    this.list.querySelectorAll("[role=option]").forEach((hit, i) => hit.setAttribute("aria-selected", String(i === this.at)));
    if (this.at >= 0) {
      this.input.setAttribute("aria-activedescendant", `hit-${this.at}`);
    } else {
      this.input.removeAttribute("aria-activedescendant");
    }
  }

  #key(event) {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    event.stopPropagation();
    if (step && this.hits.length > 0) {
      event.preventDefault();
      this.at = (this.at + step + this.hits.length) % this.hits.length;
      this.#show();
    } else if (event.key === "Enter" && this.at >= 0) {
      this.#choose(this.hits[this.at]);
    } else if (event.key === "Escape") {
      this.input.value = "";
      this.close();
      byId("canvas").focus();
    }
  }

  #choose(organ) {
    this.close();
    this.input.value = "";
    byId("canvas").focus();
    this.go(organ);
  }
}
