// The scene in three dimensions: camera, input, and when it is drawn.

import { MathUtils, Mesh, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { FrameBudget } from "./budget.js";
import { boundsOf, fitCamera, pointsOf } from "./camera.js";
import { OrganColors, Passes } from "./passes.js";
import { OrganGeometry } from "./shape.js";

const kOpening = 35; // degrees, upward
const kRadians = Math.PI / 180;

/** Whether the CPU renders instead of a GPU. */
export function isSoftware(gl) {
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

/** Side by side: the light, and the plant in its own colours. */
const kLight = { angle: 0.06 };
const kPlant = { angle: 0.3 };

export class SceneWindow {
  /**
   * @param renderer  see makeRenderer
   * @param onView  called after each frame: the camera may have moved
   */
  constructor(renderer, run, onView) {
    Object.assign(this, { renderer, run, onView, canvas: renderer.domElement, isAsked: false });
    this.isQuickAllowed = isSoftware(renderer.getContext());
    this.insets = { left: 0, top: 0, right: 0, bottom: 0 };
    this.direction = { azimuth: 200, elevation: 14 };
    this.isFitted = true; // until someone turns it
    this.shading = 0;
    this.backdrop = null; // a scene behind all others
    this.scene = new Scene();
    this.passes = new Passes(renderer);
    this.camera = new PerspectiveCamera(kOpening, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.budget = new FrameBudget(renderer.getContext(), () => this.changed());
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("start", () => (this.isFitted = false));
    this.controls.addEventListener("change", () => {
      this.budget.moved();
      this.changed();
    });
    this.#addTriangles();
    new ResizeObserver(() => this.#resize()).observe(this.canvas.parentElement);
    this.#resize();
    this.fit();
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
    this.organs?.dispose();
    this.scene.clear();
    this.organs = new OrganGeometry(run.shape, run.isGround);
    this.light = new OrganColors(run.count);
    this.plant = null;
    this.points = pointsOf(run.shape, run.isGround);
    this.bounds = boundsOf(this.points.plants);
    this.low = new Vector3(...run.json.low);
    this.high = new Vector3(...run.json.high);
    this.radius = Math.max(1e-30, this.high.clone().sub(this.low).length() / 2);
    this.budget.setTriangles(run.shape.triangles);
    this.mesh = new Mesh(this.organs.geometry, this.passes.full);
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  /** Sets another scene of the same run. The camera stays, if someone turned it. */
  setScene(run) {
    const moved = new Vector3(...this.run.json.middle).sub(new Vector3(...run.json.middle));
    this.run = run;
    this.light.dispose();
    this.#addTriangles();
    if (this.isFitted) {
      this.fit();
    } else {
      this.controls.target.add(moved);
      this.camera.position.add(moved);
      this.controls.update();
    }
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
      this.#setAspect();
      this.refit();
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

  /** Sets what covers the canvas, CSS pixels from its sides; the scene is fitted into the rest. */
  setInsets(insets) {
    this.insets = insets;
    this.#setAspect();
    this.refit();
  }

  /** Clips to dot(normal, p) <= offset; null: no clipping. */
  cut(normal, offset) {
    this.passes.uniforms.cut.value.set(...(normal ? [...normal, offset] : [0, 0, 0, 1]));
    this.passes.setCut(normal !== null);
    this.changed();
  }

  /** Shows the plants from an azimuth, clockwise from north, and an elevation, degrees. */
  viewFrom(azimuth, elevation) {
    this.direction = { azimuth, elevation };
    this.fit();
  }

  /** The unit vector from the scene to a camera in a direction. */
  #towards({ azimuth, elevation }) {
    const north = new Vector3(...this.run.json.north);
    const east = new Vector3(north.y, -north.x, 0);
    const high = MathUtils.clamp(elevation, -89.99, 89.99) * kRadians;
    const flat = north.multiplyScalar(Math.cos(azimuth * kRadians)).addScaledVector(east, Math.sin(azimuth * kRadians));
    return flat.multiplyScalar(Math.cos(high)).add(new Vector3(0, 0, Math.sin(high)));
  }

  /** The azimuth and the elevation of the camera, degrees, its target and distance. */
  get view() {
    const from = this.camera.position.clone().sub(this.controls.target);
    const [nx, ny] = this.run.json.north;
    const azimuth = Math.atan2(from.x * ny - from.y * nx, from.x * nx + from.y * ny) / kRadians;
    const elevation = Math.atan2(from.z, Math.hypot(from.x, from.y)) / kRadians;
    return {
      azimuth: (azimuth + 360) % 360, elevation, distance: from.length(), target: this.controls.target.toArray(),
      isFitted: this.isFitted,
    };
  }

  /** Sets the camera to a view. */
  set view({ azimuth, elevation, distance, target }) {
    this.isFitted = false;
    this.#stand(this.#towards({ azimuth, elevation }), new Vector3(...target), distance);
  }

  #stand(towards, target, distance) {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.controls.update();
    this.budget.moved();
    this.changed();
  }

  /** Fits the plants into the free part of the canvas, as seen from the last chosen direction. */
  fit() {
    this.isFitted = true;
    const towards = this.#towards(this.direction);
    const { target, distance } = fitCamera(this.points.all, towards, this.#opening());
    this.#stand(towards, target, distance);
  }

  /** Fits again, unless someone has turned the scene. */
  refit() {
    if (this.isFitted) {
      this.fit();
    }
  }

  /** Moves organs into the middle, and nearer, from the same direction. */
  zoomTo(organ) {
    const { first, vertices } = this.run.shape;
    const points = [];
    for (let i = first[organ]; i < first[organ + 1]; ++i) {
      points.push(new Vector3().fromArray(vertices, 3 * i));
    }
    if (points.length > 0) {
      const { target, distance } = fitCamera(points, this.#towards(this.view), this.#opening().map((x) => x / 3));
      this.isFitted = false;
      this.#stand(this.#towards(this.view), target, distance);
    }
  }

  /** Turns by angles in degrees, and zooms in by a factor. */
  turn(around, up, nearer = 1) {
    const { azimuth, elevation, distance, target } = this.view;
    this.view = {
      azimuth: azimuth - around, elevation: MathUtils.clamp(elevation + up, -89.9, 89.9), distance: distance / nearer, target,
    };
  }

  /** The free rectangle of one view, CSS pixels. */
  #free() {
    const { left, top, right, bottom } = this.insets;
    const [width, height] = [this.#width, this.canvas.clientHeight];
    const fits = width - left - right > 0.35 * width && height - top - bottom > 0.35 * height;
    const used = fits && this.#views.length === 1 ? this.insets : { left: 0, top: 0, right: 0, bottom: 0 };
    return {
      width: Math.max(1, width - used.left - used.right), height: Math.max(1, height - used.top - used.bottom),
      x: (used.left - used.right) / 2, y: (used.top - used.bottom) / 2,
    };
  }

  /** Tangents of half the free angles. */
  #opening() {
    const { width, height } = this.#free();
    const perPixel = Math.tan((kOpening * kRadians) / 2) / (Math.max(1, this.canvas.clientHeight) / 2);
    return [(perPixel * width) / 2, (perPixel * height) / 2];
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

  draw() {
    this.hasDrawn = true;
    const { renderer, passes, budget } = this;
    const isQuick = this.isQuickAllowed && budget.isMoving;
    renderer.setRenderTarget(null);
    renderer.clear();
    this.#setRange();
    this.#drawBackdrop();
    this.organs.drawFraction(budget.share);
    if (isQuick) {
      renderer.clearDepth();
      this.#drawOrgans(passes.quick, null);
    } else {
      this.#drawPicture();
    }
    budget.drawn();
    this.onView();
  }

  #drawPicture() {
    const { passes, renderer } = this;
    this.#drawOrgans(passes.full, passes.target);
    this.isPictureOld = this.budget.share < 1;
    passes.edges.shading.value = this.shading;
    renderer.setViewport(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    passes.drawEdges(this.camera, renderer.getPixelRatio());
  }

  #setRange() {
    const far = this.camera.position.distanceTo(this.controls.target);
    const around = this.controls.target.clone().sub(this.low.clone().add(this.high).multiplyScalar(0.5)).length();
    this.camera.near = Math.max(far - 1.05 * (this.radius + around), far / 500);
    this.camera.far = far + 3 * (this.radius + around);
    this.camera.updateProjectionMatrix();
  }

  #drawBackdrop() {
    if (this.backdrop) {
      this.#eachView((viewport) => {
        this.renderer.setViewport(...viewport);
        this.renderer.render(this.backdrop, this.camera);
      });
    }
  }

  /** Draws organs in all views. @param target  render target; null: the screen */
  #drawOrgans(material, target) {
    const { renderer, passes } = this;
    const ratio = target ? renderer.getPixelRatio() : 1;
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

  #setAspect() {
    const [width, height] = [Math.max(1, this.#width), Math.max(1, this.canvas.clientHeight)];
    const { x, y } = this.#free();
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, -x, -y, width, height);
    this.canvas.dataset.shift = `${x},${y}`;
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const known = this.renderer.getSize(new Vector2());
    if (width > 0 && height > 0 && (width !== known.x || height !== known.y)) {
      this.renderer.setSize(width, height, false); // which clears the canvas
      const ratio = this.renderer.getPixelRatio();
      this.passes.setSize(Math.floor(width * ratio), Math.floor(height * ratio));
      this.#setAspect();
      this.refit();
      if (this.hasDrawn) {
        this.draw();
      }
      this.changed();
    }
  }

  /** The current picture, as a canvas. @param scale  pixels of it per pixel of the screen */
  picture(scale) {
    const { renderer, passes } = this;
    const before = renderer.getPixelRatio();
    const resize = (ratio) => {
      renderer.setPixelRatio(ratio);
      passes.setSize(Math.floor(this.canvas.clientWidth * ratio), Math.floor(this.canvas.clientHeight * ratio));
    };
    const copy = document.createElement("canvas");
    this.budget.isMoving = false;
    resize(before * scale);
    this.draw();
    [copy.width, copy.height] = [this.canvas.width, this.canvas.height];
    copy.getContext("2d").drawImage(this.canvas, 0, 0);
    resize(before);
    this.draw();
    return copy;
  }

  /** The position of a point of the scene on the canvas, CSS pixels, in the first view. */
  project(point) {
    const seen = point.clone().project(this.camera);
    return [((seen.x + 1) / 2) * this.#width, ((1 - seen.y) / 2) * this.canvas.clientHeight];
  }

  /** The organ at a point of the canvas, in any of its views, CSS pixels; null for none. */
  organAt(x, y) {
    if (this.isPictureOld) {
      this.organs.drawFraction(1);
      this.#setRange();
      this.#drawOrgans(this.passes.full, this.passes.target);
      this.isPictureOld = false;
    }
    const ratio = this.renderer.getPixelRatio();
    const { height } = this.passes.target;
    return this.passes.organAt(Math.floor(x * ratio), height - 1 - Math.floor(y * ratio));
  }
}
