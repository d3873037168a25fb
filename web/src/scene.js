// The scene in three dimensions, redrawn after changes.

import {
  DoubleSide, GLSL3, Group, Mesh, NearestFilter, NoBlending, PerspectiveCamera, RawShaderMaterial, Scene,
  Vector2, Vector3, Vector4, WebGLRenderTarget, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { disposeDirections, makeDirections } from "./directions.js";
import { FrameBudget } from "./budget.js";
import { OrganGeometry } from "./shape.js";

const kVertexShader = `
precision highp float;
precision highp int;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec4 cut;
in vec3 position;
in uint tint;
flat out uint color;
#ifdef CUT
out float beyond;
#endif
void main() {
  color = tint;
#ifdef CUT
  beyond = dot(cut.xyz, position) - cut.w;
#endif
  gl_Position = tint == 0u ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
}`;

// Colours show light: surfaces seen edge-on are only a little darker, and more in the view of the plant
// without its light. The normal follows from the derivatives of depth: the plane z = slope * xy + c of
// the projection, transformed back by the matrix. So vertices need no normals.
const kFragmentShader = `
precision highp float;
precision highp int;
uniform mat4 projectionMatrix;
uniform vec2 size, corner;
uniform float depth;
flat in uint color;
#ifdef CUT
in float beyond;
#endif
out vec4 result;
void main() {
#ifdef CUT
  if (beyond > 0.0) { discard; }
#endif
  vec4 own = vec4(uvec4(color, color >> 8, color >> 16, color >> 24) & 255u) / 255.0;
#ifdef PICKING
  result = vec4(own.rgb, 1.0);
#else
  vec2 opening = vec2(projectionMatrix[0][0], projectionMatrix[1][1]);
  vec3 seen = 2.0 * (gl_FragCoord.xyz - vec3(corner, 0.0)) / vec3(size, 1.0) - 1.0;
  vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)) * size;
  vec3 normal = vec3(opening * slope, dot(slope, seen.xy) - seen.z - projectionMatrix[2][2]);
  float facing = abs(dot(normalize(normal), normalize(vec3(seen.xy / opening, -1.0))));
  vec3 shown = own.rgb * (1.0 - depth * (1.0 - facing));
  result = vec4(own.a < 0.75 ? mix(shown, vec3(1.0, 0.1, 0.5), 0.75) : shown, 1.0);
#endif
}`;

/** Whether the CPU renders instead of a GPU. */
function isSoftware(gl) {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/**
 * A renderer for a canvas, or for a new one that replaces it. Throws without WebGL. Antialiasing is fixed
 * when a context is made. On a CPU this takes long, and antialiasing is too slow: so the first context is
 * made without it.
 */
export function makeRenderer(canvas) {
  const gl = canvas.getContext("webgl2", { alpha: true, antialias: false });
  if (!gl) {
    throw new Error("no context");
  }
  if (isSoftware(gl)) {
    return new WebGLRenderer({ canvas, context: gl });
  }
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  const other = canvas.cloneNode();
  canvas.replaceWith(other);
  const renderer = new WebGLRenderer({ canvas: other, antialias: true, alpha: true });
  renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio || 1));
  return renderer;
}

function makeMaterial(defines, uniforms) {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader: kVertexShader, fragmentShader: kFragmentShader,
    defines, uniforms, side: DoubleSide, blending: NoBlending,
  });
}

export class SceneWindow {
  /** @param renderer  see makeRenderer */
  constructor(renderer, run) {
    this.run = run;
    this.renderer = renderer;
    this.canvas = this.renderer.domElement;
    this.scene = new Scene();
    this.#measure();
    this.camera = new PerspectiveCamera(35, 1, this.radius / 1000, this.radius * 100);
    this.camera.up.set(0, 0, 1);
    this.uniforms = {
      cut: { value: new Vector4(0, 0, 0, 1) }, size: { value: new Vector2() }, corner: { value: new Vector2() },
      depth: { value: 0 },
    };
    this.material = makeMaterial({}, this.uniforms);
    this.picking = makeMaterial({ PICKING: "" }, this.uniforms);
    this.budget = new FrameBudget(this.renderer.getContext(), () => this.changed());
    this.#addTriangles();
    this.directions = new Group();
    this.scene.add(this.directions);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => {
      this.budget.moved();
      this.changed();
    });
    this.picture = new WebGLRenderTarget(1, 1); // number of the visible organ at each pixel
    this.picture.texture.minFilter = this.picture.texture.magFilter = NearestFilter;
    new ResizeObserver(() => this.#resize()).observe(this.canvas.parentElement);
    this.look(200, 25);
    this.#resize();
    this.#handOver();
  }

  /** Uploads triangles and shaders, which the GPU prepares in the background. */
  #handOver() {
    this.mesh.geometry.setDrawRange(0, 3);
    this.renderer.render(this.scene, this.camera);
    this.mesh.geometry.setDrawRange(0, Infinity);
  }

  #measure() {
    this.low = new Vector3(...this.run.json.low);
    this.high = new Vector3(...this.run.json.high);
    this.radius = Math.max(1e-30, this.high.clone().sub(this.low).length() / 2);
  }

  /**
   * Sets another scene of the same run. If the last one was shown whole, so is this one; otherwise the
   * camera stays.
   */
  setScene(run) {
    const moved = new Vector3(...this.run.json.middle).sub(new Vector3(...run.json.middle));
    const { showsAll } = this;
    this.scene.remove(this.mesh);
    this.organs.dispose();
    this.run = run;
    this.#measure();
    this.#addTriangles();
    if (showsAll) {
      this.#showAll();
    } else {
      this.controls.target.add(moved);
      this.camera.position.add(moved);
    }
    this.controls.update();
    this.changed();
  }

  #middle() {
    return this.low.clone().add(this.high).multiplyScalar(0.5);
  }

  /** The distance from which the whole scene is visible. */
  #distance() {
    const opening = (this.camera.fov * Math.PI) / 360;
    return ((1.25 * this.radius) / Math.sin(opening)) * Math.max(1, 1 / this.camera.aspect);
  }

  /** Whether the whole scene is shown. */
  get showsAll() {
    const far = this.camera.position.distanceTo(this.controls.target);
    return this.controls.target.distanceTo(this.#middle()) < 1e-3 * this.radius &&
      Math.abs(far / this.#distance() - 1) < 1e-3;
  }

  /** Shows the whole scene from the same direction. */
  #showAll() {
    const from = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(this.#middle());
    this.camera.position.copy(this.controls.target).addScaledVector(from, this.#distance());
  }

  #addTriangles() {
    this.organs = new OrganGeometry(this.run.shape);
    this.budget.setTriangles(this.run.shape.triangles);
    this.mesh = new Mesh(this.organs.colored.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  /** @param colors  one per organ, red in the lowest of three bytes; negative hides it */
  paint(colors) {
    this.organs.paint(colors);
    this.changed();
  }

  /** Also shows the plant without light, side by side. @param colors  one per organ; null: the light only */
  paintPlant(colors) {
    const { showsAll } = this;
    this.organs.paintPlant(colors);
    this.#setAspect();
    if (showsAll) {
      this.#showAll();
      this.controls.update();
    }
    this.changed();
  }

  /** Highlights organs. */
  mark(organs) {
    this.organs.mark(organs);
    this.changed(false);
  }

  /** Clips to dot(normal, p) <= offset; null: no clipping. */
  cut(normal, offset) {
    this.uniforms.cut.value.set(...(normal ? [...normal, offset] : [0, 0, 0, 1]));
    for (const material of [this.material, this.picking]) {
      if (normal ? material.defines.CUT === undefined : material.defines.CUT !== undefined) {
        material.needsUpdate = true;
        if (normal) {
          material.defines.CUT = "";
        } else {
          delete material.defines.CUT;
        }
      }
    }
    this.changed();
  }

  /** Sets the camera's azimuth and elevation, degrees; azimuth clockwise from north. */
  look(azimuth, elevation) {
    const north = new Vector3(...this.run.json.north);
    const east = new Vector3(north.y, -north.x, 0);
    const radians = Math.PI / 180;
    const high = Math.min(89.99, Math.max(-89.99, elevation)) * radians;
    const flat = north.multiplyScalar(Math.cos(azimuth * radians)).addScaledVector(east, Math.sin(azimuth * radians));
    const towards = flat.multiplyScalar(Math.cos(high)).add(new Vector3(0, 0, Math.sin(high)));
    const middle = this.#middle();
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(towards, this.#distance());
    this.controls.update();
    this.changed();
  }

  /** Turns by angles in degrees, and zooms in by a factor. */
  turn(around, up, nearer = 1) {
    const from = this.camera.position.clone().sub(this.controls.target);
    const radians = Math.PI / 180;
    const flat = Math.hypot(from.x, from.y);
    const angle = Math.atan2(from.y, from.x) + around * radians;
    const limit = 89.9 * radians;
    const high = Math.min(limit, Math.max(-limit, Math.atan2(from.z, flat) + up * radians));
    const far = from.length() / nearer;
    this.camera.position
      .set(Math.cos(angle) * Math.cos(high), Math.sin(angle) * Math.cos(high), Math.sin(high))
      .multiplyScalar(far)
      .add(this.controls.target);
    this.controls.update();
    this.changed();
  }

  /** Shows horizon, north and sources. @param lights, hasSky  see makeDirections */
  showDirections(lights, isShown, hasSky) {
    this.scene.remove(this.directions);
    disposeDirections(this.directions);
    const base = this.#middle().setZ(this.low.z);
    this.directions = isShown ? makeDirections(base, this.radius, this.run.json.north, lights, hasSky) : new Group();
    this.scene.add(this.directions);
    this.changed(false);
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
    const far = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(far - 3 * this.radius, far / 500);
    this.camera.far = far + 3 * this.radius;
    this.camera.updateProjectionMatrix();
    this.renderer.setScissorTest(true);
    for (const [number, { organs, depth }] of this.#views.entries()) {
      this.#drawView(number, organs.geometry, depth);
    }
    this.renderer.setScissorTest(false);
    this.mesh.geometry = this.organs.colored.geometry;
    this.budget.drawn();
  }

  /** The current picture as a data URL. */
  pictureUrl() {
    this.budget.isMoving = false;
    this.draw();
    return this.canvas.toDataURL();
  }

  /** The views side by side, and how much darker each is where it is seen edge-on. */
  get #views() {
    const { colored, plant } = this.organs;
    return [{ organs: colored, depth: 0.28 }, ...(plant ? [{ organs: plant, depth: 0.6 }] : [])];
  }

  /** The width of a view, CSS pixels. */
  get #width() {
    return Math.floor(this.canvas.clientWidth / this.#views.length);
  }

  #drawView(number, geometry, depth) {
    const { renderer, uniforms } = this;
    const [width, height] = [this.#width, this.canvas.clientHeight];
    const ratio = renderer.getPixelRatio();
    renderer.setViewport(number * width, 0, width, height);
    renderer.setScissor(number * width, 0, width, height);
    uniforms.size.value.set(width, height).multiplyScalar(ratio);
    uniforms.corner.value.set(number * width * ratio, 0);
    uniforms.depth.value = depth;
    this.mesh.geometry = geometry;
    geometry.setDrawRange(0, 3 * Math.ceil(this.budget.share * this.run.shape.triangles));
    renderer.render(this.scene, this.camera);
    geometry.setDrawRange(0, Infinity);
  }

  #setAspect() {
    this.camera.aspect = this.#width / this.canvas.clientHeight;
    this.camera.updateProjectionMatrix();
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const known = this.renderer.getSize(new Vector2());
    if (width > 0 && height > 0 && (width !== known.x || height !== known.y)) {
      this.renderer.setSize(width, height, false); // which clears the canvas
      this.#setAspect();
      if (this.hasDrawn) {
        this.draw();
      }
      this.changed();
    }
  }

  /** The organ at a point of the canvas, in any of its views, CSS pixels; null for none. */
  organAt(x, y) {
    const width = this.#width;
    const height = this.canvas.clientHeight;
    if (this.isPictureOld) {
      this.picture.setSize(width, height);
      this.directions.visible = false;
      this.mesh.geometry = this.organs.numbers().geometry;
      this.mesh.material = this.picking;
      this.renderer.setRenderTarget(this.picture);
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
      this.renderer.setRenderTarget(null);
      this.mesh.geometry = this.organs.colored.geometry;
      this.mesh.material = this.material;
      this.directions.visible = true;
      this.isPictureOld = false;
    }
    const pixel = new Uint8Array(4);
    this.renderer.readRenderTargetPixels(this.picture, Math.floor(x) % width, height - 1 - Math.floor(y), 1, 1, pixel);
    const number = pixel[0] + 256 * pixel[1] + 65536 * pixel[2];
    return number > 0 ? number - 1 : null;
  }
}
