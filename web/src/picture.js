// Pictures of the scene: in which passes they are drawn, with how many pixels, in one view or two.

import { Passes } from "./passes.js";

/** The part of the width and height that a CPU renders while the scene moves; the browser enlarges it. */
const kCoarse = 0.5;

/** Pixels of the picture at rest to one of CSS, so that leaves thinner than a pixel do not break into dots. */
const kFine = 2;

/** From one stripe of unknown organs to the next, along the axes, pixels of CSS. */
const kStripes = 7;

/** Side by side: the light, and the plant in its own colours. */
const kLight = { angle: 0.06 };
const kPlant = { angle: 0.3 };

export class ScenePicture {
  /** @param window  the SceneWindow */
  constructor(window) {
    const { renderer } = window;
    Object.assign(this, { window, renderer, canvas: renderer.domElement });
    this.passes = new Passes(renderer);
    this.ratio = renderer.getPixelRatio(); // of pixels at rest to those of CSS
    this.fine = Math.max(1, kFine / this.ratio);
    this.detail = 1; // of the last picture, to the ratio
    this.shading = 0;
    this.isOld = true; // whether the targets of the passes are older than the scene
  }

  /** Uploads triangles and shaders, which the GPU prepares in the background. */
  handOver() {
    const { geometry } = this.window.organs;
    geometry.setDrawRange(0, 3);
    this.#drawOrgans(this.passes.full, this.passes.target);
    geometry.setDrawRange(0, Infinity);
  }

  /** Pixels of the last picture to one of CSS. */
  get pixels() {
    return this.ratio * this.detail;
  }

  /** The width of a view, CSS pixels. */
  get viewWidth() {
    return Math.floor(this.canvas.clientWidth / (this.window.plant ? 2 : 1));
  }

  get isFine() {
    return this.detail >= this.fine;
  }

  /** @param share  the part of the triangles  @param isQuick  whether it will not last  @param isFine  whether there is time for all details */
  draw(share, isQuick, isFine) {
    const { renderer, passes, window } = this;
    this.#setDetail(isQuick ? kCoarse : isFine ? this.fine : 1);
    renderer.setRenderTarget(null);
    renderer.clear();
    window.orbit.setRange();
    this.#drawBackdrop();
    window.organs.drawFraction(share);
    if (isQuick) {
      renderer.clearDepth();
      this.#drawOrgans(passes.quick, null);
    } else {
      this.#drawNeighbours(share);
      this.#drawOrgans(passes.full, passes.target);
      this.isOld = share < 1;
      passes.edges.shading.value = this.shading;
      renderer.setViewport(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
      passes.drawEdges(window.camera, this.pixels);
    }
  }

  /** Sets the number of pixels to be drawn, which clears them. */
  #setDetail(detail) {
    const { renderer, passes, canvas } = this;
    this.detail = detail;
    if (renderer.getPixelRatio() !== this.pixels) {
      renderer.setPixelRatio(this.pixels);
    }
    passes.uniforms.stripes.value = kStripes * this.pixels;
    passes.setSize(Math.floor(canvas.clientWidth * this.pixels), Math.floor(canvas.clientHeight * this.pixels));
  }

  #drawBackdrop() {
    const { backdrop, camera } = this.window;
    if (backdrop) {
      this.#eachView((viewport) => {
        this.renderer.setViewport(...viewport);
        this.renderer.render(backdrop, camera);
      });
    }
  }

  /** Draws the neighbours behind the cell, so that none of them hides it. */
  #drawNeighbours(share) {
    const { renderer, window: { neighbours, orbit, camera } } = this;
    if (neighbours) {
      orbit.setRange(neighbours.reach);
      renderer.clearDepth();
      neighbours.drawFraction(share);
      this.#eachView((viewport) => {
        renderer.setViewport(...viewport);
        renderer.render(neighbours.scene, camera);
      });
      orbit.setRange();
    }
  }

  /** Draws organs in all views. @param target  render target; null: the screen */
  #drawOrgans(material, target) {
    const { renderer, window } = this;
    const ratio = target ? this.pixels : 1;
    window.mesh.material = material;
    renderer.setRenderTarget(target);
    if (target) {
      target.viewport.set(0, 0, target.width, target.height);
      renderer.setRenderTarget(target);
      renderer.clear();
    }
    this.#eachView((viewport) => {
      const scaled = viewport.map((x) => Math.floor(x * ratio));
      if (target) {
        target.viewport.set(...scaled);
        renderer.setRenderTarget(target);
      } else {
        renderer.setViewport(...scaled);
      }
      renderer.render(window.scene, window.camera);
    });
    renderer.setRenderTarget(null);
  }

  /** Calls with the viewport of each of the views side by side, of which the organs have the colours. */
  #eachView(act) {
    const { window: { light, plant }, viewWidth: width, passes: { uniforms } } = this;
    [{ colors: light, ...kLight }, ...(plant ? [{ colors: plant, ...kPlant }] : [])].forEach(({ colors, angle }, i) => {
      uniforms.palette.value = colors.texture;
      uniforms.angle.value = angle;
      act([i * width, 0, width, this.canvas.clientHeight]);
    });
  }

  /** A copy of a picture as a canvas, without finer details. @param scale  pixels of it per pixel of the screen  @param draw  draws it */
  copy(scale, draw) {
    const { ratio, fine } = this;
    const copy = document.createElement("canvas");
    Object.assign(this, { ratio: ratio * scale, fine: 1 });
    draw();
    [copy.width, copy.height] = [this.canvas.width, this.canvas.height];
    copy.getContext("2d").drawImage(this.canvas, 0, 0);
    Object.assign(this, { ratio, fine });
    return copy;
  }

  /** The organs in a square around a point of the canvas, CSS pixels, null where there is none. */
  organsAround(x, y, reach) {
    const { pixels, passes, window } = this;
    if (this.isOld) {
      window.organs.drawFraction(1);
      window.orbit.setRange();
      this.#drawOrgans(passes.full, passes.target);
      this.isOld = false;
    }
    return passes.organsAround(Math.floor(x * pixels), passes.target.height - 1 - Math.floor(y * pixels), Math.floor(reach * pixels));
  }
}
