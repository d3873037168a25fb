// Keys, and the dialog that lists them.

import { byId, make } from "./dom.js";

const kInScene = [["← → ↑ ↓", "turn"], ["+ −", "zoom"], ["F", "fit all"], ["1 – 6", "views"], ["N P", "next, previous organ"], ["Enter", "pin"], ["Esc", "let go, then unpin"]];
const kAnywhere = [["Space", "play"], ["[ ]", "time back, on"], ["0", "sum"], ["/", "find"], ["E", "value or error"], ["C", "settings"], ["B", "charts"], ["G", "ground"],
  ["S", "sun path"], ["T", "light or dark"], ["?", "keys"]];
const kMouse = [["drag", "turn"], ["right drag", "move"], ["wheel", "zoom"], ["click", "pin an organ"]];

/** Fills the dialog of keys. */
function fillDialog(dialog) {
  const list = (rows) => make("dl", {}, rows.flatMap(([key, text]) => [make("dt", {}, make("kbd", {}, key)), make("dd", {}, text)]));
  dialog.replaceChildren(make("h2", {}, "In the scene"), list(kInScene), make("h2", {}, "Everywhere"), list(kAnywhere), make("h2", {}, "Mouse"), list(kMouse),
    make("button", { type: "button", class: "button main", autofocus: true, onclick: () => dialog.close() }, "Close"));
}

const isTyping = ({ target }) => target.matches?.("input:not([type=checkbox]):not([type=range]), select, textarea");

/**
 * @param acts  {inScene, anywhere}: what to do by key, in lower case. Keys with Ctrl, Alt or Meta are left to the browser.
 */
export function listenToKeys({ inScene, anywhere }) {
  const use = (acts, event) => {
    const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (act && !event.ctrlKey && !event.metaKey && !event.altKey && !event.defaultPrevented) {
      event.preventDefault();
      act();
    }
  };
  byId("canvas").addEventListener("keydown", (event) => use(inScene, event));
  addEventListener("keydown", (event) => {
    const isButton = event.key === " " && event.target.closest?.("button, summary, [role=button], input, a");
    if (!isTyping(event) && !isButton && !byId("keys").open) {
      use(anywhere, event);
    }
  });
  fillDialog(byId("keys"));
  byId("keys-button").addEventListener("click", () => byId("keys").showModal());
}
