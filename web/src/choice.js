// Controls of one choice among several, used by arrows as well.

import { make } from "./dom.js";

/** Arrows move the focus among buttons of which one takes part in the order of Tab. */
export function roving(parent, selector, act) {
  parent.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const all = [...parent.querySelectorAll(selector)].filter((one) => !one.hidden && !one.disabled);
    const at = all.indexOf(document.activeElement);
    if (!step || at < 0) {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    const next = all[(at + step + all.length) % all.length];
    next.focus();
    act?.(next);
  });
}

/** Marks the chosen one of a group. @param key  "aria-checked" or "aria-selected" */
export function markChosen(parent, chosen, key = "aria-checked") {
  parent.querySelectorAll(`[${key}]`).forEach((button) => {
    const isChosen = button === chosen;
    button.setAttribute(key, String(isChosen));
    button.tabIndex = isChosen ? 0 : -1;
  });
}

/**
 * A row of buttons of which one is chosen.
 * @param options  pairs [value, text], and a title
 * @param choose  called with a value
 */
export class Choice {
  constructor(label, options, choose, kind = "choice") {
    this.buttons = new Map(options.map(([value, text, title]) => [value, make("button",
      { type: "button", role: "radio", "aria-checked": "false", title, "aria-label": text ? undefined : title, onclick: () => choose(value) }, text)]));
    this.node = make("div", { class: kind, role: "radiogroup", "aria-label": label }, ...this.buttons.values());
    roving(this.node, "button", (button) => button.click());
  }

  set(value) {
    markChosen(this.node, this.buttons.get(value));
    if (!this.buttons.has(value)) {
      this.buttons.values().next().value.tabIndex = 0;
    }
  }
}

/** A box to tick. */
export class Check {
  constructor(id, text, key, choose) {
    this.input = make("input", { type: "checkbox", id, onchange: () => choose(this.input.checked) });
    this.node = make("label", { class: "check" }, this.input, text, key && make("kbd", { "aria-hidden": "true" }, key));
  }

  set(isOn) {
    this.input.checked = isOn;
  }
}
