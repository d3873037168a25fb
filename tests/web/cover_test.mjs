// What the page shows against what a ray-traced picture shows:
// node cover_test.mjs QUASIMC CHROMIUM PACKAGES
//
// Rationale: the page draws triangles by the graphics, `quasimc show` traces rays through the scene:
// two ways to the same outline. Expected behaviour: seen from the same place they cover the same
// pixels, but for half a pixel along edges; from another place they do not (the negative control).

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { pixelsOf } from "./pixels.mjs";

const [quasimc, executablePath, packages] = process.argv.slice(2);
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "quasimc-cover-"));
const run = (...words) => execFileSync(quasimc, words, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
const kHalfOpening = (17.5 * Math.PI) / 180; // of the page's view, upward
const kDistance = 2.6; // of the camera from the middle, in radii of the scene
const kLeast = 0.97; // of pixels that one of the pictures covers, both do

/** Leaves of all sizes and directions: a fixed sequence in place of chance. */
function leaves() {
  let text = "";
  let state = 1;
  const draw = (low, high) => {
    state = (state * 48271) % 2147483647;
    return (low + ((high - low) * state) / 2147483647).toFixed(4);
  };
  for (let i = 0; i < 40; ++i) {
    const middle = [draw(-0.8, 0.8), draw(-0.5, 0.5), draw(0.1, 0.9)].map(Number);
    const corner = () => `[${middle.map((m) => (m + Number(draw(-0.3, 0.3))).toFixed(4)).join(", ")}]`;
    text += `[[organ]]\nmaterial = "leaf"\nshape = "triangle"\ncorners = [${corner()}, ${corner()}, ${corner()}]\n`;
  }
  return text;
}

/**
 * The opening, degrees, at which `quasimc show` takes its picture from where the page does, and how
 * many pixels of it one of the page's is: pictures are taken from where all corners of the box just fit.
 */
function cameraOf({ low, high }, azimuth, elevation, width, height) {
  const radians = Math.PI / 180;
  const towards = (a, e) =>
    [Math.sin(a * radians) * Math.cos(e * radians), Math.cos(a * radians) * Math.cos(e * radians), Math.sin(e * radians)];
  const back = towards(azimuth, elevation);
  const right = towards(azimuth - 90, 0);
  const up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
    back[0] * right[1] - back[1] * right[0]];
  const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
  const half = low.map((x, k) => (high[k] - x) / 2);
  const distance = kDistance * Math.hypot(...half);
  let focal = Infinity; // in pixels of the picture
  for (let i = 0; i < 8; ++i) {
    const corner = half.map((x, k) => ((i >> k) & 1 ? x : -x));
    const needed = 1.06 * Math.max(Math.abs(dot(corner, right)) / (width / 2), Math.abs(dot(corner, up)) / (height / 2));
    focal = Math.min(focal, (distance - dot(corner, back)) / needed);
  }
  const opening = (2 * Math.atan(Math.max(width, height) / 2 / focal)) / radians;
  return { opening, zoom: focal / (height / 2 / Math.tan(kHalfOpening)) };
}

/** Whether a pixel is not the white, or nothing, behind the scene. */
function isCovered({ width, height, data }, x, y) {
  const at = 4 * (Math.floor(y) * width + Math.floor(x));
  return x >= 0 && y >= 0 && x < width && y < height && data[at + 3] > 127 && data[at] + data[at + 1] + data[at + 2] < 765 - 90;
}

/** Of the pixels that one of the pictures covers the part that both do. */
function agreement(shown, traced, zoom, [left, top]) {
  let both = 0;
  let any = 0;
  for (let y = 0; y < shown.height; ++y) {
    for (let x = 0; x < shown.width; ++x) {
      const one = isCovered(shown, x, y);
      const other = isCovered(traced, traced.width / 2 + zoom * (x + 0.5 - left - shown.width / 2),
        traced.height / 2 + zoom * (y + 0.5 - top - shown.height / 2));
      both += one && other ? 1 : 0;
      any += one || other ? 1 : 0;
    }
  }
  assert.ok(any > 20000, `only ${any} pixels show anything`);
  return both / any;
}

/** What the canvas itself holds once it has been drawn anew, with the second pass. */
async function pictureOf(page) {
  const text = await page.evaluate(() => new Promise((done) => {
    const canvas = document.querySelector("#canvas");
    const gl = canvas.getContext("webgl2");
    const draw = gl.drawArrays.bind(gl);
    gl.drawArrays = (...words) => {
      draw(...words);
      gl.drawArrays = draw;
      done(canvas.toDataURL("image/png"));
    };
    document.querySelector("#shading").click();
  }));
  return Buffer.from(text.split(",")[1], "base64");
}

const address = pathToFileURL(path.join(folder, "leaves.html")).href;

async function check(page, bounds, name, azimuth, elevation, other) {
  const radius = Math.hypot(...bounds.low.map((x, k) => (bounds.high[k] - x) / 2));
  const view = { azimuth, elevation, distance: kDistance * radius, target: [0, 0, 0] };
  await page.goto("about:blank");
  await page.goto(`${address}#view=${encodeURIComponent(JSON.stringify(view))}&directions=false`);
  await page.waitForSelector("html[data-state=ready]");
  await page.waitForTimeout(600); // all is drawn after the last movement
  const shift = (await page.getAttribute("#canvas", "data-shift")).split(",").map(Number);
  const shown = await pixelsOf(page, await pictureOf(page));
  const { width, height } = shown;
  const pictureFrom = async (direction) => {
    const { opening, zoom } = cameraOf(bounds, azimuth, elevation, width, height);
    run("show", "leaves.json", "--no-annotations", "--camera", direction, "--fov", String(opening), "--size", `${width}x${height}`,
      "-o", "picture.png");
    return agreement(shown, await pixelsOf(page, readFileSync(path.join(folder, "picture.png"))), zoom, shift);
  };
  const same = await pictureFrom(`${azimuth},${elevation}`);
  console.log(`${name}: ${(100 * same).toFixed(2)} % of the pixels agree`);
  assert.ok(same > kLeast, `${name}: ${same}`);
  if (other) {
    const turned = await pictureFrom(other);
    assert.ok(turned < 0.9, `from ${other} it looks the same: ${turned}`);
  }
}

async function main() {
  writeFileSync(path.join(folder, "leaves.toml"), `
[[band]]
name = "PAR"
[run]
paths = 1024
[output]
json = "leaves.json"
[[source]]
type = "sky"
name = "sky"
model = "uniform"
irradiance_horizontal = 1
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
${leaves()}`);
  run("run", "leaves.toml", "--quiet");
  run("report", "leaves.json", "-o", "leaves.html");
  const browser = await chromium.launch({
    executablePath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  try {
    const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
    await page.goto(address);
    const { low, high } = JSON.parse(await page.locator("#data").textContent());
    await check(page, { low, high }, "front", 180, 0, "150,0");
    await check(page, { low, high }, "oblique", 200, 25);
    await check(page, { low, high }, "top", 180, 89.99);
  } finally {
    await browser.close();
  }
}

try {
  await main();
} finally {
  rmSync(folder, { recursive: true, force: true });
}
