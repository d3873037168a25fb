// examples/03-coupled in a real browser: node example_test.mjs ENVIRONMENT FOLDER CHROMIUM PACKAGES [PICTURES]
//
// Rationale: what the manual tells people to start must start, and show the plant that grows.
// Expected behaviour: watch.sh prints an address; the page there follows to the last step, with as
// many organs as the plant says it has leaves, the plant and its light side by side in one outline, and
// goes back to an earlier one; Enter ends it.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { pixelsOf } from "./pixels.mjs";

const [environment, example, executablePath, packages, pictures] = process.argv.slice(2);
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "quasimc-example-"));
const kSteps = 4;

/** Resolves with what `find` finds in what a process says. */
function until(child, said, find) {
  return new Promise((done, fail) => {
    const look = () => {
      const found = find(said());
      if (found) {
        done(found);
      }
    };
    child.stdout.on("data", look);
    child.stderr.on("data", look);
    child.once("exit", (code) => fail(new Error(`it ended with ${code}, having said:\n${said()}`)));
    look();
  });
}

// Covered by half or more, on the side of the light or on that of the plant, whose green is less saturated than colours of
// light; or covered in part, as at an edge. The ground and the frame are nearly grey.
const kHalf = [45, 25];
const kSome = 6;
const saturation = (color) => Math.max(...color.slice(0, 3)) - Math.min(...color.slice(0, 3));
const isCovered = (side) => (...color) => saturation(color) > kHalf[side];
// Leaves of the plant are of one green, darker where they are seen edge-on; of light none has that.
const isPlantGreen = (red, green, blue) => Math.abs(red / green - 150 / 190) < 0.03 && Math.abs(blue / green - 110 / 190) < 0.03;

/** The picture once it stays the same: while the scene changes, a part of it is drawn. */
async function canvasPixels(page) {
  const shot = async () => {
    await page.waitForTimeout(300);
    await page.waitForSelector("#canvas[data-rest=yes]");
    return page.locator("#canvas").screenshot();
  };
  let [before, now] = [await shot(), await shot()];
  while (!before.equals(now)) {
    [before, now] = [now, await shot()];
  }
  const pixels = await pixelsOf(page, now);
  return { ...pixels, half: await page.evaluate(() => Math.floor(document.querySelector("#canvas").clientWidth / 2)) };
}

/** Of the pixels covered in one half of the canvas or the other the part that is covered in both, if only in part; and how many are green on each side. */
function compareHalves({ width, height, half, data }) {
  let [both, any] = [0, 0];
  const green = [0, 0];
  for (let y = 0; y < height - 30; ++y) { // without the words below
    for (let x = 0; x < half; ++x) {
      const colors = [x, x + half].map((place) => [...data.subarray(4 * (y * width + place), 4 * (y * width + place) + 3)]);
      const [left, right] = colors.map((color, side) => isCovered(side)(...color));
      both += (left || right) && colors.every((color) => saturation(color) > kSome) ? 1 : 0;
      any += left || right ? 1 : 0;
      colors.forEach((color, side) => (green[side] += isCovered(side)(...color) && isPlantGreen(...color) ? 1 : 0));
    }
  }
  return { agreement: both / any, any, green };
}

/** The plant stands beside its light: the same outline and organs, other colours; and goes when it is told to. */
async function checkSides(page) {
  await page.locator("#directions").uncheck();
  await page.evaluate(() => (document.querySelector("#legend").style.visibility = "hidden"));
  if (pictures) { await page.locator("#canvas").screenshot({ path: path.join(pictures, "sides.png") }); }
  const sides = compareHalves(await canvasPixels(page));
  assert.ok(sides.any > 2000 && sides.agreement > 0.97, JSON.stringify(sides));
  assert.ok(sides.green[1] > 0.8 * sides.any /* edges have another colour */ && sides.green[0] < 0.1 * sides.any, JSON.stringify(sides));
  const box = await page.locator("#canvas").boundingBox();
  const { width, half, data } = await canvasPixels(page);
  const at = Array.from({ length: data.length / 4 }, (_, i) => i).find((i) => i % width > 5 && i % width < half - 5 &&
    [i - 3, i, i + 3, i - 3 * width, i + 3 * width].every((j) => isCovered(0)(...data.subarray(4 * j, 4 * j + 3))));
  const tipAt = async (shift) => {
    await page.mouse.move(2, 2);
    await page.waitForSelector("#tip", { state: "hidden" });
    await page.mouse.move(box.x + (at % width) + shift, box.y + Math.floor(at / width));
    await page.waitForSelector("#tip:not([hidden])");
    return page.locator("#tip").textContent();
  };
  assert.equal(await tipAt(half), await tipAt(0), "another organ in the plant than in its light");
  await page.mouse.move(2, 2);
  await page.locator("#beside").uncheck();
  assert.ok(compareHalves(await canvasPixels(page)).agreement < 0.5, "the plant does not go");
  await page.locator("#beside").check();
}

async function check(browser, child, said) {
  const address = await until(child, said, (text) => /view: (http:\S+\/)\n/.exec(text)?.[1]);
  await until(child, said, (text) => text.includes("press Enter"));
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(address);
  child.stdin.write("\n");
  await page.waitForSelector("html[data-state=ready]");
  await until(child, said, (text) => text.includes("All steps are computed"));
  await page.waitForSelector(`html[data-frame="${kSteps}"]`);
  const leaves = [...said().matchAll(/^step +\d+: .* (\d+) leaves/gm)].map((match) => Number(match[1]));
  assert.equal(leaves.length, kSteps);
  const checkFrame = async (frame) => {
    await page.waitForSelector(`html[data-frame="${frame}"]`);
    assert.match(await page.locator("#subtitle").textContent(), new RegExp(`^${leaves[frame - 1]} organs? `));
  };
  await checkFrame(kSteps);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "example.png") });
  }
  await checkSides(page);
  await page.locator("#strip").focus();
  await page.keyboard.press("Home");
  await checkFrame(1);
  await page.keyboard.press("ArrowRight");
  await checkFrame(2);
  const followed = compareHalves(await canvasPixels(page));
  assert.ok(followed.agreement > 0.97, `the plant does not follow: ${JSON.stringify(followed)}`);
  assert.deepEqual(faults, []);
  child.removeAllListeners("exit");
  child.stdin.end("\n");
  await page.waitForSelector("html[data-ended]");
}

cpSync(example, folder, { recursive: true });
const child = spawn(path.join(folder, "watch.sh"), ["--steps", String(kSteps), "--program", environment],
  { stdio: ["pipe", "pipe", "pipe"] });
let text = "";
const status = new Promise((done) => child.once("close", done));
child.stdout.on("data", (bytes) => (text += bytes));
child.stderr.on("data", (bytes) => (text += bytes));
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  await check(browser, child, () => text);
  assert.equal(await status, 0, text);
} finally {
  await browser.close();
  child.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}
