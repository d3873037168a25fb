// Time until the page shows a result, and frames per second while the scene turns:
// node page_speed.mjs QUASIMC CHROMIUM PACKAGES RESULT.json [TIMES]
//
// The browser renders on the processor (SwiftShader). The page is loaded twice: in a new browser, which
// must start its graphics, and in a running one. Prints wall-clock time, and processor time of all of the
// browser's processes; with TIMES above 1, medians.

import { spawn } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [quasimc, executablePath, packages, result, times = "1"] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(packages, "package.json"))("playwright-core");
const kSeconds = 4; // of turning
const kTicks = 100; // of processor time per second, on Linux

/** Processor time of this process's descendants but those of `others`, seconds. */
function browserTime(others) {
  const parents = new Map();
  const ticks = new Map();
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name)).map(Number)) {
    try {
      const fields = readFileSync(`/proc/${id}/stat`, "utf8").split(") ").at(-1).split(" ");
      parents.set(id, Number(fields[1]));
      ticks.set(id, Number(fields[11]) + Number(fields[12]));
    } catch {
      // it has ended
    }
  }
  const isOurs = (id) => id === process.pid || (parents.has(id) && !others.includes(id) && isOurs(parents.get(id)));
  let sum = 0;
  for (const [id, count] of ticks) {
    sum += id !== process.pid && isOurs(id) ? count : 0;
  }
  return sum / kTicks;
}

/** Resolves once a frame has been drawn, to the last pixel. */
const kDrawn = () => new Promise((done) => {
  const seen = () => {
    const canvas = document.querySelector("#canvas");
    const gl = canvas.getContext("webgl2");
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    done(performance.now());
  };
  requestAnimationFrame(() => requestAnimationFrame(seen));
});

/** Keeps how many corners the last draw of the scene had; letters and lines are other draws. */
const kWatch = () => {
  const own = WebGL2RenderingContext.prototype.drawElements;
  WebGL2RenderingContext.prototype.drawElements = function (mode, count, ...rest) {
    globalThis.drawn = count > 1000 ? count : globalThis.drawn;
    own.call(this, mode, count, ...rest);
  };
};

/** Whether the last frame has all triangles of the scene, according to the page's subtitle. */
const kIsWhole = () =>
  globalThis.drawn === 3 * Number(/(\d+) triangles/.exec(document.querySelector("#subtitle").textContent)[1]);

/**
 * Turns the scene by key presses, one per animation frame. @returns frames per second, their number,
 * and the mean percentage of all triangles in them
 */
const kTurn = async (seconds) => {
  const canvas = document.querySelector("#canvas");
  const gl = canvas.getContext("webgl2");
  const drawn = [];
  const own = gl.drawElements.bind(gl);
  gl.drawElements = (mode, count, ...rest) => {
    drawn.push(count);
    own(mode, count, ...rest);
  };
  const start = performance.now();
  while (performance.now() - start < 1000 * seconds) {
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
    await new Promise(requestAnimationFrame);
  }
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  const took = (performance.now() - start) / 1000;
  const scene = drawn.filter((count) => count > 1000); // letters and lines are other draws
  await new Promise((done) => setTimeout(done, 1500));
  const all = Math.max(...drawn);
  return { rate: scene.length / took, count: scene.length,
    percent: (100 * scene.reduce((sum, count) => sum + count, 0)) / (scene.length * all) };
};

async function measure(browser, address, server) {
  const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
  page.on("pageerror", (error) => console.error(String(error)));
  await page.addInitScript(kWatch);
  const idle = browserTime([server]);
  const start = performance.now();
  await page.goto(address);
  await page.waitForSelector("html[data-state=ready]", { state: "attached", timeout: 120000 });
  await page.evaluate(kDrawn);
  const shown = (performance.now() - start) / 1000;
  const shownTime = browserTime([server]) - idle;
  await page.waitForFunction(kIsWhole, undefined, { timeout: 120000 });
  await page.evaluate(kDrawn);
  const whole = (performance.now() - start) / 1000;
  const wholeTime = browserTime([server]) - idle;
  const before = browserTime([server]);
  const { rate, percent, count } = await page.evaluate(kTurn, kSeconds);
  const frameTime = (browserTime([server]) - before) / count;
  await page.close();
  return { shown, shownTime, whole, wholeTime, rate, percent, frameTime };
}

const server = spawn(quasimc, ["view", result], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((done) => server.stdout.once("data", (bytes) => done(String(bytes).trim())));
const rows = { "a browser just started": [], "a browser that runs": [] };
try {
  for (let i = 0; i < Number(times); ++i) {
    const browser = await chromium.launch({
      executablePath,
      args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    });
    try {
      for (const kind of Object.values(rows)) {
        kind.push(await measure(browser, address, server.pid));
      }
    } finally {
      await browser.close();
    }
  }
} finally {
  server.kill("SIGINT");
}
for (const [browser, measured] of Object.entries(rows)) {
  const median = (key, digits) =>
    measured.map((row) => row[key]).sort((a, b) => a - b)[Math.floor(measured.length / 2)].toFixed(digits);
  const seconds = (key) => `${median(key, 2)} s (processor time ${median(`${key}Time`, 2)} s)`;
  console.log(`${browser}: shown after ${seconds("shown")}, all of it after ${seconds("whole")}, ` +
    `turning ${median("rate", 1)} frames/s of ${median("percent", 0)} % of the triangles ` +
    `(${median("frameTime", 3)} s of processor time a frame)`);
}
