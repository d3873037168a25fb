// How much is drawn while one turns the scene, so that it follows the hand.

const kWanted = 33; // milliseconds a frame
const kLeast = 10000; // triangles, where there are more
const kRest = 250; // milliseconds without a movement, after which all are drawn
const kAhead = 2; // frames that are asked of the graphics at a time
const kPoll = 3; // milliseconds between questions whether a frame is done

/**
 * The share of triangles to draw: all of them at rest, and while one turns as many as graphics can
 * draw 30 times a second, by the time that frames before took. A frame is begun when the last but one
 * is done: they do not queue up, and graphics do not wait for the page.
 */
export class FrameBudget {
  /** @param gl  the graphics  @param onRest  called when all are to be drawn again */
  constructor(gl, onRest) {
    Object.assign(this, { gl, onRest, triangles: 0, moving: 0, isMoving: false, isFirst: true, waiting: null, fences: [], done: 0 });
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

  /** Calls when the last frame but one is done. */
  whenReady(act) {
    if (this.fences.length < kAhead) {
      act();
    } else {
      this.waiting = act;
    }
  }

  /** A frame has been asked of the graphics. */
  drawn() {
    const { gl } = this;
    this.fences.push({ sync: gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0), begun: performance.now() });
    gl.flush();
    if (this.fences.length === 1) {
      this.#wait();
    }
  }

  #wait() {
    setTimeout(() => {
      const { gl } = this;
      const { sync, begun } = this.fences[0];
      if (!gl.isContextLost() && gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
        this.#wait();
        return;
      }
      gl.deleteSync(sync);
      this.fences.shift();
      const now = performance.now();
      this.#learn(now - Math.max(begun, this.done));
      this.done = now;
      if (this.fences.length > 0) {
        this.#wait();
      }
      if (this.isMoving && this.isFirst) {
        this.#stop(); // nobody turns it yet: after the thin frame that is soon seen, all
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
      return; // a frame takes longer than the hand rests
    }
    const wasLess = this.share < 1;
    this.isMoving = false;
    if (wasLess) {
      this.onRest();
    }
  }
}
