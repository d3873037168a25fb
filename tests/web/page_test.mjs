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

/** How many pixels of the scene are as colourful as organs that are not dimmed. */
async function colourfulPixels(page) {
  await page.waitForTimeout(400); // at rest
  const pixels = await pixelsOf(page, await page.locator("#canvas").screenshot());
  return countPixels(pixels, (red, green, blue) => Math.max(red, green, blue) - Math.min(red, green, blue) > 40);
}

const kNumber = /(−?[\d.,]+)(?: ±|\s|$)/;
const numberIn = (text) => Number(kNumber.exec(text)?.[1].replaceAll(",", "").replace("−", "-"));
/** Whether a number as it is shown is that of a result: to the digits that its error supports. Sums are in MJ. */
const near = (shown, { mean, standard_error: error }, factor = 1) =>
  Math.abs(shown / factor - mean) <= Math.max(2e-3 * Math.abs(mean), 0.6 * error);

/** Points at the middle of the scene, seen from above: the upper leaf is there. */
async function hoverMiddle(page) {
  await page.getByRole("button", { name: "Top" }).click();
  await page.waitForTimeout(400);
  const box = await page.locator("#canvas").boundingBox();
  const [x, y] = (await page.getAttribute("#canvas", "data-shift")).split(",").map(Number);
  await page.mouse.move(2, 2);
  await page.waitForSelector("#tip", { state: "hidden" });
  await page.mouse.move(box.x + box.width / 2 + x, box.y + box.height / 2 + y);
  await page.waitForSelector("#tip:not([hidden])");
  return { name: await page.locator("#tip b").textContent(), number: numberIn(await page.locator("#tip .number").textContent()) };
}

const chip = (page, key, value) => page.getByRole("group", { name: key, exact: true }).getByRole("button", { name: value });
const clearFilters = (page) => page.locator("#panel").getByRole("button", { name: "Clear filters" }).click();

async function checkNumbers(page, result) {
  const upper = result.total.organs[0];
  const tip = await hoverMiddle(page); // the sum is shown first
  assert.equal(await page.locator("#time-title").textContent(), "Sum of the day");
  assert.equal(tip.name, upper.name);
  assert.ok(near(tip.number, upper.absorbed_flux_density.PAR, 1e-6), `${tip.number}: ${upper.absorbed_flux_density.PAR.mean}`);

  // The number above all: the light of the plants, as the result has them together.
  const all = result.total.groups.find(({ by }) => by === "all").absorbed_flux.PAR;
  assert.ok(near(numberIn(await page.locator("#headline p.number").textContent()), all, 1e-6), await page.locator("#headline").textContent());

  // The strip goes through the times; hidden organs no longer cover others.
  await page.getByRole("radio", { name: "Hours" }).click();
  await page.locator("#strip").focus();
  await page.keyboard.press("Home");
  for (const moment of result.time_steps) {
    const hour = moment.time.slice(11, 16);
    await page.waitForFunction((time) => document.querySelector("#time-title").textContent === time, hour);
    await page.waitForFunction((time) => document.querySelector("#legend-note").textContent.includes(time), hour);
    const own = await hoverMiddle(page);
    const expected = moment.organs[0].absorbed_flux_density.PAR;
    assert.ok(near(own.number, expected), `${moment.time}: ${own.number}: ${expected.mean}`);
    await page.locator("#strip").focus();
    await page.keyboard.press("ArrowRight");
  }
  await page.getByRole("radio", { name: "Day" }).click();
  await page.waitForFunction(() => document.querySelector("#time-title").textContent === "Sum of the day");
}

async function checkFilters(page) {
  const shown = () => page.locator("#shown").textContent();
  assert.match(await shown(), /^3 of 3/);
  await chip(page, "kind", /^stem/).click();
  assert.match(await shown(), /^1 of 3 organs shown$/);
  const tip = await hoverMiddle(page);
  assert.equal(tip.name, "lower", "filtered by kind");
  // Of several labels all must hold.
  await chip(page, "kind", /^blade/).click();
  assert.match(await shown(), /^2 of 3/);
  await chip(page, "plant", /^<script/).click();
  assert.match(await shown(), /^1 of 3/);
  assert.ok((await hoverMiddle(page)).name.startsWith("upper "));
  await clearFilters(page);
  assert.match(await shown(), /^3 of 3/);
  await page.locator("#ground").uncheck();
  assert.match(await shown(), /^2 of 3/);
  await page.locator("#ground").check();
  await page.locator("#histogram .hit").first().click();
  assert.match(await page.locator("#active").textContent(), /^Value .*✕$/);
  await page.mouse.move(2, 2);
  assert.match(await shown(), /^[12] of 3/);
  await page.locator("#active button").click();
  assert.match(await shown(), /^3 of 3/);
  // Nothing passes: the page says so, and how to get out.
  await chip(page, "kind", /^stem/).click();
  await chip(page, "plant", /^<script/).click();
  assert.match(await page.locator("#nothing").textContent(), /No organ passes/);
  await page.locator("#clear").click();
  assert.ok(await page.locator("#nothing").isHidden());
  await page.getByRole("radio", { name: "z" }).click();
  await page.locator("#cut-at").fill("700"); // of the height of 1: below the upper leaf
  assert.match(await page.locator("#cut-text").textContent(), /z = 0\.7\sm/);
  assert.equal((await hoverMiddle(page)).name, "lower", "what is cut away is still there");
  await page.getByRole("radio", { name: "No cut" }).click();
}

/** Bars and organs that belong together are set apart together, by mouse and by key. */
async function checkBars(page, name) {
  await page.getByRole("button", { name: "Top" }).click();
  await page.mouse.move(2, 2);
  const plain = await colourfulPixels(page);
  await page.locator("#profile .hit").last().hover(); // the highest layer: the upper leaf alone
  assert.match(await page.locator("#shown").textContent(), /^height .* 1 organ, .*, marked in the scene$/);
  const marked = await colourfulPixels(page);
  assert.ok(marked > 300 && marked < 0.6 * plain, `${marked} of ${plain} pixels are not dimmed`);
  await page.mouse.move(2, 2);
  assert.ok(Math.abs((await colourfulPixels(page)) - plain) < 0.02 * plain, "others stay dimmed");
  assert.match(await page.locator("#shown").textContent(), /^3 of 3 organs shown$/);
  await page.locator("#by [aria-checked=true]").focus();
  await page.keyboard.press("Tab");
  await page.keyboard.press("ArrowLeft"); // the last bar: the upper leaf
  assert.match(await page.locator("#shown").textContent(), /organs?.*marked in the scene$/);
  assert.ok((await colourfulPixels(page)) < 0.6 * plain, "a bar that has the focus dims nothing");
  await page.locator("#canvas").focus();

  // The other way round: the organ that is pointed at, or reached by a key, marks its bars.
  await hoverMiddle(page);
  const current = page.locator("#profile .hit[aria-current=true]");
  assert.equal(await current.count(), 1);
  assert.equal(await current.getAttribute("data-bin"), await page.locator("#profile .hit").last().getAttribute("data-bin"));
  await page.mouse.move(2, 2);
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.waitForFunction((own) => document.querySelector("#said").textContent.startsWith(own), name);
  assert.equal(await page.locator("#histogram .hit[aria-current=true]").count(), 1);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".hit[aria-current=true]").count(), 0);
}

async function checkKeys(page, upper) {
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.keyboard.press("Enter");
  await page.waitForFunction((name) => document.querySelector("#cards .card h3")?.textContent === name, upper);
  const about = await page.locator("#cards").textContent();
  assert.ok(about.includes("kind blade"), about);
  await page.locator("#cards summary").click();
  await page.waitForFunction(() => document.querySelector("#cards details table")?.textContent.includes("Absorbed per area, NIR"));
  await page.keyboard.press("Tab");
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.waitForFunction(() => document.querySelector("#said").textContent.startsWith("lower"));
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  await page.keyboard.press("Escape"); // lets go
  await page.keyboard.press("Escape"); // unpins
  assert.equal(await page.locator("#cards .card").count(), 0);
  await page.keyboard.press("/");
  await page.keyboard.type("zzz");
  assert.match(await page.locator("#hits").textContent(), /^No organ is called “zzz”/);
  await page.locator("#find").fill("lower");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#cards .card h3")?.textContent === "lower");
  await page.locator("#cards").getByRole("button", { name: "Unpin all" }).click();
}

/** Both ends of the scale have their numbers, and no two numbers are on each other. */
async function checkScale(page) {
  const marks = await page.locator("#legend-scale .tick").evaluateAll((all) => all.map((mark) => ({ part: parseFloat(mark.style.bottom), box: mark.getBoundingClientRect() })));
  assert.deepEqual([marks[0].part, marks.at(-1).part], [0, 100]);
  marks.slice(1).forEach(({ box }, i) => assert.ok(box.bottom <= marks[i].box.top + 1, `${box.bottom} and ${marks[i].box.top}`));
}

async function checkReport(page, result) {
  await page.getByRole("tab", { name: "Run and warnings" }).click();
  const text = await page.locator("#report").textContent();
  for (const word of ["Where the light goes", "organs ", "Groups of organs", "all organs", "SHA-256", result.inputs[0]?.sha256 ?? "", "paths"]) {
    assert.ok(text.includes(word), word);
  }
  await page.getByRole("tab", { name: "Table" }).click();
  const rows = await page.locator("#table tbody tr").allTextContents();
  assert.equal(rows.length, 3);
  assert.ok(rows.some((row) => row.startsWith("lower")), rows.join("\n"));
  await page.getByRole("tab", { name: "Charts" }).click();
  assert.ok((await page.title()).includes(kTrick), "a title is text, not markup");
  assert.equal(await page.locator("#title img, #report img, #cards img, #panel img, #table img").count(), 0);
}

async function checkAll(page, faults, result, name) {
  await checkNumbers(page, result);
  const colors = await colorsOf(page);
  assert.ok(colors > 20, `the canvas shows ${colors} colours`);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, `${name}.png`), fullPage: true });
  }
  await checkScale(page);
  await checkFilters(page);
  await checkBars(page, result.total.organs[0].name);
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
    assert.equal(await page.locator("#table tbody tr").count(), 3);
    await page.getByRole("tab", { name: "Run and warnings" }).click();
    assert.ok(await page.locator("#report table").count() > 3);
    await page.getByRole("tab", { name: "Charts" }).click();
    await page.waitForSelector("#histogram .hit", { state: "attached" });
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
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
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
