// Drawing in two passes: organs into textures of colours, organs' numbers and depth; then edges, depth
// shading and outlines, pixel by pixel.

import {
  DataTexture, DepthTexture, DoubleSide, GLSL3, Mesh, NearestFilter, NoBlending, OneMinusSrcAlphaFactor, OneFactor,
  CustomBlending, BufferGeometry, BufferAttribute, OrthographicCamera, RawShaderMaterial, RGBAFormat, Scene, UnsignedByteType, UnsignedIntType, Vector2, Vector3, Vector4,
  WebGLRenderTarget,
} from "three";
import { kStriped } from "./organ_colors.js";

const kWidth = 1024; // of textures with a texel for each organ
export const kMaxMarks = 8; // maximum number of outlined organs

const kOrganVertex = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec4 cut;
uniform sampler2D palette;
in vec3 position;
in uint organ;
#ifdef COPY
in vec3 shift;
uniform vec4 veil;
#endif
flat out vec4 color;
flat out uint number;
out vec3 seen;
#ifdef CUT
out float beyond;
#endif
void main() {
  vec4 own = texelFetch(palette, ivec2(int(organ) % ${kWidth}, int(organ) / ${kWidth}), 0);
  color = own;
  number = organ + 1u;
#ifdef CUT
  beyond = dot(cut.xyz, position) - cut.w;
#endif
#ifdef COPY
  color.rgb = mix(color.rgb, veil.rgb, veil.a);
  vec4 view = modelViewMatrix * vec4(position + shift, 1.0);
#else
  vec4 view = modelViewMatrix * vec4(position, 1.0);
#endif
  seen = view.xyz;
  gl_Position = own.a == 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * view;
}`;

// Colours show light: surfaces that are seen edge-on are only a little darker. The normal follows from
// the derivatives of position, so vertices need no normals.
const kOrganFragment = `
precision highp float;
precision highp int;
const float kBright = 1.3; // of stripes, to what is between them
uniform float angle, stripes;
flat in vec4 color;
flat in uint number;
in vec3 seen;
#ifdef CUT
in float beyond;
#endif
layout(location = 0) out vec4 shown;
#ifndef QUICK
layout(location = 1) out vec4 organ;
#endif
void main() {
#ifdef CUT
  if (beyond > 0.0) { discard; }
#endif
  vec3 normal = cross(dFdx(seen), dFdy(seen));
  float facing = abs(dot(normal, seen)) / max(length(normal) * length(seen), 1e-30);
  float bright = color.a < 1.0 && fract((gl_FragCoord.x + gl_FragCoord.y) / stripes) > 0.4 ? kBright : 1.0;
  shown = vec4(min(color.rgb * bright, 1.0) * (1.0 - angle * (1.0 - facing)), 1.0);
#ifndef QUICK
  organ = vec4(uvec4(number, number >> 8, number >> 16, 255u) & 255u) / 255.0;
#endif
}`;

const kScreenVertex = `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }`;

const kEdgeFragment = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D colors, organs, depths;
uniform ivec2 last;
uniform vec2 clip;
uniform float shading, reach, pixel;
uniform vec3 ink;
uniform int markCount, markWidth;
uniform vec3 marks[${kMaxMarks}], markColors[${kMaxMarks}];
out vec4 result;

const float kDim = 0.32; // of organs that are hardly seen on a dark ground, whose outline is brighter

ivec2 inside(ivec2 at) { return clamp(at, ivec2(0), last); }
float distanceAt(ivec2 at) {
  float depth = texelFetch(depths, inside(at), 0).r;
  return clip.x * clip.y / (clip.y - depth * (clip.y - clip.x));
}

/** How much of the surroundings is nearer: pairs of opposite points, so that slanted planes cancel. */
float nearness(ivec2 at, float own) {
  float most = reach * pixel * own;
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    float turn = 2.39996 * float(i);
    ivec2 step = ivec2(round(vec2(cos(turn), sin(turn)) * reach * sqrt((float(i) + 0.5) / 8.0)));
    float one = clamp((own - distanceAt(at + step)) / most, -1.0, 1.0);
    float other = clamp((own - distanceAt(at - step)) / most, -1.0, 1.0);
    sum += clamp(one + other - 0.1, 0.0, 1.0);
  }
  return sum / 8.0;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 own = texelFetch(organs, at, 0).rgb;
  ivec2 steps[4] = ivec2[4](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
  vec4 color = texelFetch(colors, at, 0);
  vec4 around = vec4(0.0);
  float others = 0.0;
  float nearest = 1e30;
  for (int i = 0; i < 4; ++i) {
    ivec2 to = inside(at + steps[i]);
    if (texelFetch(organs, to, 0).rgb != own) {
      around += texelFetch(colors, to, 0);
      others += 1.0;
      nearest = min(nearest, distanceAt(to));
    }
  }
  bool isOrgan = own != vec3(0.0);
  float distance = isOrgan ? distanceAt(at) : 1e29;
  if (isOrgan && shading > 0.0) {
    color.rgb *= 1.0 - shading * nearness(at, distance);
  }
  if (others > 0.0) {
    color = mix(color, around / others, 0.25);
    if (nearest < distance) {
      bool isDim = ink.r > 0.5 && dot(around.rgb / others, vec3(0.2126, 0.7152, 0.0722)) < kDim;
      color = !isOrgan && isDim ? mix(color, vec4(ink, 1.0), 0.5) : vec4(mix(color.rgb, ink * color.a, isOrgan ? 0.20 : 0.22), color.a);
    }
  }
  for (int k = 0; k < markCount; ++k) {
    if (own != marks[k]) {
      for (int i = 0; i < 8; ++i) {
        ivec2 step = ivec2(round(1.2 * float(markWidth) * vec2(cos(0.7854 * float(i)), sin(0.7854 * float(i)))));
        if (texelFetch(organs, inside(at + step), 0).rgb == marks[k]) {
          color = vec4(markColors[k], 1.0);
        }
      }
    }
  }
  result = color;
}`;

/** A texture with a colour for each organ: red in the lowest of three bytes, and kStriped; negative hides it. */
export class OrganColors {
  constructor(count) {
    const rows = Math.max(1, Math.ceil(count / kWidth));
    this.bytes = new Uint8Array(4 * kWidth * rows);
    this.words = new Uint32Array(this.bytes.buffer);
    this.texture = new DataTexture(this.bytes, kWidth, rows, RGBAFormat, UnsignedByteType);
  }

  write(colors) {
    colors.forEach((color, organ) => {
      this.words[organ] = color < 0 ? 0 : ((color & kStriped ? 0x80000000 : 0xff000000) | (color & 0xffffff)) >>> 0;
    });
    this.texture.needsUpdate = true;
  }

  dispose() {
    this.texture.dispose();
  }
}

function organMaterial(defines, uniforms) {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader: kOrganVertex, fragmentShader: kOrganFragment,
    defines, uniforms, side: DoubleSide, blending: NoBlending,
  });
}

/** The number of an organ as the texture of numbers has it. */
function numberColor(organ) {
  const number = organ + 1;
  return new Vector3(number & 255, (number >> 8) & 255, (number >> 16) & 255).divideScalar(255);
}

export class Passes {
  constructor(renderer) {
    this.renderer = renderer;
    this.uniforms = {
      cut: { value: new Vector4(0, 0, 0, 1) }, palette: { value: null }, angle: { value: 0 }, stripes: { value: 0 }, veil: { value: new Vector4() },
    };
    this.full = organMaterial({}, this.uniforms);
    this.quick = organMaterial({ QUICK: "" }, this.uniforms);
    this.copies = organMaterial({ QUICK: "", COPY: "" }, this.uniforms);
    this.target = new WebGLRenderTarget(1, 1, {
      count: 2, minFilter: NearestFilter, magFilter: NearestFilter, depthTexture: new DepthTexture(1, 1, UnsignedIntType),
    });
    const [colors, organs] = this.target.textures;
    const vectors = () => Array.from({ length: kMaxMarks }, () => new Vector3());
    this.edges = {
      colors: { value: colors }, organs: { value: organs }, depths: { value: this.target.depthTexture },
      last: { value: new Vector2() }, clip: { value: new Vector2() }, shading: { value: 0 }, reach: { value: 17 },
      pixel: { value: 0 }, ink: { value: new Vector3() }, markCount: { value: 0 }, markWidth: { value: 2 },
      marks: { value: vectors() }, markColors: { value: vectors() },
    };
    this.screen = new Scene();
    const triangle = new BufferGeometry();
    triangle.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.screen.add(new Mesh(triangle, new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kScreenVertex, fragmentShader: kEdgeFragment, uniforms: this.edges,
      depthTest: false, depthWrite: false, transparent: true, blending: CustomBlending, blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
    })));
    this.screen.children[0].frustumCulled = false;
    this.flat = new OrthographicCamera();
  }

  /** @param width, height  device pixels */
  setSize(width, height) {
    this.target.setSize(width, height);
    this.edges.last.value.set(width - 1, height - 1);
  }

  /** Whether triangles are cut. */
  setCut(isCut) {
    for (const material of [this.full, this.quick, this.copies]) {
      if (isCut !== (material.defines.CUT !== undefined)) {
        material.needsUpdate = true;
        if (isCut) {
          material.defines.CUT = "";
        } else {
          delete material.defines.CUT;
        }
      }
    }
  }

  /** @param marks  up to kMaxMarks pairs [organ, [red, green, blue] from 0 to 1] */
  setMarks(marks) {
    this.edges.markCount.value = marks.length;
    marks.forEach(([organ, color], k) => {
      this.edges.marks.value[k].copy(numberColor(organ));
      this.edges.markColors.value[k].set(...color);
    });
  }

  /** Draws edges, shading and outlines to the screen, from the targets. @param box  scissor, device pixels */
  drawEdges(camera, ratio) {
    const { edges, renderer } = this;
    edges.clip.value.set(camera.near, camera.far);
    edges.reach.value = 17 * ratio;
    edges.markWidth.value = Math.round(2 * ratio);
    edges.pixel.value = (2 * Math.tan((camera.fov * Math.PI) / 360)) / this.target.height;
    renderer.render(this.screen, this.flat);
  }

  /** The organs at pixels of the targets in a square around one, from the lower left; null where there is none. */
  organsAround(x, y, reach) {
    const size = 2 * reach + 1;
    const bytes = new Uint8Array(4 * size * size);
    this.renderer.readRenderTargetPixels(this.target, x - reach, y - reach, size, size, bytes, 0, 1);
    return Array.from({ length: size * size }, (_, i) => bytes[4 * i] + 256 * bytes[4 * i + 1] + 65536 * bytes[4 * i + 2] - 1).map((number) => (number < 0 ? null : number));
  }
}
