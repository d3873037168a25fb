// How much is drawn while one turns the scene, so that it follows the hand.

const kWanted = 33; // milliseconds a frame
const kLeast = 40000; // triangles, where there are more
const kRest = 250; // milliseconds without a movement, after which all are drawn
const kPoll = 3; // milliseconds between questions whether a frame is done

/**
 * The share of triangles to draw: all of them at rest, and while one turns as many as graphics can
 * draw 30 times a second, by the time that frames before took. A frame is begun when the last one is
 * done, so that they do not queue up.
 */
export class FrameBudget {
  /** @param gl  the graphics  @param onRest  called when all are to be drawn again */
  constructor(gl, onRest) {
    Object.assign(this, { gl, onRest, triangles: 0, moving: 0, isMoving: false, waiting: null, fence: null });
  }

  /** Of the scene that is drawn from now on. The first frames are thin: nothing is known of the graphics yet. */
  setTriangles(count) {
    this.triangles = count;
    this.moving = Math.min(1, Math.max(this.moving, kLeast / count));
  }

  get share() {
    return this.isMoving ? this.moving : 1;
  }

  /** The scene is looked at from elsewhere. */
  moved() {
    this.isMoving = true;
    this.#awaitRest();
  }

  #awaitRest() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.#stop(), kRest);
  }

  /** Calls when the last frame is done. */
  whenReady(act) {
    if (this.fence) {
      this.waiting = act;
    } else {
      act();
    }
  }

  /** A frame has been asked of the graphics. */
  drawn() {
    const { gl } = this;
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    this.started = performance.now();
    this.#wait();
  }

  #wait() {
    setTimeout(() => {
      const { gl, fence } = this;
      if (!gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) {
        this.#wait();
        return;
      }
      gl.deleteSync(fence);
      this.fence = null;
      this.#learn(performance.now() - this.started);
      if (this.isMoving) {
        this.#awaitRest();
      }
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
    if (this.fence) {
      return; // a frame takes longer than the hand rests
    }
    const wasLess = this.share < 1;
    this.isMoving = false;
    if (wasLess) {
      this.onRest();
    }
  }
}
