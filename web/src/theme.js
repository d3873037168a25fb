// Light or dark: as the system has it, until one is chosen.

const kSystem = matchMedia("(prefers-color-scheme: dark)");

/** @param chosenOf  returns "light", "dark" or "" for the system's  @param changed  called after a change */
export class Theme {
  constructor(chosenOf, changed) {
    Object.assign(this, { chosenOf, changed });
    kSystem.addEventListener("change", () => this.fold());
    this.fold();
  }

  get now() {
    return this.chosenOf() || (kSystem.matches ? "dark" : "light");
  }

  fold() {
    const { now } = this;
    if (document.documentElement.dataset.theme !== now) {
      document.documentElement.dataset.theme = now;
      this.changed();
    }
  }
}
