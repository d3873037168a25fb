// The scene in the page: pointing, pinning, the tip, letters of pinned organs, sun and sky around it.

import { Vector3 } from "three";
import { byId, make } from "./dom.js";
import { Directions } from "./directions.js";
import { disposeDome, makeDome } from "./dome.js";
import { percent } from "./format.js";
import { lightsOf } from "./lights.js";
import { packed } from "./numbers.js";
import { kStriped } from "./organ_colors.js";
import { kPins, pinLetter } from "./page.js";
import { cutEnds } from "./panel.js";
import { plantColors } from "./plant.js";
import { SceneWindow } from "./scene.js";
import { kMaxMarks } from "./passes.js";

const kGround = 0.45; // of the colour of the ground, so that leaves stand out
const kBeside = 60; // degrees beside an organ, from which one turns to it
const rgbOf = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
const isDark = () => document.documentElement.dataset.theme === "dark";

/** The ground behind the scene, into which what is not meant fades. */
const groundColor = () => getComputedStyle(byId("stage")).getPropertyValue("--stage").trim();

export class Stage {
  /** @param renderer  see makeRenderer */
  constructor(page, renderer) {
    this.page = page;
    this.window = new SceneWindow(renderer, page.run, () => this.#moved(), page.extent);
    this.directions = new Directions(byId("behind"), byId("before"));
    this.covered = { left: 0, bottom: 0 };
    this.lights = { paths: [], hours: [], suns: [], lamps: [] };
    this.#listen();
    if (page.state.view) {
      this.window.orbit.view = page.state.view;
    }
    this.window.orbit.controls.addEventListener("end", () => this.keepView());
  }

  scene() {
    this.window.setScene(this.page.run, this.page.extent);
  }

  draw() {
    const { page } = this;
    byId("nothing").hidden = page.isShown.includes(1);
    this.lights = lightsOf(page);
    this.options();
  }

  /** Choices of the view. */
  options() {
    const { page } = this;
    const { state, run } = page;
    if (this.besideShown !== page.isBeside) {
      this.besideShown = page.isBeside;
      byId("sides").hidden = !page.isBeside;
      this.window.paintPlant(page.isBeside ? this.#hide(plantColors(run)) : null);
    }
    if (this.cutShown !== `${state.cut} ${state.cutAt}`) {
      this.cutShown = `${state.cut} ${state.cutAt}`;
      const { normal, from, to } = state.cut ? cutEnds(run, state.cut) : {};
      this.window.cut(normal ?? null, from + (to - from) * state.cutAt);
    }
    const strength = state.show === "value" ? 0.4 : 0.26;
    this.window.setShading(state.shading ? strength : 0, isDark() ? [0.91, 0.94, 0.92] : [0.08, 0.13, 0.11]);
    if (this.behind !== undefined && this.behind !== groundColor()) {
      this.mark(); // another theme
    }
    this.#showDome();
    this.#showNeighbours();
    this.#moved();
  }

  #showNeighbours() {
    const { state, run } = this.page;
    const veil = state.neighbours && run.json.periods?.length > 0 ? rgbOf(groundColor()) : null;
    if (String(this.veilShown) !== String(veil) || this.window.run !== this.veiled) {
      Object.assign(this, { veilShown: veil, veiled: this.window.run });
      this.window.showNeighbours(veil);
    }
  }

  #showDome() {
    const { state } = this.page;
    const { bounds, radius, low } = this.window;
    const isWanted = state.dome && this.lights.cells;
    disposeDome(this.window.backdrop);
    const middle = bounds.low.clone().add(bounds.high).multiplyScalar(0.5).setZ(low.z);
    this.window.setBackdrop(isWanted ? makeDome(middle, 0.9 * radius, this.lights.cells) : null);
  }

  /** Colours, of which hidden organs have none, dimmed ones little, and the ground below organs about a half. */
  #hide(colors, dimmed = null) {
    const { isShown, run } = this.page;
    const behind = packed(groundColor());
    const hasOthers = run.isGround.includes(0);
    const mix = (color, own) => [0, 8, 16].reduce((sum, shift) =>
      sum | (Math.round(own * ((color >> shift) & 255) + (1 - own) * ((behind >> shift) & 255)) << shift), 0);
    const own = (i) => (dimmed && !dimmed.has(i) ? 0.15 : run.isGround[i] && hasOthers && !dimmed ? kGround : 1);
    return colors.map((color, i) => (isShown[i] ? mix(color, own(i)) | (color & kStriped) : -1));
  }

  mark() {
    const { page } = this;
    const behind = groundColor();
    if (this.painted !== page.colors || this.behind !== behind || this.dimmed !== page.pointed || this.besideShown !== this.besidePainted) {
      Object.assign(this, { behind, painted: page.colors, dimmed: page.pointed, besidePainted: this.besideShown });
      this.window.paint(this.#hide(page.colors, page.pointed));
      if (page.isBeside) {
        this.window.paintPlant(this.#hide(plantColors(page.run), page.pointed));
      }
    }
    const own = isDark() ? [0.91, 0.94, 0.92] : [0.08, 0.13, 0.11];
    const pins = page.pins.map((organ, i) => [organ, rgbOf(kPins[i])]);
    const hovered = page.hovered !== null && !page.pins.includes(page.hovered) ? [[page.hovered, own]] : [];
    this.window.mark([...hovered, ...pins].slice(0, kMaxMarks));
    this.#placeBadges();
    requestAnimationFrame(() => this.#fit()); // cards may cover the scene
  }

  legend() {
    this.#fit();
  }

  /** Fits the plants beside or below what covers the scene: legend, sky, cards. */
  #fit() {
    const [stage, legend, disc, cards] = ["stage", "legend", "disc", "cards"].map((id) => byId(id).getBoundingClientRect());
    const over = (box) => (box.width > 0 && box.left < stage.right - 1 ? box : { left: stage.right, bottom: stage.top });
    const right = [over(disc), over(cards)];
    const beside = { left: legend.right - stage.left, top: 12, right: Math.max(12, ...right.map(({ left }) => stage.right - left)), bottom: 16 };
    const below = { left: 12, top: Math.max(legend.bottom, ...right.map(({ bottom }) => bottom)) - stage.top, right: 12, bottom: 16 };
    const free = ({ left, top, right: end, bottom }) => Math.min(stage.width - left - end, stage.height - top - bottom);
    const insets = free(below) > free(beside) ? below : beside;
    this.covered = { left: legend.right - stage.left, bottom: legend.bottom - stage.top };
    const text = JSON.stringify(insets);
    if (this.fitted !== text) {
      this.fitted = text;
      this.window.orbit.setInsets(insets);
    }
  }

  #moved() {
    if (!this.window) {
      return;
    }
    if (this.page.state.directions && !this.page.isBeside) {
      this.directions.draw(this.window, this.lights, this.covered);
    } else {
      this.directions.clear();
    }
    this.#placeBadges();
    this.page.notify("turned");
  }

  #placeBadges() {
    const { page, window } = this;
    const badges = page.isBeside ? [] : page.pins.map((organ, i) => {
      const badge = make("span", { class: "badge" }, pinLetter(i));
      const [x, y] = window.project(this.#middleOf(organ));
      Object.assign(badge.style, { left: `${x}px`, top: `${y}px`, backgroundColor: kPins[i] });
      return badge;
    });
    byId("badges").replaceChildren(...badges);
  }

  /** The vertex of an organ that is nearest to the middle of all of them. */
  #middleOf(organ) {
    const { first, vertices } = this.page.run.shape;
    const points = [];
    for (let i = first[organ]; i < first[organ + 1]; ++i) {
      points.push(new Vector3().fromArray(vertices, 3 * i));
    }
    const middle = points.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(Math.max(1, points.length));
    return points.reduce((best, point) => (point.distanceTo(middle) < best.distanceTo(middle) ? point : best), points[0] ?? middle);
  }

  keepView() {
    const { isFitted, view: { azimuth, elevation, distance, target } } = this.window.orbit;
    const round = (x) => Number(x.toPrecision(6));
    this.page.set({ view: isFitted ? null : { azimuth: round(azimuth), elevation: round(elevation), distance: round(distance), target: target.map(round) } });
  }

  lookFrom(azimuth, elevation) {
    this.window.orbit.viewFrom(azimuth, elevation);
    const isUsual = azimuth === 200 && elevation === 14;
    this.page.set({ view: null });
    if (!isUsual) {
      const { distance, target } = this.window.orbit.view;
      this.page.set({ view: { azimuth, elevation, distance, target } });
    }
  }

  fit() {
    this.window.orbit.fit();
    this.keepView();
  }

  zoomTo(organ) {
    this.window.zoomTo(organ);
    this.keepView();
  }

  /** Turns so that an organ is seen, unless it is: obliquely, to the side that is nearer, as plants seen along their rows hide each other. */
  lookAt(organ) {
    const middle = this.#middleOf(organ).sub(this.window.orbit.controls.target);
    const { azimuth, elevation } = this.window.orbit.view;
    const [nx, ny] = this.page.run.json.north;
    const towards = (Math.atan2(middle.x * ny - middle.y * nx, middle.x * nx + middle.y * ny) * 180) / Math.PI;
    const away = ((azimuth - towards + 540) % 360) - 180;
    if (Math.abs(away) > 90 && middle.length() > 0.1 * this.window.radius && !this.#isSeen(organ)) {
      this.lookFrom((towards + Math.sign(away || 1) * kBeside + 360) % 360, Math.max(elevation, 14));
    }
  }

  /** Whether an organ is in front of others at its middle. */
  #isSeen(organ) {
    return this.window.isSeen(organ, ...this.window.project(this.#middleOf(organ)));
  }

  turn(around, up, nearer) {
    this.window.orbit.turn(around, up, nearer);
    this.keepView();
  }

  #listen() {
    const canvas = byId("canvas");
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => {
      pressed = [event.offsetX, event.offsetY];
      canvas.focus({ preventScroll: true });
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 0) {
        this.#hover(event.offsetX, event.offsetY);
      }
    });
    canvas.addEventListener("pointerleave", () => this.#leave());
    canvas.addEventListener("pointerup", (event) => {
      const isClick = pressed && Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) < 4 && event.button === 0;
      const organ = isClick ? this.window.organAt(event.offsetX, event.offsetY) : null;
      if (organ !== null) {
        this.page.pin(organ);
      }
      pressed = null;
    });
  }

  #hover(x, y) {
    const organ = this.window.organAt(x, y);
    const tip = byId("tip");
    tip.hidden = organ === null;
    if (organ !== null) {
      if (organ !== this.page.hovered) {
        tip.replaceChildren(...this.#tipOf(organ));
      }
      const stage = byId("stage");
      tip.style.left = `${Math.min(x + 14, stage.clientWidth - tip.offsetWidth - 4)}px`;
      tip.style.top = `${Math.max(0, y + 18 + tip.offsetHeight > stage.clientHeight ? y - tip.offsetHeight - 10 : y + 14)}px`;
    }
    this.page.hover(organ);
  }

  #tipOf(organ) {
    const { page } = this;
    const { mean, error } = page.values;
    const sure = error[organ] > 0 && mean[organ] !== 0 ? `standard error ${percent(error[organ] / Math.abs(mean[organ]), 2)}` : "";
    return [make("b", {}, page.run.organName(organ)), make("div", { class: "number" }, page.describe(organ)), make("div", { class: "soft" }, sure)];
  }

  #leave() {
    byId("tip").hidden = true;
    this.page.hover(null);
  }
}
