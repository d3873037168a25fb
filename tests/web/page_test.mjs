// The page in a real browser: node page_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: what a person sees and does - a report opened from the disk without a network, and the
// same run served - must show the numbers of the result, for the organ that is pointed at.
// Expected behaviour: no word on the console, no request to anywhere, the right numbers.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { countPixels, pixelsOf } from "./pixels.mjs";

const [quasimc, executablePath, packages, pictures] = process.argv.slice(2);
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "quasimc-page-"));
const inFolder = (name) => path.join(folder, name);
const run = (...words) => execFileSync(quasimc, words, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
const kTrick = "<script>document.title='taken'</script><img src=x onerror=\"document.title='taken'\">";

/** Two leaves one above the other and a ground, at two times; names are tricks. */
const kRunFile = `
title = '''Leaves ${kTrick}'''
[[band]]
name = "PAR"
[[band]]
name = "NIR"
[site]
latitude_deg = 51.97
longitude_deg = 5.67
[time]
day = "2024-06-21"
utc_offset_hours = 1
hours = [9, 13]
sky = "uniform"
[run]
paths = 1024
[output]
json = "day.json"
[ground]
material = "leaf"
x = [-2, 2]
y = [-2, 2]
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
[[organ]]
name = '''upper ${kTrick}'''
labels = { kind = "blade", plant = '''${kTrick}''' }
material = "leaf"
shape = "triangle"
corners = [[-0.5, -0.5, 1], [0.5, -0.5, 1], [0, 0.6, 1]]
[[organ]]
name = "lower"
labels = { kind = "stem" }
material = "leaf"
shape = "triangle"
corners = [[-1, -1, 0.5], [1, -1, 0.5], [0, 1.2, 0.5]]
`;

/** Fails on anything that the page says, and on any request but those it may make. */
async function open(context, address, isAllowed) {
  const page = await context.newPage();
  const faults = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) &&
    !/GPU stall due to ReadPixels|software WebGL/.test(message.text()) && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("request", (request) => !isAllowed(request.url()) && faults.push(`asked for ${request.url()}`));
  await page.goto(address);
  await page.waitForSelector("html[data-state]");
  assert.equal(await page.getAttribute("html", "data-state"), "ready", faults.join("\n"));
  return { page, faults };
}

/** How many colours the canvas shows. */
async function colorsOf(page) {
  const { data } = await pixelsOf(page, await page.locator("#canvas").screenshot());
  return new Set(new Uint32Array(data.buffer, data.byteOffset, data.length / 4)).size;
}

/** How many pixels of the canvas have the colour of what is marked. */
async function markedPixels(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const pixels = await pixelsOf(page, await page.locator("#canvas").screenshot());
  return countPixels(pixels, (red, green, blue) => red > 180 && green < 110 && blue > 80 && blue < 190);
}

const meanIn = (text) => Number(/: (-?[\d.e+-]+) ±/.exec(text)?.[1]);
const near = (shown, value) => Math.abs(shown - value) <= 2e-3 * Math.abs(value);

/** Points at the middle of the canvas, seen from above: the upper leaf is there. */
async function hoverMiddle(page) {
  await page.getByRole("button", { name: "Top" }).click();
  const box = await page.locator("#canvas").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.move(box.x + box.width / 2 + 1, box.y + box.height / 2);
  await page.waitForSelector("#tip:not([hidden])");
  return page.locator("#tip").textContent();
}

async function checkNumbers(page, result) {
  const upper = result.total.organs[0];
  const total = upper.absorbed_flux_density.PAR;
  await page.selectOption("#part", "total");
  const tip = await hoverMiddle(page);
  assert.ok(tip.startsWith(upper.name), tip);
  assert.ok(near(meanIn(tip.slice(upper.name.length)), total.mean), `${tip}: ${total.mean}`);
  await page.waitForSelector("#organ table");
  const about = await page.locator("#organ").textContent();
  assert.ok(about.includes("kind = blade") && about.includes("absorbed flux density, NIR"), about);

  // The slider goes through the times; hidden organs no longer stand before others.
  await page.selectOption("#part", "time_steps");
  for (const [i, moment] of result.time_steps.entries()) {
    await page.locator("#time").fill(String(i));
    await page.waitForFunction((time) => document.querySelector("#legend-title").textContent.includes(time), moment.time);
    const text = await hoverMiddle(page);
    const mean = moment.organs[0].absorbed_flux_density.PAR.mean;
    assert.ok(near(meanIn(text.slice(upper.name.length)), mean), `${moment.time}: ${text}: ${mean}`);
  }
}

async function checkFilters(page) {
  const shown = () => page.locator("#shown").textContent();
  assert.match(await shown(), /^3 of 3/);
  const values = (key) => page.getByRole("listbox", { name: key });
  await values("kind").selectOption("stem");
  assert.match(await shown(), /^1 of 3 organs shown, kind stem$/);
  const tip = await hoverMiddle(page);
  assert.ok(tip.startsWith("lower: "), `filtered by kind, yet: ${tip}`);
  // Of several labels all must hold.
  await values("kind").selectOption(["stem", "blade"]);
  assert.match(await shown(), /^2 of 3/);
  await values("plant").selectOption(kTrick);
  assert.match(await shown(), /^1 of 3/);
  assert.ok((await hoverMiddle(page)).startsWith("upper "));
  await page.getByRole("button", { name: "Reset" }).click();
  assert.match(await shown(), /^3 of 3/);
  await page.locator("#ground").uncheck();
  assert.match(await shown(), /^2 of 3/);
  await page.locator("#histogram .bar").first().click();
  assert.match(await shown(), /^[01] of 3/);
  await page.getByRole("button", { name: "Reset" }).click();
  await page.selectOption("#cut", "z");
  await page.locator("#cut-at").fill("700"); // of the height of 1: below the upper leaf
  assert.match(await page.locator("#cut-text").textContent(), /z = 0\.7 m/);
  assert.ok((await hoverMiddle(page)).startsWith("lower: "), "what is cut away still stands there");
  await page.getByRole("button", { name: "Reset" }).click();
}

/** Bars and organs that belong together are set apart together, by mouse and by key. */
async function checkBars(page, result, name) {
  await page.getByRole("button", { name: "Top" }).click();
  await page.mouse.move(2, 2);
  const plain = await markedPixels(page);
  assert.ok(plain < 20, "nothing is chosen, yet something is marked");
  await page.locator("#profile .bar").last().hover(); // the highest layer: the upper leaf alone
  assert.match(await page.locator("#pointed").textContent(), /^height .* of 1 organ: 1 organ highlighted in the scene$/);
  const marked = await markedPixels(page);
  assert.ok(marked > 300, `${marked} pixels are marked`);
  await page.mouse.move(2, 2);
  assert.ok((await markedPixels(page)) < 20, "marks outlive the pointer");
  assert.equal(await page.locator("#pointed").textContent(), "");
  await page.locator("#histogram .bar").first().focus();
  assert.match(await page.locator("#pointed").textContent(), /organs?.*highlighted in the scene$/);
  assert.ok((await markedPixels(page)) > 300, "a bar that has the focus marks nothing");
  await page.locator("#canvas").focus();
  assert.ok((await markedPixels(page)) < 20);

  // The other way round: the organ that is pointed at, or chosen by a key, marks its bars.
  await hoverMiddle(page);
  const current = page.locator("#profile .bar[aria-current=true]");
  assert.equal(await current.count(), 1);
  assert.equal(await current.getAttribute("data-bin"), await page.locator("#profile .bar").last().getAttribute("data-bin"));
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.waitForFunction((own) => document.querySelector("#organ h3")?.textContent === own, name);
  const bar = await page.locator("#histogram .bar[aria-current=true]").getAttribute("aria-label");
  const mean = result.total.organs[0].absorbed_flux_density.PAR.mean;
  const [from, to] = /^(\S+) to (\S+):/.exec(bar).slice(1).map(Number);
  const shown = meanIn(`: ${await page.locator("#organ td.number").first().textContent()}`);
  assert.ok(shown >= from * 0.999 && shown <= to * 1.001, `${shown} is not in the bar ${bar} (sum: ${mean})`);
  assert.ok((await page.locator("#organ p").textContent()).includes(`in bar ${bar.split(":")[0]}`));
  await page.mouse.move(2, 2);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".bar[aria-current=true]").count(), 0);
}

async function checkKeys(page, upper) {
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.waitForFunction((name) => document.querySelector("#organ h3")?.textContent === name, upper);
  await page.keyboard.press("n");
  await page.waitForFunction(() => document.querySelector("#organ h3")?.textContent === "lower");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  await page.keyboard.press("Escape");
  await page.locator("#find").fill("lower");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#organ h3")?.textContent === "lower");
  await page.getByRole("button", { name: "Reset" }).click();
}

async function checkReport(page, result) {
  const text = await page.locator("#report").textContent();
  for (const word of ["Energy", "absorbed by organs", "all organs", "Largest errors", "SHA-256",
    result.inputs[0].sha256, "first_hits"]) {
    assert.ok(text.includes(word), word);
  }
  assert.ok((await page.title()).includes(kTrick), "a title is text, not markup");
  assert.equal(await page.locator("#title img, #report img, #organ img").count(), 0);
}

async function checkAll(page, faults, result, name) {
  await checkNumbers(page, result);
  const colors = await colorsOf(page);
  assert.ok(colors > 20, `the canvas shows ${colors} colours`);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, `${name}.png`), fullPage: true });
  }
  await checkFilters(page);
  await checkBars(page, result, result.total.organs[0].name);
  await checkKeys(page, result.total.organs[0].name);
  await checkReport(page, result);
  assert.deepEqual(faults, []);
}

async function checkServed(context, result) {
  const server = spawn(quasimc, ["view", inFolder("day.json")], { stdio: ["ignore", "pipe", "ignore"] });
  try {
    const address = await new Promise((done) => server.stdout.once("data", (bytes) => done(String(bytes).trim())));
    const { page, faults } = await open(context, address, (url) => url.startsWith(address) || url.startsWith("data:"));
    await checkAll(page, faults, result, "view");
    await page.close();
    server.kill("SIGINT");
    const status = await new Promise((done) => server.once("exit", (code) => done(code)));
    assert.equal(status, 0, "Ctrl-C ends the server in order");
  } finally {
    server.kill("SIGKILL");
  }
}

/** Without WebGL the numbers are there all the same. */
async function checkWithoutWebGl(address) {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-3d-apis"] });
  try {
    const page = await browser.newPage();
    await page.goto(address);
    await page.waitForSelector("html[data-state=ready]");
    assert.match(await page.locator("#notice").textContent(), /no WebGL/);
    assert.ok(await page.locator("#report table").count() > 3);
  } finally {
    await browser.close();
  }
}

async function main() {
  writeFileSync(inFolder("day.toml"), kRunFile);
  run("run", "day.toml", "--quiet");
  run("report", "day.json", "-o", "day.html");
  const result = JSON.parse(readFileSync(inFolder("day.json")));
  const browser = await chromium.launch({
    executablePath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  try {
    const context = await browser.newContext({ viewport: { width: 960, height: 720 } });
    const address = pathToFileURL(inFolder("day.html")).href;
    const { page, faults } = await open(context, address, (url) => url === address || url.startsWith("data:"));
    await checkAll(page, faults, result, "report");
    await page.emulateMedia({ colorScheme: "dark" });
    if (pictures) {
      await page.screenshot({ path: path.join(pictures, "dark.png") });
    }
    await page.close();
    await checkServed(context, result);
  } finally {
    await browser.close();
  }
  await checkWithoutWebGl(pathToFileURL(inFolder("day.html")).href);
}

try {
  await main();
} finally {
  rmSync(folder, { recursive: true, force: true });
}
