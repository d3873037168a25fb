// The scene in three dimensions, drawn when something has changed.

import {
  BufferAttribute, BufferGeometry, CanvasTexture, DataTexture, DoubleSide, GLSL3, Group, Line,
  LineBasicMaterial, LineLoop, Mesh, NearestFilter, NoBlending, PerspectiveCamera, RGBAFormat,
  RawShaderMaterial, Scene, Sprite, SpriteMaterial, UnsignedByteType, Vector3, Vector4,
  WebGLRenderTarget, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const kTextureWidth = 2048;

const kVertexShader = `
precision highp float;
precision highp sampler2D;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform sampler2D colors;
in vec3 position;
in float organ;
out vec3 place, seen;
flat out vec3 color;
flat out float number;
void main() {
  int i = int(organ + 0.5);
  vec4 own = texelFetch(colors, ivec2(i % ${kTextureWidth}, i / ${kTextureWidth}), 0);
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  color = own.rgb;
  number = organ;
  place = position;
  seen = view.xyz;
  gl_Position = own.a < 0.5 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * view;
}`;

// Colours are light, not paint: only a little darker where a surface is seen edge-on.
const kFragmentShader = `
precision highp float;
uniform vec4 cut;
uniform float chosen;
uniform bool picking;
in vec3 place, seen;
flat in vec3 color;
flat in float number;
out vec4 result;
void main() {
  if (dot(cut.xyz, place) > cut.w) { discard; }
  if (picking) {
    int i = int(number + 0.5) + 1;
    result = vec4(float(i & 255), float((i >> 8) & 255), float((i >> 16) & 255), 255.0) / 255.0;
    return;
  }
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float facing = abs(dot(normal, normalize(seen)));
  vec3 shown = color * (0.72 + 0.28 * facing);
  if (abs(number - chosen) < 0.5) { shown = mix(shown, vec3(1.0, 0.1, 0.5), 0.75); }
  result = vec4(shown, 1.0);
}`;

/** Whether WebGL is done by the processor: then smooth edges cost more than they are worth. */
function isSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/**
 * Corners that neighbours in the list share are kept once: {places, organs, corners}, of which the
 * last are three numbers of places a triangle. Only the last few places of an organ are looked at.
 */
export function weld(positions, triangles) {
  const kLast = 8;
  const places = new Float32Array(positions.length);
  const organs = new Float32Array(positions.length / 3);
  const corners = new Uint32Array(positions.length / 3);
  let corner = 0;
  let count = 0;
  for (let organ = 0; organ < triangles.length; ++organ) {
    const first = count;
    for (const end = corner + 3 * triangles[organ]; corner < end; ++corner) {
      const x = positions[3 * corner];
      const y = positions[3 * corner + 1];
      const z = positions[3 * corner + 2];
      let at = count - 1;
      const least = Math.max(first, count - kLast);
      while (at >= least && (places[3 * at] !== x || places[3 * at + 1] !== y || places[3 * at + 2] !== z)) {
        --at;
      }
      if (at < least) {
        at = count++;
        places[3 * at] = x;
        places[3 * at + 1] = y;
        places[3 * at + 2] = z;
        organs[at] = organ;
      }
      corners[corner] = at;
    }
  }
  return { places: places.slice(0, 3 * count), organs: organs.slice(0, count), corners };
}

function letter(text, color) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d");
  pen.font = "bold 44px sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = color;
  pen.fillText(text, 32, 34);
  return new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false }));
}

export class SceneWindow {
  /** Throws where there is no WebGL. */
  constructor(canvas, run) {
    this.canvas = canvas;
    this.run = run;
    const isSlow = isSoftware();
    this.renderer = new WebGLRenderer({ canvas, antialias: !isSlow, alpha: true });
    this.renderer.setPixelRatio(isSlow ? 1 : Math.min(2, globalThis.devicePixelRatio || 1));
    this.scene = new Scene();
    this.#measure();
    this.camera = new PerspectiveCamera(35, 1, this.radius / 1000, this.radius * 100);
    this.camera.up.set(0, 0, 1);
    this.#addTriangles();
    this.directions = new Group();
    this.scene.add(this.directions);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.changed());
    this.picture = new WebGLRenderTarget(1, 1); // which organ is seen at each pixel
    this.picture.texture.minFilter = this.picture.texture.magFilter = NearestFilter;
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
    this.look(200, 25);
    this.#resize();
  }

  #measure() {
    this.low = new Vector3(...this.run.json.low);
    this.high = new Vector3(...this.run.json.high);
    this.radius = Math.max(1e-30, this.high.clone().sub(this.low).length() / 2);
  }

  /**
   * Another scene of the same run. One looks at all of it if one has looked at all of the scene
   * before, and otherwise at the same place.
   */
  setScene(run) {
    const moved = new Vector3(...this.run.json.middle).sub(new Vector3(...run.json.middle));
    const from = this.camera.position.clone().sub(this.controls.target);
    const showsAll = this.controls.target.distanceTo(this.#middle()) < 1e-3 * this.radius &&
      Math.abs(from.length() / this.#distance() - 1) < 1e-3;
    this.scene.remove(this.mesh);
    this.mesh.geometry.dispose();
    this.material.dispose();
    this.colors.dispose();
    this.run = run;
    this.#measure();
    this.#addTriangles();
    if (showsAll) {
      this.controls.target.copy(this.#middle());
      this.camera.position.copy(this.controls.target).addScaledVector(from.normalize(), this.#distance());
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

  /** From where all is seen. */
  #distance() {
    const opening = (this.camera.fov * Math.PI) / 360;
    return ((1.25 * this.radius) / Math.sin(opening)) * Math.max(1, 1 / this.camera.aspect);
  }

  #addTriangles() {
    const { run } = this;
    const rows = Math.max(1, Math.ceil(run.count / kTextureWidth));
    this.texels = new Uint8Array(4 * kTextureWidth * rows);
    this.colors = new DataTexture(this.texels, kTextureWidth, rows, RGBAFormat, UnsignedByteType);
    const geometry = new BufferGeometry();
    const { places, organs, corners } = weld(run.positions, run.json.organs.triangles);
    geometry.setAttribute("position", new BufferAttribute(places, 3));
    geometry.setAttribute("organ", new BufferAttribute(organs, 1));
    geometry.setIndex(new BufferAttribute(corners, 1));
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: kVertexShader,
      fragmentShader: kFragmentShader,
      uniforms: {
        colors: { value: this.colors },
        cut: { value: new Vector4(0, 0, 0, 1) },
        chosen: { value: -1 },
        picking: { value: false },
      },
      side: DoubleSide,
      blending: NoBlending,
    });
    this.mesh = new Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  /** @param colorOfOrgan  [r, g, b] of an organ, null to hide it */
  paint(colorOfOrgan) {
    const { texels } = this;
    for (let i = 0; i < this.run.count; ++i) {
      const color = colorOfOrgan(i);
      texels[4 * i + 3] = color ? 255 : 0;
      if (color) {
        texels[4 * i] = color[0];
        texels[4 * i + 1] = color[1];
        texels[4 * i + 2] = color[2];
      }
    }
    this.colors.needsUpdate = true;
    this.changed();
  }

  choose(organ) {
    this.material.uniforms.chosen.value = organ ?? -1;
    this.changed();
  }

  /** Shows dot(normal, p) <= offset, null for all. */
  cut(normal, offset) {
    this.material.uniforms.cut.value.set(...(normal ? [...normal, offset] : [0, 0, 0, 1]));
    this.changed();
  }

  /** From azimuth and elevation, degrees; azimuth clockwise from north. */
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

  /** Turns by angles in degrees, and comes nearer by a factor. */
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

  /** Horizon, north and suns; suns are unit vectors towards them. */
  showDirections(suns, isShown) {
    this.directions.clear();
    if (!isShown) {
      this.changed();
      return;
    }
    const size = 1.15 * this.radius;
    const base = this.low.z;
    const middle = this.#middle().setZ(base);
    const at = (v, far) => middle.clone().addScaledVector(new Vector3(...v), far);
    const line = (points, color, Kind = Line) => {
      const geometry = new BufferGeometry().setFromPoints(points);
      this.directions.add(new Kind(geometry, new LineBasicMaterial({ color })));
    };
    const ring = [];
    for (let i = 0; i < 72; ++i) {
      const angle = (i * Math.PI) / 36;
      ring.push(at([Math.cos(angle), Math.sin(angle), 0], size));
    }
    line(ring, 0x88919a, LineLoop);
    const north = this.run.json.north;
    line([at(north, 0.92 * size), at(north, 1.08 * size)], 0x88919a);
    this.#addLetter("N", "#88919a", at(north, 1.16 * size));
    for (const sun of suns.slice(0, 24)) {
      line([at(sun, 0.85 * size), at(sun, 1.25 * size)], 0xe09b00);
      this.#addLetter("☀", "#e09b00", at(sun, 1.33 * size));
    }
    this.changed();
  }

  #addLetter(text, color, place) {
    const sprite = letter(text, color);
    sprite.position.copy(place);
    sprite.scale.setScalar(0.16 * this.radius);
    this.directions.add(sprite);
  }

  changed() {
    this.isPictureOld = true;
    if (!this.isAsked) {
      this.isAsked = true;
      requestAnimationFrame(() => this.draw());
    }
  }

  draw() {
    this.isAsked = false;
    const far = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(far - 3 * this.radius, far / 500);
    this.camera.far = far + 3 * this.radius;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width > 0 && height > 0) {
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.changed();
    }
  }

  /** The organ at a place of the canvas, CSS pixels; null for none. */
  organAt(x, y) {
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (this.isPictureOld) {
      this.picture.setSize(width, height);
      this.directions.visible = false;
      this.material.uniforms.picking.value = true;
      this.renderer.setRenderTarget(this.picture);
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
      this.renderer.setRenderTarget(null);
      this.material.uniforms.picking.value = false;
      this.directions.visible = true;
      this.isPictureOld = false;
    }
    const pixel = new Uint8Array(4);
    this.renderer.readRenderTargetPixels(this.picture, Math.floor(x), height - 1 - Math.floor(y), 1, 1, pixel);
    const number = pixel[0] + 256 * pixel[1] + 65536 * pixel[2];
    return number > 0 ? number - 1 : null;
  }
}
