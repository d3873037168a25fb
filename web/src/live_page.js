// The page of a run in progress: it follows the newest frame until someone goes back.

import { byId } from "./dom.js";
import { plantLight } from "./energy.js";
import { Follower, LiveRun } from "./live.js";
import { awaiting } from "./loading.js";
import { Timeline } from "./timeline.js";

const root = document.documentElement;
const kShort = 10000; // milliseconds for which the end of a run is shown

function showProgress(words, fraction, isDone) {
  const pill = byId("progress");
  pill.className = "pill";
  pill.hidden = !words;
  pill.textContent = words;
  byId("bar").hidden = fraction < 0;
  byId("bar").style.width = `${100 * Math.max(0, fraction)}%`;
  if (isDone) {
    setTimeout(() => (pill.hidden = true), kShort);
  }
}

/** What a page asks of a run in progress. */
class LiveView {
  constructor(live, follower) {
    Object.assign(this, { live, follower });
  }

  get isFollowing() {
    return this.follower.isFollowing;
  }

  select({ index }) {
    return this.follower.select(index);
  }

  follow() {
    return this.follower.followAgain();
  }

  headOf({ frame }) {
    return frame ? this.live.heads.get(frame.number) : undefined;
  }

  /** From the news, or else from the loaded frame. */
  lightOf({ frame }, band) {
    return frame?.light?.[band] ?? plantLight(this.live.heads.get(frame?.number), band);
  }

  /** The low and high corner of all frames; null if none has one. */
  get extent() {
    const known = this.live.state.frames.map(({ extent }) => extent).filter((one) => one?.flat().every(Number.isFinite));
    const ends = (end, k) => [0, 1, 2].map((axis) => end(...known.map((extent) => extent[k][axis])));
    return known.length > 0 ? [ends(Math.min, 0), ends(Math.max, 1)] : null;
  }

  /** The values of all frames. A promise. */
  allValues(column) {
    return Promise.all(this.live.state.frames.map(async (frame) => {
      const run = await this.live.frame(frame).catch(() => null);
      return { values: run && (await run.values(0, column)), areas: run?.weights };
    }));
  }

  /** Of frames that are loaded, and of one scene with that organ. */
  async course(entries, column, id) {
    const { frames } = this.live.state;
    return Promise.all(entries.map(async ({ index }) => {
      const run = frames[index] && (await this.live.loaded(frames[index]));
      const organ = run ? run.organOfId(id) : -1;
      const values = organ >= 0 ? await run.values(0, column) : null;
      return values && { mean: values.mean[organ], error: values.error[organ], low: values.low[organ], high: values.high[organ] };
    }));
  }
}

/** Follows a run in progress. */
export async function followRun(openGraphics, buildPage) {
  const opening = LiveRun.open();
  const graphics = openGraphics();
  const live = await opening;
  let page = null;
  let shown = "";
  const show = async (run, at, frames) => {
    const news = JSON.stringify([frames, at, follower.isFollowing]);
    if (run === null && news === shown) {
      return; // nothing is drawn where nothing has changed
    }
    shown = news;
    const timeline = Timeline.ofFrames(frames, (run ?? page.run).json.coming);
    const key = timeline.steps.find(({ index }) => index === at)?.key ?? "";
    if (page === null) {
      page = await buildPage(run, timeline, graphics, new LiveView(live, follower));
      root.dataset.state = "ready";
    }
    await page.replace(run ?? page.run, timeline, key);
    root.dataset.frame = frames[at]?.number ?? "";
  };
  const follower = new Follower(live, show, showProgress);
  root.dataset.state = "waiting";
  awaiting("The scene is being prepared, and its first light is being computed…");
  showProgress("Waiting for the first light", -1);
  await follower.follow();
  root.dataset.ended = "yes";
}
