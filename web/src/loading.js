// The page before its first picture: title, size, theme and parts as they will be.

import { byId } from "./dom.js";
import { many } from "./format.js";
import { readAddress, startOf } from "./state.js";

/** Folds parts of the page and sets the theme as they will be, so that nothing jumps. */
export function prepare() {
  const { panel, drawer, theme } = { ...startOf(innerWidth, innerHeight), ...readAddress(location.hash) };
  Object.assign(document.body.dataset, { panel: panel ? "on" : "off", drawer: drawer ? "on" : "off" });
  document.documentElement.dataset.theme = theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

/** Shows what is awaited, in the scene. */
export function awaiting(words) {
  byId("loading").textContent = words;
}

/** The title of a result, in the head and of the window. */
export function showTitle(title) {
  document.title = `${title} — QuasiMC`;
  byId("title").textContent = title;
  byId("title").title = title;
}

/** Names a result whose shapes are still to be read. */
export function announce({ title, organs, sensors = [] }) {
  showTitle(title);
  awaiting(`Reading the shapes of ${many(organs.count - sensors.length, "organ")}…`);
}
