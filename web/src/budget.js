// Limits the triangles drawn while the scene is turned, so that it stays responsive.

const kWanted = 33; // milliseconds per frame
const kLeast = 10000; // minimum number of triangles
const kRest = 250; // milliseconds without a movement, after which all are drawn
const kAhead = 2; // maximum number of frames in progress
const kSettled = 3; // whole frames whose time is known: the least counts, as the computer does other work too
const kPoll = 3; // milliseconds between questions whether a frame is done

/**
 * The fraction of triangles to draw: all at rest; while the scene moves as many as the GPU draws 30 times
 * a second, estimated from earlier frames. A frame begins when the last but one is done: frames do not
 * queue up, and the GPU does not wait for the page.
 */
export class FrameBudget {
  /** @param gl  WebGL context  @param onRest  called when the whole picture is to be drawn again */
  constructor(gl, onRest) {
    Object.assign(this, { gl, onRest, triangles: 0, moving: 0, isMoving: false, isFirst: true, waiting: null, fences: [], done: 0, wholes: [] });
  }

  /** Sets the number of triangles. The first frames have few of them, as the speed of the GPU is unknown. */
  setTriangles(count) {
    this.triangles = count;
    this.wholes = [];
    this.moving = Math.min(1, Math.max(this.moving, kLeast / count));
  }

  /** Whether frames in progress are done, and a whole frame of a resolution takes less than a time. @param detail  of width and height */
  affords(detail, milliseconds) {
    return this.fences.length === 0 && Math.min(...this.wholes) * detail ** 2 < milliseconds;
  }

  /** Whether the times of whole frames are known: the first one prepares the shaders. */
  get isSettled() {
    return this.wholes.length >= kSettled;
  }

  get share() {
    return this.isMoving ? this.moving : 1;
  }

  /** To be called when the camera has moved. */
  moved() {
    this.isMoving = true;
    this.#awaitRest();
  }

  #awaitRest() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.#stop(), kRest);
  }

  /** Calls when the last frame but one is done. */
  whenReady(act) {
    if (this.fences.length < kAhead) {
      act();
    } else {
      this.waiting = act;
    }
  }

  /** To be called after a frame was submitted. @param detail  its resolution, of width and height; 0: not a whole frame */
  drawn(detail) {
    const { gl } = this;
    this.fences.push({ sync: gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0), begun: performance.now(), detail });
    gl.flush();
    if (this.fences.length === 1) {
      this.#wait();
    }
  }

  #wait() {
    setTimeout(() => {
      const { gl } = this;
      const { sync, begun, detail } = this.fences[0];
      if (!gl.isContextLost() && gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
        this.#wait();
        return;
      }
      gl.deleteSync(sync);
      this.fences.shift();
      const now = performance.now();
      const took = now - Math.max(begun, this.done);
      this.#learn(took);
      if (detail > 0) {
        this.wholes = [...this.wholes.slice(1 - kSettled), took / detail ** 2];
      }
      this.done = now;
      if (this.fences.length > 0) {
        this.#wait();
      }
      if (this.isMoving && this.isFirst) {
        this.#stop(); // the first frame has few triangles; without movement, all follow at once
      } else if (this.isMoving) {
        this.#awaitRest();
      }
      this.isFirst = false;
      const act = this.waiting;
      this.waiting = null;
      act?.();
    }, kPoll);
  }

  #learn(took) {
    const factor = Math.min(1.25, Math.max(0.1, kWanted / took));
    this.moving = Math.min(1, Math.max(kLeast / this.triangles, this.share * factor));
  }

  #stop() {
    if (this.fences.length > 0) {
      return; // a frame is still in progress
    }
    const wasMoving = this.isMoving;
    this.isMoving = false;
    if (wasMoving) {
      this.onRest();
    }
  }
}
