// What draws on the canvas.

import { WebGLRenderer } from "three";

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
