// The drawer below the scene, with its tabs; on phones the tabs of the page.

import { Charts } from "./charts.js";
import { markChosen, roving } from "./choice.js";
import { Course } from "./course.js";
import { byId, make } from "./dom.js";
import { OrganTable } from "./organ_table.js";
import { RunTab } from "./run_tab.js";

const kTabs = [["charts", "Charts", "charts"], ["table", "Table", "table"], ["run", "Run and warnings", "report"]];
const kPhoneTabs = [["colour", "Result"], ["charts", "Charts"], ["organs", "Organs"], ["run", "Run"]];
const kTabOf = { charts: "charts", organs: "table", run: "run" };

export class Drawer {
  constructor(page) {
    this.page = page;
    this.parts = [new Charts(page), new Course(page), new OrganTable(page, byId("table")), new RunTab(page, byId("report"))];
    const tab = (id, text, controls, act) => make("button", { type: "button", role: "tab", id, "aria-controls": controls, "aria-selected": "false", onclick: act }, text);
    this.tabs = new Map(kTabs.map(([key, text, panel]) => [key, tab(`tab-${key}`, text, panel, () => page.set({ tab: key, drawer: true }))]));
    byId("drawer-tabs").append(...this.tabs.values());
    roving(byId("drawer-tabs"), "button", (button) => button.click());
    this.phoneTabs = new Map(kPhoneTabs.map(([key, text]) => [key, tab(`phone-${key}`, text, null, () => this.#usePhoneTab(key))]));
    byId("phone-tabs").append(...this.phoneTabs.values());
    roving(byId("phone-tabs"), "button", (button) => button.click());
    byId("drawer-button").addEventListener("click", () => page.set({ drawer: !page.state.drawer }));
    byId("warnings").addEventListener("click", () => {
      page.set({ tab: "run", drawer: true });
      this.#usePhoneTab("run");
      byId("report").scrollTop = 0;
    });
    markChosen(byId("phone-tabs"), this.phoneTabs.get("colour"), "aria-selected");
    this.fold();
  }

  #usePhoneTab(key) {
    document.body.dataset.phone = key;
    markChosen(byId("phone-tabs"), this.phoneTabs.get(key), "aria-selected");
    if (kTabOf[key]) {
      this.page.set({ tab: kTabOf[key] });
    }
  }

  #notify(what) {
    this.parts.forEach((part) => part[what]?.());
  }

  draw() {
    byId("shown").textContent = this.page.shownWords();
    this.#notify("draw");
  }

  mark() {
    this.#notify("mark");
  }

  print() {
    this.#notify("print");
  }

  time() {
    this.#notify("time");
  }

  fold() {
    const { state } = this.page;
    document.body.dataset.drawer = state.drawer ? "on" : "off";
    byId("drawer-button").setAttribute("aria-expanded", String(state.drawer));
    byId("drawer-button").setAttribute("aria-label", state.drawer ? "Fold charts" : "Unfold charts");
    const tab = this.tabs.has(state.tab) ? state.tab : "charts";
    markChosen(byId("drawer-tabs"), this.tabs.get(tab), "aria-selected");
    document.body.dataset.tab = tab;
    kTabs.forEach(([key, , panel]) => (byId(panel).hidden = key !== tab));
    this.#notify("fold");
  }
}
