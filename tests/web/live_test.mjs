// The page of a run that goes on, in a real browser:
// node live_test.mjs QUASIMC ENVIRONMENT CHROMIUM PACKAGES [PICTURES]
//
// Rationale: a page that was opened while a plant grows must show every step with the numbers that the
// plant was told, let one go back, and say when the plant has ended; and follow a run to its result.
// Expected behaviour: the newest step by itself, older ones by the slider, no word on the console.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { pixelsOf } from "./pixels.mjs";

const [quasimc, environment, executablePath, packages, pictures] = process.argv.slice(2);
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "quasimc-live-"));
const inFolder = (name) => path.join(folder, name);
const kLastSteps = 5;

const kCommFile = `communication type: pipes
turtle position: %f %f %f
turtle heading: %f %f %f
turtle left: %f %f %f
turtle up: %f %f %f
following module: yes
`;

/** A pile of leaves, larger and more of them in each step; the lowest is organ 1. */
function leaves(step) {
  let text = "";
  for (let i = 0; i < step + 1; ++i) {
    text += `${i} E(0)P(${0.1 + 0.02 * step},0.4)\n ${0.05 * i} ${i} 0\n 0 0 1\n 1 0 0\n 0 1 0\n`;
  }
  return `${text}Control: 5 ${step}\n`;
}

/** The light program and the plant's end of its line. */
class Growth {
  constructor() {
    writeFileSync(inFolder("comm.e"), kCommFile);
    writeFileSync(inFolder("light.qmc"), "return type: D\nnumber of rays: 4096\nnumber of runs: 4\nverbose: 0\nview: yes\n");
    this.process = spawn(environment, ["-e", "comm.e", "light.qmc"], { cwd: folder, stdio: ["pipe", "pipe", "pipe"] });
    this.said = "";
    this.told = "";
    this.process.stdout.on("data", (bytes) => (this.said += bytes));
    this.process.stderr.on("data", (bytes) => (this.told += bytes));
    this.ended = new Promise((done) => this.process.once("exit", done));
  }

  async until(isThere) {
    for (let i = 0; i < 1200; ++i) {
      const found = isThere();
      if (found) {
        return found;
      }
      await new Promise((done) => setTimeout(done, 50));
    }
    throw new Error(`nothing came; it said:\n${this.said}\n${this.told}`);
  }

  address() {
    return this.until(() => /view: (http:\S+\/)\n/.exec(this.told)?.[1]);
  }

  /** The light on every leaf of a step. */
  async grow(step) {
    this.said = "";
    this.process.stdin.write(leaves(step));
    const text = await this.until(() => (/Control: 5/.test(this.said) ? this.said : null));
    return [...text.matchAll(/E\(([^,)]*)/g)].map((match) => Number(match[1]));
  }

  end() {
    this.process.stdin.write("Control: 8 0\n");
    return this.ended;
  }
}

/** Fails on anything that the page says. */
async function open(context, address) {
  const page = await context.newPage();
  const faults = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) &&
    !/GPU stall due to ReadPixels|software WebGL/.test(message.text()) && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(address);
  return { page, faults };
}

const frameIs = (page, number) => page.waitForSelector(`html[data-frame="${number}"]`);
/** The number of an organ that is found by its id, on its card. */
async function lightOf(page, id) {
  await page.locator("#find").fill(String(id));
  await page.keyboard.press("Enter");
  await page.waitForFunction((own) => document.querySelector("#cards .about")?.textContent.startsWith(`id ${own} `), id);
  const text = await page.locator("#cards .card p.number").first().textContent();
  await page.locator("#cards").getByRole("button", { name: "Unpin all" }).click();
  return Number(/^(below )?(−?[\d.,]+)/.exec(text)[2].replace(",", ""));
}

async function checkStep(page, step, light) {
  await page.waitForFunction((own) => document.querySelector("#legend-note").textContent.endsWith(`step ${own}`), step);
  assert.match(await page.locator("#subtitle").textContent(), new RegExp(`^${step + 1} organs`));
  const shown = await lightOf(page, step + 1);
  assert.ok(Math.abs(shown - light[step]) <= 5e-3 * light[step], `step ${step}: ${shown}, told: ${light[step]}`);
}

/** The rows from the highest leaf to the lowest one, once the picture is at rest. */
async function seenRows(page) {
  await page.waitForTimeout(600);
  const { width, height, data } = await pixelsOf(page, await page.locator("#canvas").screenshot());
  const isGreen = (at) => data[at + 1] - data[at + 2] > 30;
  const isSeen = (row) => Array.from({ length: width / 4 }, (_, i) => 4 * (row * width + 0.75 * width + i)).filter(isGreen).length > 2; // the plant without light
  const rows = Array.from({ length: height }, (_, row) => row).filter(isSeen);
  return rows.at(-1) - rows[0];
}

/** Goes to the frame at an index of the strip, by keys. */
async function goTo(page, index) {
  await page.locator("#strip").focus();
  await page.keyboard.press("Home");
  for (let i = 0; i < index; ++i) {
    await page.waitForFunction((at) => document.querySelector("#strip").getAttribute("aria-valuenow") === String(at), i);
    await page.keyboard.press("ArrowRight");
  }
}

async function checkGrowth(context) {
  const growth = new Growth();
  try {
    const address = await growth.address();
    const lights = [null, await growth.grow(1)];
    const { page, faults } = await open(context, address);
    await page.waitForSelector("html[data-state=ready]");
    await frameIs(page, 1);
    for (let step = 2; step <= kLastSteps; ++step) {
      lights.push(await growth.grow(step));
      await frameIs(page, step);
      await checkStep(page, step, lights[step]);
    }
    // A plant has no unit of length.
    assert.match(await page.locator("#profile .hit").first().getAttribute("aria-label"), /^height [\d.]+ to [\d.]+: mean [\d.]+\u00a0of full light \(error not known\), 1 organ, [\d.]+$/);
    if (pictures) {
      await page.screenshot({ path: path.join(pictures, "growth.png") });
    }
    // All steps are seen from one point of view and on one scale, and their course is known.
    const scaleEnd = () => page.locator("#legend-scale .tick.last").textContent();
    const [grown, end] = [await seenRows(page), await scaleEnd()];
    assert.equal((await page.locator("#course .mean").getAttribute("points")).split(" ").length, kLastSteps);
    // Back to a step, and what comes does not take it away.
    await goTo(page, 1);
    await frameIs(page, 2);
    await checkStep(page, 2, lights[2]);
    const young = await seenRows(page);
    assert.ok(young > 10 && young < 0.8 * grown, `a young plant takes ${young} rows, a grown one ${grown}`);
    assert.equal(await scaleEnd(), end, "steps have one scale");
    lights.push(await growth.grow(kLastSteps + 1));
    await page.waitForFunction((last) => document.querySelector("#strip").getAttribute("aria-valuemax") === String(last), kLastSteps);
    await checkStep(page, 2, lights[2]);
    await page.getByRole("button", { name: "Follow" }).click();
    await frameIs(page, kLastSteps + 1);
    await checkStep(page, kLastSteps + 1, lights[kLastSteps + 1]); // it is read by now
    assert.deepEqual(faults, []);
    const start = Date.now();
    assert.equal(await growth.end(), 0);
    assert.ok(Date.now() - start < 2000, "no page keeps the program");
    await page.waitForSelector("html[data-ended]");
    assert.match(await page.locator("#progress").textContent(), /has ended/);
    await checkStep(page, kLastSteps + 1, lights[kLastSteps + 1]);
    // What had not been read by then can't be had; the page says so.
    await goTo(page, 0);
    await frameIs(page, 1);
    await page.selectOption("#quantity", { index: 3 });
    await page.waitForFunction(() => /ended before this page/.test(document.querySelector("#histogram").textContent));
    await page.close();
  } finally {
    growth.process.kill("SIGKILL");
  }
}

/** A plant from a model shows all its shapes: leaves with the light that they query, and stems without a value. */
async function checkDrawn(context) {
  const grow = spawn(quasimc, ["grow", "tree.l", "--steps", "4", "--view"], { cwd: fileURLToPath(new URL("../../examples/07-grow", import.meta.url)), stdio: ["ignore", "ignore", "pipe"] });
  try {
    let heard = "";
    grow.stderr.on("data", (bytes) => (heard += bytes));
    while (!/view: http:\S+\/\n/.test(heard)) {
      await new Promise((done) => setTimeout(done, 50));
    }
    const { page, faults } = await open(context, `${/http:\S+/.exec(heard)[0]}#tab=table`);
    await page.waitForSelector("html[data-ended]");
    assert.equal(await page.locator("#title").textContent(), "tree.l");
    await page.waitForSelector("#table tbody tr");
    const rows = await page.locator("#table tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    const column = await page.locator("#table th").evaluateAll((all) => all.findIndex((cell) => cell.textContent.startsWith("Absorbed per area")));
    const hasLight = ([organ, ...others]) => ({ isStem: /I \d/.test(organ), value: others[column - 1] });
    const [stems, leaves] = [true, false].map((isStem) => rows.map(hasLight).filter((row) => row.isStem === isStem));
    assert.ok(stems.length >= 4 && stems.every(({ value }) => value === "–"), JSON.stringify(stems));
    assert.ok(leaves.filter(({ value }) => Number.parseFloat(value) > 0).length >= 4, JSON.stringify(leaves));
    assert.deepEqual(faults, []);
    await page.close();
  } finally {
    grow.kill("SIGKILL");
  }
}

/** A run that takes some seconds: the page follows its replicates, and ends with its result. */
async function checkRun(context) {
  writeFileSync(inFolder("run.toml"), `
[[band]]
name = "PAR"
[run]
method = "light_tracing"
paths = 8388608
replicates = 16
threads = 1
[output]
json = "run.json"
[[source]]
type = "sky"
name = "sky"
model = "uniform"
irradiance_horizontal = 1
[[material]]
name = "leaf"
reflectance = 0.4
transmittance = 0.4
[[organ]]
name = "leaf"
material = "leaf"
shape = "triangle"
corners = [[-0.5, -0.5, 1], [0.5, -0.5, 1], [0, 0.6, 1]]
[[organ]]
name = "lower"
material = "leaf"
shape = "triangle"
corners = [[-1, -1, 0.5], [1, -1, 0.5], [0, 1.2, 0.5]]
`);
  const run = spawn(quasimc, ["run", "run.toml", "--view"], { cwd: folder, stdio: ["ignore", "ignore", "pipe"] });
  let told = "";
  run.stderr.on("data", (bytes) => (told += bytes));
  const ended = new Promise((done) => run.once("exit", done));
  try {
    while (!/view: http:\S+\/\n/.test(told)) {
      assert.equal(run.exitCode, null, told);
      await new Promise((done) => setTimeout(done, 20));
    }
    const { page, faults } = await open(context, /view: (http:\S+\/)\n/.exec(told)[1]);
    await page.waitForSelector("html[data-state=ready]");
    const replicates = async () =>
      Number(/× (\d+) replicates/.exec(await page.locator("#report").textContent())[1]);
    const early = await replicates();
    await page.waitForSelector("html[data-ended]");
    const result = JSON.parse(readFileSync(inFolder("run.json")));
    assert.ok(early >= 2 && early < 16, `seen with ${early} of 16 replicates`);
    assert.equal(await replicates(), 16);
    assert.match(await page.locator("#progress").textContent(), /The run has finished/);
    const shown = await lightOf(page, 2);
    const { mean } = result.organs[1].absorbed_flux_density.PAR;
    assert.ok(Math.abs(shown - mean) <= 2e-3 * mean, `${shown}: ${mean}`);
    if (pictures) {
      await page.screenshot({ path: path.join(pictures, "run.png") });
    }
    assert.deepEqual(faults, []);
    run.kill("SIGINT");
    assert.equal(await ended, 0);
  } finally {
    run.kill("SIGKILL");
  }
}

const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  context.setDefaultTimeout(100000); // of a machine that has much else to do
  await checkGrowth(context);
  await checkDrawn(context);
  await checkRun(context);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
