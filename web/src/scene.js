// The scene in three dimensions: what is drawn, and when.

import { Mesh, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { FrameBudget } from "./budget.js";
import { boundsOf, pointsAround, pointsOf } from "./camera.js";
import { Neighbours } from "./neighbours.js";
import { Orbit } from "./orbit.js";
import { OrganColors, Passes } from "./passes.js";
import { OrganGeometry } from "./shape.js";

/** Whether the CPU renders instead of a GPU. */
function isSoftware(gl) {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/** A renderer for a canvas. Throws without WebGL 2. Edges are smoothed by the second pass. */
export function makeRenderer(canvas) {
  const gl = canvas.getContext("webgl2", { alpha: true, antialias: false });
  if (!gl) {
    throw new Error("no context");
  }
  const renderer = new WebGLRenderer({ canvas, context: gl });
  renderer.autoClear = false;
  if (!isSoftware(gl)) {
    renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio || 1));
  }
  return renderer;
}

/** The part of the width and height that a CPU renders while the scene moves; the browser enlarges it. */
const kCoarse = 0.5;

/** Pixels of the picture at rest to one of CSS, so that leaves thinner than a pixel do not break into dots. */
const kFine = 2;
const kSwift = 60; // milliseconds: a fine picture is drawn at once if it takes less
const kPatience = 1000; // milliseconds: and at rest, if it takes less
const kPause = 600; // milliseconds without a change before it: more than between news of a run, which needs the processor

/** Side by side: the light, and the plant in its own colours. */
const kLight = { angle: 0.06 };
const kPlant = { angle: 0.3 };

/** What is seen around a sensor, of the radius of the scene: a mark alone would not show where it hangs. */
const kAroundSensor = 0.15;

/** Points, and the corners of a cube about the first of them. */
function withSurroundings(points, radius) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new Vector3(i & 1, (i >> 1) & 1, i >> 2).multiplyScalar(2).subScalar(1));
  return [...points, ...corners.map((corner) => corner.multiplyScalar(radius).add(points[0]))];
}

/** The part of the background in the colours of neighbours. */
const kPale = 0.75;

export class SceneWindow {
  /**
   * @param renderer  see makeRenderer
   * @param onView  called after each frame: the camera may have moved
   * @param extent  see setScene
   */
  constructor(renderer, run, onView, extent = null) {
    Object.assign(this, { renderer, run, onView, extent, canvas: renderer.domElement, isAsked: false });
    this.isQuickAllowed = isSoftware(renderer.getContext());
    this.ratio = renderer.getPixelRatio(); // of pixels at rest to those of CSS
    this.fine = Math.max(1, kFine / this.ratio);
    this.detail = 1; // of the last picture, to the ratio
    this.shading = 0;
    this.backdrop = null; // a scene behind all others
    this.neighbours = null; // of a periodic cell
    this.scene = new Scene();
    this.passes = new Passes(renderer);
    this.budget = new FrameBudget(renderer.getContext(), () => this.changed());
    this.#addTriangles();
    this.orbit = new Orbit(this.canvas, this, () => {
      this.budget.moved();
      this.changed();
    });
    new ResizeObserver(() => this.#resize()).observe(this.canvas.parentElement);
    this.#resize();
    this.#handOver();
  }

  /** Uploads triangles and shaders, which the GPU prepares in the background. */
  #handOver() {
    const { geometry } = this.organs;
    geometry.setDrawRange(0, 3);
    this.#drawOrgans(this.passes.full, this.passes.target);
    geometry.setDrawRange(0, Infinity);
  }

  #addTriangles() {
    const { run } = this;
    this.showNeighbours(null);
    this.organs?.dispose();
    this.scene.clear();
    this.organs = new OrganGeometry(run.shape, run.isGround);
    this.light = new OrganColors(run.count);
    this.plant = null;
    this.north = run.json.north;
    this.points = this.extent ? this.#pointsOfExtent() : pointsOf(run.shape, run.isGround);
    this.bounds = boundsOf(this.points.plants);
    this.low = new Vector3(...run.json.low);
    this.high = new Vector3(...run.json.high);
    this.radius = Math.max(1e-30, this.high.clone().sub(this.low).length() / 2);
    this.budget.setTriangles(run.shape.triangles);
    this.mesh = new Mesh(this.organs.geometry, this.passes.full);
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  /** Points around all states of a growing plant, which keep the camera where it is. */
  #pointsOfExtent() {
    const middle = new Vector3(...this.run.json.middle);
    const around = pointsAround(...this.extent.map((corner) => new Vector3(...corner).sub(middle)));
    return { plants: around, all: around };
  }

  /** Sets another scene of the same run. @param extent  of all its scenes: low and high corner; null: the camera fits each */
  setScene(run, extent) {
    this.extent = extent;
    const moved = new Vector3(...this.run.json.middle).sub(new Vector3(...run.json.middle));
    this.run = run;
    this.light.dispose();
    this.#addTriangles();
    this.orbit.setExtent(this, moved);
    this.changed();
  }

  /** @param colors  one per organ, red in the lowest of three bytes; negative hides it */
  paint(colors) {
    this.light.write(colors);
    this.changed();
  }

  /** Also shows the plant without light, side by side. @param colors  as in paint(); null: the light only */
  paintPlant(colors) {
    const isOther = (colors === null) !== (this.plant === null);
    this.plant?.dispose();
    this.plant = colors ? new OrganColors(this.run.count) : null;
    this.plant?.write(colors);
    if (isOther) {
      this.orbit.setSize(this.#width, this.canvas.clientHeight);
    }
    this.changed();
  }

  /** Outlines organs. @param marks  see Passes.setMarks */
  mark(marks) {
    this.passes.setMarks(marks);
    this.changed(false);
  }

  /** @param shading  strength of depth shading, 0 for none  @param ink  of edges, 0 to 1 each */
  setShading(shading, ink) {
    this.shading = shading;
    this.passes.edges.ink.value.set(...ink);
    this.changed(false);
  }

  /** Sets a scene behind the plants, such as a dome. null: none. */
  setBackdrop(scene) {
    this.backdrop = scene;
    this.changed(false);
  }

  /** Shows pale neighbours of a periodic cell. @param veil  red, green, blue from 0 to 1; null: no neighbours */
  showNeighbours(veil) {
    this.neighbours?.dispose();
    this.neighbours = veil ? new Neighbours(this.organs, this.run.json.periods, this.passes.copies) : null;
    if (veil) {
      this.passes.uniforms.veil.value.set(...veil, kPale);
    }
    this.changed(false);
  }

  /** Clips to dot(normal, p) <= offset; null: no clipping. */
  cut(normal, offset) {
    this.passes.uniforms.cut.value.set(...(normal ? [...normal, offset] : [0, 0, 0, 1]));
    this.passes.setCut(normal !== null);
    this.changed();
  }

  get camera() {
    return this.orbit.camera;
  }

  /** Shows an organ nearer. */
  zoomTo(organ) {
    const { first, vertices } = this.run.shape;
    const points = Array.from({ length: first[organ + 1] - first[organ] }, (_, i) => new Vector3().fromArray(vertices, 3 * (first[organ] + i)));
    if (points.length > 0) {
      this.orbit.zoomTo(this.run.isSensor[organ] ? withSurroundings(points, kAroundSensor * this.radius) : points);
    }
  }

  /** To be called after changes. @param moves  whether the visible organ of a pixel may have changed */
  changed(moves = true) {
    this.isPictureOld ||= moves;
    if (!this.isAsked) {
      this.isAsked = true;
      this.budget.whenReady(() => requestAnimationFrame(() => {
        this.isAsked = false;
        this.draw();
      }));
    }
  }

  /** @param isFine  whether there is time for the picture at rest */
  draw(isFine = this.budget.affords(this.fine, kSwift)) {
    this.hasDrawn = true;
    const { renderer, passes, budget } = this;
    const isQuick = this.isQuickAllowed && budget.isMoving;
    const isWhole = budget.share === 1;
    this.#setDetail(isQuick ? kCoarse : isFine && isWhole && !budget.isMoving ? this.fine : 1);
    renderer.setRenderTarget(null);
    renderer.clear();
    this.orbit.setRange();
    this.#drawBackdrop();
    this.organs.drawFraction(budget.share);
    if (isQuick) {
      renderer.clearDepth();
      this.#drawOrgans(passes.quick, null);
    } else {
      this.#drawNeighbours();
      this.#drawPicture();
    }
    budget.drawn(isWhole && !isQuick ? this.detail : 0);
    this.#awaitFine();
    this.onView();
  }

  /** Sets the number of pixels to be drawn, which clears them. */
  #setDetail(detail) {
    const { renderer, passes, canvas } = this;
    this.detail = detail;
    if (renderer.getPixelRatio() !== this.pixels) {
      renderer.setPixelRatio(this.pixels);
    }
    passes.setSize(Math.floor(canvas.clientWidth * this.pixels), Math.floor(canvas.clientHeight * this.pixels));
  }

  /** Pixels of the last picture to one of CSS. */
  get pixels() {
    return this.ratio * this.detail;
  }

  /** Draws the fine picture once nothing changes any more, if it does not take too long. */
  #awaitFine() {
    clearTimeout(this.pause);
    this.canvas.dataset.rest = this.detail >= this.fine ? "yes" : "no";
    if (this.detail >= this.fine) {
      return;
    }
    this.pause = setTimeout(() => {
      if (this.budget.isMoving || this.budget.fences.length > 0) {
        this.#awaitFine();
      } else if (this.budget.affords(this.fine, kPatience)) {
        this.draw(true);
      } else if (!this.budget.isSettled) {
        this.draw(false);
      } else {
        this.canvas.dataset.rest = "yes";
      }
    }, kPause);
  }

  #drawPicture() {
    const { passes, renderer } = this;
    this.#drawOrgans(passes.full, passes.target);
    this.isPictureOld = this.budget.share < 1;
    passes.edges.shading.value = this.shading;
    renderer.setViewport(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    passes.drawEdges(this.camera, this.pixels);
  }

  #drawBackdrop() {
    if (this.backdrop) {
      this.#eachView((viewport) => {
        this.renderer.setViewport(...viewport);
        this.renderer.render(this.backdrop, this.camera);
      });
    }
  }

  /** Draws the neighbours behind the cell, so that none of them hides it. */
  #drawNeighbours() {
    if (this.neighbours) {
      const { renderer, passes, neighbours } = this;
      this.orbit.setRange(neighbours.reach);
      renderer.clearDepth();
      neighbours.drawFraction(this.budget.share);
      this.#eachView((viewport, { colors, angle }) => {
        passes.uniforms.palette.value = colors.texture;
        passes.uniforms.angle.value = angle;
        renderer.setViewport(...viewport);
        renderer.render(neighbours.scene, this.camera);
      });
      this.orbit.setRange();
    }
  }

  /** Draws organs in all views. @param target  render target; null: the screen */
  #drawOrgans(material, target) {
    const { renderer, passes } = this;
    const ratio = target ? this.pixels : 1;
    this.mesh.material = material;
    renderer.setRenderTarget(target);
    if (target) {
      target.viewport.set(0, 0, target.width, target.height);
      renderer.setRenderTarget(target);
      renderer.clear();
    }
    this.#eachView((viewport, { colors, angle }) => {
      passes.uniforms.palette.value = colors.texture;
      passes.uniforms.angle.value = angle;
      const scaled = viewport.map((x) => Math.floor(x * ratio));
      if (target) {
        target.viewport.set(...scaled);
        renderer.setRenderTarget(target);
      } else {
        renderer.setViewport(...scaled);
      }
      renderer.render(this.scene, this.camera);
    });
    renderer.setRenderTarget(null);
  }

  /** The views side by side. */
  get #views() {
    return [{ colors: this.light, ...kLight }, ...(this.plant ? [{ colors: this.plant, ...kPlant }] : [])];
  }

  #eachView(act) {
    const width = this.#width;
    this.#views.forEach((view, i) => act([i * width, 0, width, this.canvas.clientHeight], view));
  }

  /** The width of a view, CSS pixels. */
  get #width() {
    return Math.floor(this.canvas.clientWidth / (this.plant ? 2 : 1));
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const known = this.renderer.getSize(new Vector2());
    if (width > 0 && height > 0 && (width !== known.x || height !== known.y)) {
      this.renderer.setSize(width, height, false); // which clears the canvas
      this.orbit.setSize(this.#width, height);
      if (this.hasDrawn) {
        this.draw();
      }
      this.changed();
    }
  }

  /** The current picture, as a canvas. @param scale  pixels of it per pixel of the screen */
  picture(scale) {
    const { ratio, fine } = this;
    const copy = document.createElement("canvas");
    this.budget.isMoving = false;
    Object.assign(this, { ratio: ratio * scale, fine: 1 });
    this.draw();
    [copy.width, copy.height] = [this.canvas.width, this.canvas.height];
    copy.getContext("2d").drawImage(this.canvas, 0, 0);
    Object.assign(this, { ratio, fine });
    this.draw();
    return copy;
  }

  /** The position of a point of the scene on the canvas, CSS pixels, in the first view. */
  project(point) {
    this.camera.updateMatrixWorld(); // it may have moved since the last frame
    const seen = point.clone().project(this.camera);
    return [((seen.x + 1) / 2) * this.#width, ((1 - seen.y) / 2) * this.canvas.clientHeight];
  }

  /** The organ at a point of the canvas, in any of its views, CSS pixels; null for none. */
  organAt(x, y) {
    return this.#numbers(x, y, 0)[0];
  }

  /** Whether an organ is seen within some pixels of a point of the canvas. */
  isSeen(organ, x, y, reach = 8) {
    return this.#numbers(x, y, reach).includes(organ);
  }

  /** The organs in a square around a point, null where there is none. */
  #numbers(x, y, reach) {
    if (this.isPictureOld) {
      this.organs.drawFraction(1);
      this.orbit.setRange();
      this.#drawOrgans(this.passes.full, this.passes.target);
      this.isPictureOld = false;
    }
    const { pixels } = this;
    const { height } = this.passes.target;
    return this.passes.organsAround(Math.floor(x * pixels), height - 1 - Math.floor(y * pixels), Math.floor(reach * pixels));
  }
}
