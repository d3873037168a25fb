// A run in progress: its states so far, from the server.

import { RunData, readJson, request } from "./data.js";
import { shapeOf } from "./sensors.js";

const kBetween = 400; // milliseconds between requests for news
const kHidden = 3000; // milliseconds while the page is hidden

export function isLive() {
  return document.getElementById("live") !== null;
}

const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

/** The numbers of a frame; null after the program has ended. */
async function valuesOrNothing(name) {
  try {
    return await (await request(name)).arrayBuffer();
  } catch {
    return null;
  }
}

export class LiveRun {
  static async open() {
    const live = new LiveRun();
    live.colorMaps = await readJson("colors");
    live.scenes = new Map(); // promises, by number
    live.frames = new Map(); // promises, by number and version
    live.heads = new Map(); // of loaded frames, by number
    await live.poll();
    return live;
  }

  /** Requests news. Rejects if the program has ended. */
  async poll() {
    this.state = await (await request("live")).json();
    const known = new Set(this.state.frames.map(({ number, version }) => `${number}-${version}`));
    const scenes = new Set(this.state.frames.map((frame) => frame.scene));
    const forget = (map, kept) => [...map.keys()].filter((key) => !kept.has(key)).forEach((key) => map.delete(key));
    forget(this.frames, known);
    forget(this.scenes, scenes);
  }

  #scene(number) {
    if (!this.scenes.has(number)) {
      this.scenes.set(number, Promise.all([
        readJson(`scene-${number}`), request(`shape-${number}`).then((answer) => answer.arrayBuffer()),
      ]).then(([json, bytes]) => ({ json, triangles: shapeOf(bytes, json) })));
    }
    return this.scenes.get(number);
  }

  /** A state of the run, in the form of a finished run. */
  frame({ number, version, scene }) {
    const key = `${number}-${version}`;
    if (!this.frames.has(key)) {
      this.frames.set(key, Promise.all([this.#scene(scene), readJson(`light-${key}`)]).then(([shape, light]) => {
        const { label, suns, lamps, sky, values } = light;
        this.heads.set(number, light.head);
        const json = {
          ...shape.json,
          head: { ...shape.json.head, ...light.head },
          times: [{ part: "", index: 0, label, suns, lamps, sky, values }],
        };
        return new RunData(json, this.colorMaps, shape.triangles,
          (column) => valuesOrNothing(`values-${key}-${column}`));
      }));
    }
    return this.frames.get(key);
  }

  /** A frame if it is loaded, or being loaded; else null. */
  loaded({ number, version }) {
    return this.frames.get(`${number}-${version}`)?.catch(() => null) ?? null;
  }
}

/** The newest frame with light: the night is not worth watching. */
function newestLit(frames) {
  const isDark = ({ light }) => light && Object.values(light).every((mean) => mean === 0);
  return [...frames].reverse().find((frame) => !isDark(frame)) ?? frames.at(-1);
}

/**
 * Shows the newest frames of a run, until the user selects an older one.
 * @param show  (run, index, entries) => promise
 * @param report  (words, fraction) => shows the progress of the run
 */
export class Follower {
  constructor(live, show, report) {
    Object.assign(this, { live, show, report, isFollowing: true, shown: null, turn: Promise.resolve() });
  }

  /** Returns when the run or the program has ended. */
  async follow() {
    for (;;) {
      const { words, fraction, ended } = this.live.state;
      await this.#showNews();
      this.report(ended || words, ended ? -1 : fraction, Boolean(ended));
      if (ended) {
        return;
      }
      await wait(document.hidden ? kHidden : kBetween);
      try {
        await this.live.poll();
      } catch {
        this.report("The program has ended. This page keeps what it has loaded.", -1);
        return;
      }
    }
  }

  /** Goes to one of the frames; at the newest, follows again. */
  async select(index) {
    const { frames } = this.live.state;
    this.isFollowing = index >= frames.length - 1;
    this.asked = index;
    await this.#inTurn(() => (this.asked === index ? frames[index] : null)); // the slider may have moved on
  }

  /** Follows again. */
  followAgain() {
    this.isFollowing = true;
    return this.#showNews();
  }

  async #showNews() {
    await this.#inTurn(() => {
      const { frames } = this.live.state;
      const own = frames.find((frame) => frame.number === this.shown?.number);
      return this.isFollowing ? newestLit(frames) : own ?? this.shown;
    });
  }

  /** Shows frames one after the other, so that `shown` is never a frame that is still loading. */
  #inTurn(choose) {
    const shown = this.turn.then(() => this.#showFrame(choose()));
    this.turn = shown.catch(() => {});
    return shown;
  }

  async #showFrame(frame) {
    if (!frame) {
      return;
    }
    const { frames } = this.live.state;
    const isNew = frame.number !== this.shown?.number || frame.version !== this.shown?.version;
    const run = isNew ? await this.live.frame(frame).catch(() => null) : null;
    if (isNew && run === null) {
      return; // the program has ended; the next request reports it
    }
    this.shown = frame;
    await this.show(run, Math.max(0, frames.findIndex(({ number }) => number === frame.number)), frames);
  }
}
