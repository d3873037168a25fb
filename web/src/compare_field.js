// "Compared with" in the panel: a point of a sweep, or a result on this computer.

import { Comparison } from "./comparison.js";
import { make } from "./dom.js";
import { ResultFile } from "./result_file.js";

export class CompareField {
  constructor(page) {
    this.page = page;
    this.problem = "";
  }

  /** The elements of the field. */
  build() {
    const { page } = this;
    this.points = page.live?.otherPoint ? this.#pointList() : null;
    this.input = make("input", { type: "file", accept: ".json,application/json", hidden: true, id: "compared-file", onchange: () => this.#read(this.input.files[0]) });
    this.button = make("button", { type: "button", class: "button wide", onclick: () => this.input.click() }, "A result file…");
    this.chip = make("button", { type: "button", class: "chip on", onclick: () => this.#use(null) });
    this.alert = make("p", { class: "bad", role: "alert" });
    this.draw();
    return [this.points, this.button, this.input, this.chip, this.alert];
  }

  #pointList() {
    const { page } = this;
    return make("select", { id: "compared", "aria-label": "Compared with", onchange: () => this.#choosePoint() },
      make("option", { value: "" }, "nothing"), page.timeline.points.map(({ name, point }) => make("option", { value: point }, name)));
  }

  async #choosePoint() {
    const { value } = this.points;
    const other = value === "" ? null : await this.page.live.otherPoint(Number(value));
    if (this.points.value === value) { // no other one was chosen meanwhile
      await this.#use(other);
    }
  }

  async #read(file) {
    this.input.value = ""; // so that the same file can be chosen again
    try {
      const other = await ResultFile.read(file);
      const misfit = other.misfit(new Comparison(this.page.run, other));
      if (misfit) {
        throw new Error(misfit);
      }
      await this.#use(other);
    } catch (error) {
      this.problem = error.message;
      this.draw();
    }
  }

  #use(other) {
    this.problem = "";
    return this.page.compare(other);
  }

  draw() {
    const { other } = this.page;
    const name = other?.name ?? "";
    this.chip.hidden = !name;
    this.chip.textContent = `${name} ✕`;
    this.chip.setAttribute("aria-label", `Stop comparing with ${name}`);
    this.button.hidden = Boolean(name);
    if (this.points) {
      this.points.value = other?.point ?? "";
      [...this.points.options].forEach((option) => (option.disabled = option.value === String(this.page.entry.point)));
    }
    this.alert.textContent = this.problem;
    this.alert.hidden = !this.problem;
  }
}
