// Starts the page: of a finished result, or of a run in progress.

import { Cards } from "./cards.js";
import { RunData } from "./data.js";
import { byId, make } from "./dom.js";
import { Drawer } from "./drawer.js";
import { Find } from "./find.js";
import { many } from "./format.js";
import { listenToKeys } from "./keys.js";
import { Legend } from "./legend.js";
import { isLive } from "./live.js";
import { followRun } from "./live_page.js";
import { announce, prepare, showTitle } from "./loading.js";
import { Page } from "./page.js";
import { Panel } from "./panel.js";
import { makeRenderer } from "./renderer.js";
import { SaveMenu } from "./save.js";
import { SkyDisc } from "./sky_disc.js";
import { Stage } from "./stage.js";
import { readAddress } from "./state.js";
import { Strip } from "./strip.js";
import { SweepView } from "./sweep.js";
import { Theme } from "./theme.js";
import { Timeline } from "./timeline.js";

const root = document.documentElement;

function notice(text) {
  byId("notice").hidden = false;
  byId("notice").textContent = text;
}

/** The title, the size of the scene, and warnings. */
class Head {
  constructor(page) {
    this.page = page;
    byId("panel-button").addEventListener("click", () => page.set({ panel: !page.state.panel }));
    byId("theme-button").addEventListener("click", () => page.set({ theme: root.dataset.theme === "dark" ? "light" : "dark" }));
    byId("clear").addEventListener("click", () => page.clearFilters());
    this.scene();
    this.fold();
  }

  scene() {
    const { json, count, organCount, shape } = this.page.run;
    showTitle(json.title);
    byId("subtitle").textContent = `${many(organCount, "organ")} · ${many(shape.triangles, "triangle")}${count > organCount ? ` · ${many(count - organCount, "sensor")}` : ""}${json.head.run_file?.cell ? " · one cell of an infinite stand" : ""}`;
    const warnings = json.head.warnings?.length ?? 0;
    byId("warnings").hidden = warnings === 0;
    byId("warnings").textContent = many(warnings, "warning");
  }

  fold() {
    const { panel } = this.page.state;
    document.body.dataset.panel = panel ? "on" : "off";
    byId("panel-button").setAttribute("aria-expanded", String(panel));
  }
}

/** The renderer, or the reason why there is none. */
function openGraphics() {
  try {
    return { renderer: makeRenderer(byId("canvas")) };
  } catch (error) {
    return { reason: error.message };
  }
}

/** Steps to the next organ that is shown. */
function nextOrgan(page, by) {
  const n = page.run.count;
  let organ = page.hovered ?? (by > 0 ? -1 : n);
  for (let i = 0; i < n; ++i) {
    organ = (organ + by + n) % n;
    if (page.isShown[organ]) {
      page.hover(organ);
      page.say(`${page.run.organName(organ)}: ${page.describe(organ)}`);
      return;
    }
  }
}

function listen(page, stage, strip, find) {
  const toggle = (key) => () => page.set({ [key]: !page.state[key] });
  const view = (azimuth, elevation) => () => stage?.lookFrom(azimuth, elevation);
  const inScene = stage ? {
    ArrowLeft: () => stage.turn(-10, 0), ArrowRight: () => stage.turn(10, 0), ArrowUp: () => stage.turn(0, 10), ArrowDown: () => stage.turn(0, -10),
    "+": () => stage.turn(0, 0, 1.2), "=": () => stage.turn(0, 0, 1.2), "-": () => stage.turn(0, 0, 1 / 1.2), "−": () => stage.turn(0, 0, 1 / 1.2),
    f: () => stage.fit(), Home: view(200, 14), 1: view(200, 14), 2: view(180, 0), 3: view(90, 0), 4: view(0, 0), 5: view(270, 0), 6: view(180, 90),
    n: () => nextOrgan(page, 1), p: () => nextOrgan(page, -1), Enter: () => page.hovered !== null && page.pin(page.hovered),
    Escape: () => (page.hovered !== null ? page.hover(null) : page.set({ pins: page.state.pins.slice(0, -1) })),
  } : {};
  listenToKeys({ inScene, anywhere: {
    " ": () => strip.play(), "[": () => strip.step(-1), "]": () => strip.step(1), 0: () => page.goTo(page.timeline.total), "/": () => find.open(),
    e: () => page.set({ show: page.state.show === "error" ? "value" : "error", values: null, errorClass: null }), c: toggle("panel"), b: toggle("drawer"), g: toggle("ground"),
    s: toggle("directions"), t: () => byId("theme-button").click(), "?": () => byId("keys").showModal(),
  } });
  addEventListener("beforeprint", () => {
    if (stage) {
      byId("printed").src = stage.window.copy(1).toDataURL(); // the canvas is cleared by then
    }
    page.notify("print");
  });
}

/**
 * Builds the page around a result.
 * @param graphics  result of openGraphics()
 * @param live  LiveView or SweepView, if it changes
 * @param time  key of the entry to show; null: that of the address
 */
export async function buildPage(run, timeline, graphics, live = null, time = null) {
  const address = readAddress(location.hash);
  const page = new Page(run, timeline, time === null ? address : { ...address, time }, live);
  const theme = new Theme(() => page.state.theme, () => page.values && page.notify("options"));
  const stage = graphics.renderer ? new Stage(page, graphics.renderer) : null;
  if (!stage) {
    document.body.dataset.scene = "off";
    notice(`This browser can't show the scene: it has no WebGL 2 (${graphics.reason}). All numbers are below.`);
    Object.assign(page.state, { tab: "table", drawer: true });
  }
  const strip = new Strip(page, byId("time"));
  const zoom = (organ) => stage?.zoomTo(organ);
  const find = new Find(page, (organ) => {
    stage?.lookAt(organ); // before its card takes a part of the scene
    page.pins.includes(organ) || page.pin(organ);
  });
  page.parts = [theme, new Head(page), new Panel(page, byId("panel"), (azimuth, elevation) => stage?.lookFrom(azimuth, elevation)), ...(stage ? [stage, new Legend(page, byId("legend"))] : []),
    new Drawer(page), strip, new Cards(page, byId("cards"), zoom), find, ...(stage ? [new SkyDisc(page, byId("disc"), () => stage.window.orbit.view)] : [])];
  find.scene();
  new SaveMenu(page, stage?.window);
  listen(page, stage, strip, find);
  await page.update();
  return page;
}

/** Shows the points of a sweep, first the entry in the address. */
async function showSweep(first, graphics) {
  const view = new SweepView(first);
  const { run, timeline, key } = await view.start(readAddress(location.hash).time ?? "");
  view.page = await buildPage(run, timeline, graphics, view, key);
  view.readLight();
}

async function showResult() {
  const loading = RunData.load("", announce); // loads while the slow context is made
  const graphics = openGraphics();
  const run = await loading;
  await (run.hasPoints ? showSweep(run, graphics) : buildPage(run, Timeline.ofRun(run), graphics));
  root.dataset.state = "ready";
}

prepare();
const starting = isLive() ? followRun(openGraphics, buildPage) : showResult();
starting.catch((error) => {
  console.error(error);
  notice(`This run can't be shown: ${error.message}`);
  root.dataset.state = "failed";
});
