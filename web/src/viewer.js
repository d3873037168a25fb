// The page: its controls, the choices of the user, and their effects.

import { drawHistogram, drawProfile } from "./charts.js";
import { RunData } from "./data.js";
import { fillLabels, organsPassing, wantedLabels } from "./filters.js";
import { Follower, LiveRun, isLive } from "./live.js";
import { plantColors } from "./plant.js";
import { colorsOf, scaleOf, short, ticks, withError, withUnit } from "./numbers.js";
import { SceneWindow, makeRenderer } from "./scene.js";
import { drawReport, fill, make, table } from "./tables.js";
import { worstOrgans } from "./worst.js";

const $ = (id) => document.getElementById(id);
const kViews = [
  ["Oblique", 200, 25], ["Front", 180, 0], ["Back", 0, 0], ["Right", 90, 0], ["Left", 270, 0], ["Top", 180, 90],
];

class Page {
  /**
   * @param graphics  result of openGraphics()
   * @param onTime  called with the position of the slider in a run in progress; null: it is finished
   */
  constructor(run, graphics, onTime = null) {
    this.run = run;
    this.onTime = onTime;
    this.time = 0;
    this.column = run.columns.length > 0 ? run.columns[0].number : 0;
    this.layer = null;
    this.chosen = null;
    this.hovered = null;
    this.pointed = null; // organs of the bar under the pointer
    this.markBars = [];
    this.bars = []; // bars with the chosen organ, as text
    this.#fillControls();
    this.#describeRun();
    this.#usePart();
    if (graphics.renderer) {
      this.window = new SceneWindow(graphics.renderer, run);
    } else {
      $("stage").hidden = true;
      this.notice(`The scene can't be shown in 3D: this browser has no WebGL 2 (${graphics.fault}). ` +
        "All results are below.");
    }
    $("beside").checked = run.json.grows === true;
    this.#showPlant();
    this.#listen();
  }

  notice(text) {
    $("notice").hidden = false;
    $("notice").append(make("span", text + " "));
  }

  get kind() {
    return this.run.json.columns[this.column];
  }

  unit() {
    return $("aspect").value === "relative" ? "%" : this.run.unit(this.time, this.column);
  }

  columnTitle() {
    const name = this.run.columnName(this.column);
    const unit = this.unit();
    const what = $("aspect").value === "mean" ? name : `standard error of ${name}`;
    return unit ? `${what} (${unit})` : what;
  }

  #fillControls() {
    const { run } = this;
    fill($("map"), Object.keys(run.colorMaps).map((name) => [name, name]));
    const parts = [...new Set(run.json.times.map((time) => time.part))];
    const names = { time_steps: "time steps", days: "days", total: "total" };
    fill($("part"), parts.map((part) => [part, names[part] ?? "run"]));
    $("part-label").hidden = this.onTime !== null;
    $("time-controls").hidden = run.json.times.length < 2;
    for (const [name, azimuth, elevation] of kViews) {
      const button = make("button", name, { type: "button" });
      button.addEventListener("click", () => this.window?.look(azimuth, elevation));
      $("views").append(button);
    }
  }

  /** Fills the parts that depend on the scene: name, kinds of numbers, labels and organs. */
  #describeRun() {
    const { run } = this;
    const { json } = run;
    document.title = `${json.title} — QuasiMC`;
    $("title").textContent = json.title;
    $("subtitle").textContent =
      `${run.count} organ${run.count === 1 ? "" : "s"}, ${run.shape.triangles} triangle${run.shape.triangles === 1 ? "" : "s"} — ${json.program}`;
    fill($("column"), run.columns.map((column) => [column.number, run.columnName(column.number)]));
    $("column").value = this.column;
    if (this.labels !== json.organs.labels) {
      this.labels = json.organs.labels;
      fillLabels($("labels"), this.labels);
    }
    $("ground-label").hidden = json.organs.ground.length === 0;
    const most = Math.min(run.count, 1000);
    $("organ-names").replaceChildren(
      ...Array.from({ length: most }, (_, i) => make("option", undefined, { value: run.organName(i) })));
  }

  /**
   * Shows another frame of a run in progress. @param run  null: the shown one
   * @param at, labels  its index among the frames, and their names
   */
  async show(run, at, labels) {
    if (run && run !== this.run) {
      const id = this.chosen === null ? null : this.run.idOf(this.chosen);
      const { quantity, band } = this.kind;
      const isNewScene = run.shape !== this.run.shape;
      this.run = run;
      const same = run.columns.find((column) => column.quantity === quantity && column.band === band);
      this.column = (same ?? run.columns[0])?.number ?? 0;
      if (isNewScene) {
        this.window?.setScene(run);
        this.#showPlant();
        const found = id === null ? -1 : run.organOfId(id);
        this.chosen = found < 0 ? null : found;
        this.hovered = null;
      }
      this.#describeRun();
      await this.update();
    }
    $("time-controls").hidden = labels.length < 2;
    $("time").hidden = labels.length < 2;
    $("time").max = labels.length - 1;
    $("time").value = at;
    $("time-text").textContent = labels[at];
    $("time").setAttribute("aria-valuetext", labels[at]);
  }

  #timesOfPart() {
    const part = $("part").value;
    return this.run.json.times.map((time, i) => [time, i]).filter(([time]) => time.part === part).map(([, i]) => i);
  }

  #usePart() {
    const times = this.#timesOfPart();
    $("time").max = times.length - 1;
    $("time").value = Math.min(Number($("time").value), times.length - 1);
    $("time").hidden = times.length < 2;
    this.#useTime();
  }

  #useTime() {
    this.time = this.#timesOfPart()[Number($("time").value)];
    $("time-text").textContent = this.run.timeName(this.time);
    $("time").setAttribute("aria-valuetext", this.run.timeName(this.time));
  }

  #listen() {
    const on = (id, event, act) => $(id).addEventListener(event, () => act());
    on("column", "change", () => {
      this.column = Number($("column").value);
      this.#forgetRange();
      this.update();
    });
    on("aspect", "change", () => {
      this.#forgetRange();
      this.update();
    });
    on("map", "change", () => this.update());
    on("keep", "change", () => this.update());
    on("part", "change", () => {
      this.#usePart();
      this.update();
    });
    on("time", "input", () => {
      if (this.onTime) {
        this.onTime(Number($("time").value));
        return;
      }
      this.#useTime();
      this.update();
    });
    for (const id of ["labels", "from", "to", "ground"]) {
      on(id, "input", () => this.paint());
    }
    on("find", "change", () => this.#find());
    on("cut", "change", () => this.#cut());
    on("cut-at", "input", () => this.#cut());
    on("beside", "change", () => this.#showPlant());
    for (const id of ["directions", "sky"]) {
      on(id, "change", () => this.#showDirections());
    }
    on("reset", "click", () => this.#reset());
    $("controls").addEventListener("submit", (event) => event.preventDefault());
    // Printing needs an image: the canvas is cleared by then.
    addEventListener("beforeprint", () => ($("printed").src = this.window?.pictureUrl() ?? ""));
    this.#listenToCanvas();
  }

  #listenToCanvas() {
    const canvas = $("canvas");
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => {
      pressed = [event.offsetX, event.offsetY];
      canvas.focus();
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 0) {
        this.#hover(event.offsetX, event.offsetY);
      }
    });
    canvas.addEventListener("pointerleave", () => this.#leave());
    canvas.addEventListener("pointerup", (event) => {
      if (pressed && Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) < 4 && event.button === 0) {
        this.choose(this.window?.organAt(event.offsetX, event.offsetY) ?? null);
      }
      pressed = null;
    });
    canvas.addEventListener("keydown", (event) => {
      const acts = {
        ArrowLeft: () => this.window.turn(-10, 0), ArrowRight: () => this.window.turn(10, 0),
        ArrowUp: () => this.window.turn(0, 10), ArrowDown: () => this.window.turn(0, -10),
        "+": () => this.window.turn(0, 0, 1.2), "=": () => this.window.turn(0, 0, 1.2),
        "-": () => this.window.turn(0, 0, 1 / 1.2), "−": () => this.window.turn(0, 0, 1 / 1.2),
        n: () => this.#step(1), p: () => this.#step(-1),
        Escape: () => this.choose(null), Home: () => this.window.look(200, 25),
      };
      const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (act && !event.ctrlKey && !event.metaKey && !event.altKey) {
        event.preventDefault();
        act();
      }
    });
  }

  #forgetRange() {
    $("from").value = "";
    $("to").value = "";
  }

  #reset() {
    this.#forgetRange();
    this.layer = null;
    $("labels").querySelectorAll("option").forEach((option) => (option.selected = false));
    $("ground").checked = true;
    $("cut").value = "";
    this.paint();
    this.#cut();
    this.choose(null);
  }

  #find() {
    const text = $("find").value.trim();
    let found = this.run.organOfId(text);
    for (let i = 0; found < 0 && text && i < this.run.count; ++i) {
      found = this.run.organName(i) === text ? i : found;
    }
    if (found >= 0) {
      this.choose(found);
    } else if (text) {
      $("shown").textContent = `No organ has the name or id ${text}.`;
    }
  }

  #step(by) {
    const n = this.run.count;
    let organ = this.chosen ?? (by > 0 ? -1 : n);
    for (let i = 0; i < n; ++i) {
      organ = (organ + by + n) % n;
      if (this.isShown[organ]) {
        this.choose(organ);
        return;
      }
    }
  }

  #cut() {
    const axis = $("cut").value;
    $("cut-at").disabled = !axis;
    if (!axis) {
      $("cut-text").textContent = "Show up to";
      this.window?.cut(null);
      return;
    }
    // Along the axis of the file, within the scene.
    const { axes, low, high, middle, unit } = this.run.json;
    const normal = axes[axis];
    const along = (corner) => normal.reduce((sum, n, k) => sum + n * corner[k], 0);
    const [from, to] = [along(low), along(high)];
    const offset = from + ((to - from) * Number($("cut-at").value)) / 1000;
    const text = `Show up to ${axis} = ${withUnit(short(offset + along(middle)), unit)}`;
    $("cut-text").textContent = text;
    $("cut-at").setAttribute("aria-valuetext", text);
    this.window?.cut(normal, offset);
  }

  #showPlant() {
    const isShown = $("beside").checked;
    $("sides").hidden = !isShown;
    this.window?.paintPlant(isShown ? plantColors(this.run) : null);
  }

  #showDirections() {
    const lights = this.run.json.times[this.time];
    $("sky-label").hidden = !this.run.json.times.some(({ sky }) => sky);
    this.window?.showDirections(lights, $("directions").checked, $("sky").checked);
  }

  #hover(x, y) {
    const organ = this.window?.organAt(x, y) ?? null;
    const tip = $("tip");
    tip.hidden = organ === null;
    if (organ !== null) {
      tip.textContent = `${this.run.organName(organ)}: ${this.describe(organ)}`;
      tip.style.left = `${Math.min(x + 14, $("stage").clientWidth - tip.offsetWidth - 4)}px`;
      tip.style.top = `${Math.max(0, Math.min(y + 14, $("stage").clientHeight - tip.offsetHeight - 4))}px`;
    }
    if (organ !== this.hovered) {
      this.hovered = organ;
      if (this.chosen === null) {
        this.#mark();
        this.showOrgan(organ);
      }
    }
  }

  #leave() {
    $("tip").hidden = true;
    this.hovered = null;
    this.#mark();
    this.showOrgan(this.chosen);
  }

  choose(organ) {
    this.chosen = organ;
    this.#mark();
    this.showOrgan(organ);
  }

  /** Highlights the organs of the bar under the pointer, or else the chosen organ; and its bars. */
  #mark() {
    const one = this.chosen ?? this.hovered;
    this.window?.mark(this.pointed ?? (one === null ? [] : [one]));
    this.bars = this.markBars.map((markBar) => markBar(one));
  }

  /** To be called when the pointer or the focus enters or leaves a bar. @param organs  null: it leaves */
  #point(organs, label) {
    this.pointed = organs;
    const n = organs?.length;
    $("pointed").textContent = organs ? `${label}: ${n} organ${n === 1 ? "" : "s"} highlighted in the scene` : "";
    this.#mark();
  }

  /** The number of the column that is shown, with its error. */
  describe(organ) {
    const { mean, error } = this.values;
    const unit = this.run.unit(this.time, this.column);
    return withUnit(withError(mean[organ], error[organ]), unit);
  }

  /** The columns in the list of an organ: all, but with very many bands only those of the shown band. */
  #toldColumns() {
    const kMost = 60;
    const { columns } = this.run;
    return columns.length <= kMost ? columns : columns.filter(({ band }) => !band || band === this.kind.band);
  }

  async showOrgan(organ) {
    const panel = $("organ");
    if (organ === null) {
      panel.replaceChildren(make("p", "Point at an organ to see its results; click selects it."));
      return;
    }
    const { run, time } = this;
    const columns = this.#toldColumns();
    const all = await Promise.all(columns.map((column) => run.values(time, column.number)));
    if ((this.chosen ?? this.hovered) !== organ || time !== this.time) {
      return; // another organ was chosen in the meantime
    }
    const { unit, organs } = run.json;
    const labels = Object.entries(organs.labels)
      .filter(([, label]) => label.of[organ] >= 0)
      .map(([key, label]) => `${key} = ${label.values[label.of[organ]]}`);
    const about = [`id ${run.idOf(organ)}`, `area ${withUnit(short(run.shape.areas[organ]), unit && `${unit}²`)}`,
      `centre at height ${withUnit(short(run.shape.heights[organ]), unit)}`, ...labels,
      ...this.bars.filter(Boolean).map((bar) => `in bar ${bar}`)];
    const rows = columns.flatMap((column, i) => (all[i] ? [[
      run.columnName(column.number),
      { number: withError(all[i].mean[organ], all[i].error[organ]) },
      { number: `${short(all[i].low[organ])} … ${short(all[i].high[organ])}` },
      run.unit(time, column.number),
    ]] : []));
    panel.replaceChildren(make("h3", run.organName(organ)), make("p", about.join(", ")),
      table("± standard error, and 95 % interval", ["", "value", "interval", "unit"], rows));
  }

  /** The organs that pass the filters: a number for each organ, 0 for hidden ones. */
  #filtered() {
    const bound = (id) => ($(id).value === "" || !Number.isFinite(Number($(id).value)) ? null : Number($(id).value));
    this.range = [bound("from"), bound("to")];
    return organsPassing(this.run, this.numbers,
      { wanted: wantedLabels($("labels")), layer: this.layer, range: this.range, hasGround: $("ground").checked });
  }

  /** The numbers that colours show. */
  #numbersOf({ mean, error }) {
    const aspect = $("aspect").value;
    if (aspect === "mean") {
      return mean;
    }
    return aspect === "error" ? error
      : mean.map((value, i) => (value === 0 ? NaN : (100 * error[i]) / Math.abs(value)));
  }

  /** Reads the numbers of column and time, and shows them. */
  async update() {
    const { run, time, column } = this;
    const values = await run.values(time, column);
    if (time !== this.time || column !== this.column) {
      return; // the choice has changed in the meantime
    }
    const n = run.count;
    const nothing = () => new Float32Array(n).fill(NaN);
    this.absent = values === null && run.has(time, column) ? "The program ended before this page had loaded these values." : "";
    this.values = values ?? { mean: nothing(), error: nothing(), low: nothing(), high: nothing() };
    this.numbers = this.#numbersOf(this.values);
    const what = `${column} ${$("aspect").value}`;
    if (!$("keep").checked || this.scaleIsOf !== what) {
      this.scale = scaleOf(this.numbers, run.shape.areas);
      this.scaleIsOf = what;
    }
    this.paint();
    this.#showDirections();
    this.#drawLegend();
    const worst = worstOrgans(run, column, this.values, (organ) => this.describe(organ), (organ) => this.choose(organ));
    drawReport($("report"), run, time, worst, (quantity, band) => {
      const found = run.json.columns.findIndex((c) => c.quantity === quantity && c.band === band);
      return found < 0 ? "" : run.unit(time, found);
    });
    this.showOrgan(this.chosen ?? this.hovered);
  }

  /** Shows the organs that pass the filters. */
  paint() {
    if (!this.numbers) {
      return;
    }
    this.isShown = this.#filtered();
    const count = this.isShown.reduce((sum, one) => sum + one, 0);
    const map = this.run.colorMaps[$("map").value];
    this.window?.paint(colorsOf(this.numbers, this.isShown, this.scale, map));
    const labels = [...wantedLabels($("labels"))].map(([key, values]) => `, ${key} ${[...values].join(", ")}`).join("");
    $("shown").textContent = `${count} of ${this.run.count} organs shown${labels}` +
      (this.layer ? `, height ${short(this.layer[0])} to ${withUnit(short(this.layer[1]), this.run.json.unit)}` : "");
    this.#drawCharts();
  }

  #drawCharts() {
    const { isShown, numbers } = this;
    const { areas, heights } = this.run.shape;
    this.markBars = [];
    this.#point(null);
    const onPoint = (organs, label) => this.#point(organs, label);
    const markInHistogram = drawHistogram($("histogram"), { numbers, isShown, title: this.columnTitle(), usual: this.scale.high, absent: this.absent }, {
      onPoint,
      onRange: (from, to) => {
        const isSame = this.range[0] !== null && this.range[1] !== null;
        $("from").value = isSame ? "" : String(from);
        $("to").value = isSame ? "" : String(to);
        this.paint();
      },
    });
    const { unit } = this.run.json;
    $("profile-title").textContent = unit ? `Mean by height (${unit})` : "Mean by height";
    const markInProfile = drawProfile($("profile"), { numbers, isShown, title: this.columnTitle(), areas, heights }, {
      onPoint,
      onRange: (from, to) => {
        this.layer = this.layer ? null : [from, to];
        this.paint();
      },
    });
    this.markBars = [markInHistogram, markInProfile];
    this.#mark();
  }

  #drawLegend() {
    const map = this.run.colorMaps[$("map").value];
    const { low, high } = this.scale;
    const time = this.run.timeName(this.time);
    $("legend-title").textContent = this.columnTitle() + (time ? `, ${time}` : "");
    const stops = map.map((rgb) => `rgb(${rgb.join(",")})`).join(",");
    $("legend-bar").style.backgroundImage = `linear-gradient(to top,${stops})`;
    $("legend-ticks").replaceChildren(...ticks(low, high, 5).map((value) => {
      const tick = make("span", short(value));
      tick.style.bottom = `calc(${(100 * (value - low)) / (high - low)}% - 0.7em)`;
      tick.style.transform = "none";
      return tick;
    }));
  }
}

/** The renderer, or the reason why there is none. */
function openGraphics() {
  try {
    return { renderer: makeRenderer($("canvas")) };
  } catch (error) {
    return { fault: error.message };
  }
}

function tellProgress(words, fraction) {
  $("progress").hidden = !words;
  const bar = $("progress").querySelector("progress");
  bar.hidden = fraction < 0;
  bar.value = Math.max(0, fraction);
  $("progress").querySelector("span").textContent = words;
}

/** Follows a run in progress. */
async function followRun() {
  const opening = LiveRun.open();
  const graphics = openGraphics();
  const live = await opening;
  let page = null;
  const show = async (run, at, frames) => {
    const labels = frames.map((frame) => frame.label);
    if (page === null) {
      page = new Page(run, graphics, (index) => follower.select(index));
      await page.update();
      document.documentElement.dataset.state = "ready";
    }
    await page.show(run, at, labels);
    document.documentElement.dataset.frame = frames[at]?.number ?? "";
  };
  const follower = new Follower(live, show, tellProgress);
  document.documentElement.dataset.state = "waiting";
  await follower.follow();
  document.documentElement.dataset.ended = "yes";
}

async function main() {
  if (isLive()) {
    await followRun();
    return;
  }
  const loading = RunData.load(); // loads while the slow context is made
  const graphics = openGraphics();
  const page = new Page(await loading, graphics);
  await page.update();
  document.documentElement.dataset.state = "ready";
}

main().catch((error) => {
  console.error(error);
  $("notice").hidden = false;
  $("notice").textContent = `This run can't be shown: ${error.message}`;
  document.documentElement.dataset.state = "failed";
});
