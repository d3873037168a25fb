// The scene in three dimensions: what is in it, and when it is drawn.

import { Mesh, Scene, Vector2, Vector3 } from "three";
import { FrameBudget } from "./budget.js";
import { boundsOf, pointsAround, pointsOf } from "./camera.js";
import { Neighbours } from "./neighbours.js";
import { Orbit } from "./orbit.js";
import { OrganColors } from "./passes.js";
import { ScenePicture } from "./picture.js";
import { isSoftware } from "./renderer.js";
import { OrganGeometry } from "./shape.js";

const kSwift = 60; // milliseconds: a fine picture is drawn at once if it takes less
const kPatience = 1000; // milliseconds: and at rest, if it takes less
const kPause = 600; // milliseconds without a change before it: more than between news of a run, which needs the processor

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
    this.backdrop = null; // a scene behind all others
    this.neighbours = null; // of a periodic cell
    this.scene = new Scene();
    this.picture = new ScenePicture(this);
    this.budget = new FrameBudget(renderer.getContext(), () => this.changed());
    this.#addTriangles();
    this.orbit = new Orbit(this.canvas, this, () => {
      this.budget.moved();
      this.changed();
    });
    new ResizeObserver(() => this.#resize()).observe(this.canvas.parentElement);
    this.canvas.addEventListener("webglcontextrestored", () => this.changed()); // a GPU that was reset has lost the picture
    this.#resize();
    this.picture.handOver();
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
    this.mesh = new Mesh(this.organs.geometry, this.picture.passes.full);
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
      this.orbit.setSize(this.picture.viewWidth, this.canvas.clientHeight);
    }
    this.changed();
  }

  /** Outlines organs. @param marks  see Passes.setMarks */
  mark(marks) {
    this.picture.passes.setMarks(marks);
    this.changed(false);
  }

  /** @param shading  strength of depth shading, 0 for none  @param ink  of edges, 0 to 1 each */
  setShading(shading, ink) {
    this.picture.shading = shading;
    this.picture.passes.edges.ink.value.set(...ink);
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
    const { passes } = this.picture;
    this.neighbours = veil ? new Neighbours(this.organs, this.run.json.periods, passes.copies) : null;
    if (veil) {
      passes.uniforms.veil.value.set(...veil, kPale);
    }
    this.changed(false);
  }

  /** Clips to dot(normal, p) <= offset; null: no clipping. */
  cut(normal, offset) {
    const { passes } = this.picture;
    passes.uniforms.cut.value.set(...(normal ? [...normal, offset] : [0, 0, 0, 1]));
    passes.setCut(normal !== null);
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
    this.picture.isOld ||= moves;
    if (!this.isAsked) {
      this.isAsked = true;
      this.budget.whenReady(() => requestAnimationFrame(() => {
        this.isAsked = false;
        this.draw();
      }));
    }
  }

  /** @param isFine  whether there is time for the picture at rest */
  draw(isFine = this.budget.affords(this.picture.fine, kSwift)) {
    this.hasDrawn = true;
    const { picture, budget } = this;
    const isQuick = this.isQuickAllowed && budget.isMoving;
    const isWhole = budget.share === 1;
    picture.draw(budget.share, isQuick, isFine && isWhole && !budget.isMoving);
    budget.drawn(isWhole && !isQuick ? picture.detail : 0);
    this.#awaitFine();
    this.onView();
  }

  /** Draws the fine picture once nothing changes any more, if it does not take too long. */
  #awaitFine() {
    const { picture, budget } = this;
    clearTimeout(this.pause);
    this.canvas.dataset.rest = picture.isFine ? "yes" : "no";
    if (picture.isFine) {
      return;
    }
    this.pause = setTimeout(() => {
      if (budget.isMoving || budget.fences.length > 0) {
        this.#awaitFine();
      } else if (budget.affords(picture.fine, kPatience)) {
        this.draw(true);
      } else if (!budget.isSettled) {
        this.draw(false);
      } else {
        this.canvas.dataset.rest = "yes";
      }
    }, kPause);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const known = this.renderer.getSize(new Vector2());
    if (width > 0 && height > 0 && (width !== known.x || height !== known.y)) {
      this.renderer.setSize(width, height, false); // which clears the canvas
      this.orbit.setSize(this.picture.viewWidth, height);
      if (this.hasDrawn) {
        this.draw();
      }
      this.changed();
    }
  }

  /** The current picture, as a canvas. @param scale  pixels of it per pixel of the screen */
  copy(scale) {
    this.budget.isMoving = false;
    const copy = this.picture.copy(scale, () => this.draw());
    this.draw();
    return copy;
  }

  /** The position of a point of the scene on the canvas, CSS pixels, in the first view. */
  project(point) {
    this.camera.updateMatrixWorld(); // it may have moved since the last frame
    const seen = point.clone().project(this.camera);
    return [((seen.x + 1) / 2) * this.picture.viewWidth, ((1 - seen.y) / 2) * this.canvas.clientHeight];
  }

  /** The organ at a point of the canvas, in any of its views, CSS pixels; null for none. */
  organAt(x, y) {
    return this.picture.organsAround(x, y, 0)[0];
  }

  /** Whether an organ is seen within some pixels of a point of the canvas. */
  isSeen(organ, x, y, reach = 8) {
    return this.picture.organsAround(x, y, reach).includes(organ);
  }
}
