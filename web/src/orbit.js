// The camera of the scene, and how it is turned.

import { MathUtils, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { fitCamera } from "./camera.js";

const kOpening = 35; // degrees, upward
const kRadians = Math.PI / 180;
const kMinFree = 0.35; // of the canvas; with less, what covers it is ignored

/** A camera around a scene; see SceneWindow. */
export class Orbit {
  /** @param extent  {points, low, high, radius, north} of the scene  @param onMove  called after movements */
  constructor(canvas, extent, onMove) {
    Object.assign(this, { canvas, extent, onMove, size: [1, 1] });
    this.insets = { left: 0, top: 0, right: 0, bottom: 0 };
    this.direction = { azimuth: 200, elevation: 14 };
    this.isFitted = true; // until someone turns it
    this.camera = new PerspectiveCamera(kOpening, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("start", () => (this.isFitted = false));
    this.controls.addEventListener("change", () => onMove());
  }

  /** Sets the width and height of a view, CSS pixels. */
  setSize(width, height) {
    this.size = [Math.max(1, width), Math.max(1, height)];
    this.#setOffset();
    this.refit();
  }

  /** Sets what covers the canvas, CSS pixels from its sides; the scene is fitted into the rest. */
  setInsets(insets) {
    this.insets = insets;
    this.#setOffset();
    this.refit();
  }

  /** Another scene. The camera stays, if someone turned it. @param moved  of the origin */
  setExtent(extent, moved) {
    this.extent = extent;
    if (this.isFitted) {
      this.fit();
    } else {
      this.controls.target.add(moved);
      this.camera.position.add(moved);
      this.controls.update();
    }
  }

  /** The free rectangle of one view: its size, and its middle from that of the view. */
  #free() {
    const { left, top, right, bottom } = this.insets;
    const [width, height] = this.size;
    const fits = width - left - right > kMinFree * width && height - top - bottom > kMinFree * height;
    const used = fits ? this.insets : { left: 0, top: 0, right: 0, bottom: 0 };
    return {
      width: width - used.left - used.right, height: height - used.top - used.bottom,
      x: (used.left - used.right) / 2, y: (used.top - used.bottom) / 2,
    };
  }

  /** Tangents of half the free angles. */
  #opening() {
    const { width, height } = this.#free();
    const perPixel = Math.tan((kOpening * kRadians) / 2) / (this.size[1] / 2);
    return [(perPixel * width) / 2, (perPixel * height) / 2];
  }

  /** The target appears in the middle of what is free. */
  #setOffset() {
    const [width, height] = this.size;
    const { x, y } = this.#free();
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, -x, -y, width, height);
    this.canvas.dataset.shift = `${x},${y}`;
  }

  /** Sets the range of depths, so that the whole scene is in it. @param beyond  and what is as far around it */
  setRange(beyond = 0) {
    const { low, high } = this.extent;
    const radius = this.extent.radius + beyond;
    const far = this.camera.position.distanceTo(this.controls.target);
    const around = this.controls.target.distanceTo(low.clone().add(high).multiplyScalar(0.5));
    this.camera.near = Math.max(far - 1.05 * (radius + around), far / 500);
    this.camera.far = far + 3 * (radius + around);
    this.camera.updateProjectionMatrix();
  }

  /** The unit vector from the scene to a camera in a direction. */
  #towards({ azimuth, elevation }) {
    const north = new Vector3(...this.extent.north);
    const east = new Vector3(north.y, -north.x, 0);
    const high = MathUtils.clamp(elevation, -89.99, 89.99) * kRadians;
    const flat = north.multiplyScalar(Math.cos(azimuth * kRadians)).addScaledVector(east, Math.sin(azimuth * kRadians));
    return flat.multiplyScalar(Math.cos(high)).add(new Vector3(0, 0, Math.sin(high)));
  }

  #set(towards, target, distance) {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.controls.update();
    this.onMove();
  }

  /** The azimuth and the elevation of the camera, degrees, its target and distance. */
  get view() {
    const from = this.camera.position.clone().sub(this.controls.target);
    const [nx, ny] = this.extent.north;
    const azimuth = Math.atan2(from.x * ny - from.y * nx, from.x * nx + from.y * ny) / kRadians;
    const elevation = Math.atan2(from.z, Math.hypot(from.x, from.y)) / kRadians;
    return { azimuth: (azimuth + 360) % 360, elevation, distance: from.length(), target: this.controls.target.toArray() };
  }

  /** Sets the camera to a view. */
  set view({ azimuth, elevation, distance, target }) {
    this.isFitted = false;
    this.#set(this.#towards({ azimuth, elevation }), new Vector3(...target), distance);
  }

  /** Shows the plants from an azimuth, clockwise from north, and an elevation, degrees. */
  viewFrom(azimuth, elevation) {
    this.direction = { azimuth, elevation };
    this.fit();
  }

  /** Fits the plants into the free part of the canvas, from the last chosen direction. */
  fit() {
    this.isFitted = true;
    const towards = this.#towards(this.direction);
    const { target, distance } = fitCamera(this.extent.points.all, towards, this.#opening());
    this.#set(towards, target, distance);
  }

  /** Fits again, unless someone has turned the scene. */
  refit() {
    if (this.isFitted) {
      this.fit();
    }
  }

  /** Shows points in the middle, and nearer, from the same direction. */
  zoomTo(points) {
    const towards = this.#towards(this.view);
    const { target, distance } = fitCamera(points, towards, this.#opening().map((x) => x / 3));
    this.isFitted = false;
    this.#set(towards, target, distance);
  }

  /** Turns by angles in degrees, and zooms in by a factor. */
  turn(around, up, nearer = 1) {
    const { azimuth, elevation, distance, target } = this.view;
    this.view = { azimuth: azimuth - around, elevation: MathUtils.clamp(elevation + up, -89.9, 89.9), distance: distance / nearer, target };
  }
}
