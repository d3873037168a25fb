// Sensors on the page: node sensors_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: sensors are what a field study compares with, so they must be read where they hang, on the scale of the
// leaves, and must not count as leaves.
// Expected behaviour: sensors are marks in the scene, rows of the table, and can be found, pinned, hidden and compared;
// their numbers are those of the result; charts and counts of organs are without them.

import assert from "node:assert/strict";
import path from "node:path";
import { pixelsOf } from "./pixels.mjs";
import { Workshop, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("sensors");
const { pictures } = workshop;

const runFile = (elevation) => `
title = "Two leaves and three sensors"
bands = ["PAR"]
irradiance_unit = "W m-2"
[run]
paths = 1024
[[source]]
type = "directional"
azimuth_deg = 180
elevation_deg = ${elevation}
irradiance_facing = 400
[[sensors]]
name = "low"
at = [[0, 0.1, 0.2], [2, 0, 0.2]]
[[sensors]]
name = "high"
at = [[0, 0, 1.5]]
receiver = "sphere"
size = 0.01
${twoLeaves()}`;

const settled = (page) => page.waitForTimeout(800);
const isColoured = (red, green, blue) => Math.max(red, green, blue) - Math.min(red, green, blue) > 45;

/** The coloured pixels of the scene without what surrounds it: their number and middle. */
async function marks(page) {
  await settled(page);
  await page.evaluate(() => ["legend", "disc", "hint", "before", "behind", "badges"].forEach((id) => document.getElementById(id) && (document.getElementById(id).style.visibility = "hidden")));
  const pixels = await pixelsOf(page, await page.locator("#canvas").screenshot());
  let [x, y, count] = [0, 0, 0];
  for (let i = 0; i < pixels.width * pixels.height; ++i) {
    if (isColoured(...pixels.data.subarray(4 * i, 4 * i + 3))) {
      [x, y, count] = [x + (i % pixels.width), y + Math.floor(i / pixels.width), count + 1];
    }
  }
  return { count, x: x / count, y: y / count };
}

/** Whether the scene has a colour at a position on the canvas. */
async function isColouredAt(page, { x, y }) {
  await settled(page);
  const { data, width } = await pixelsOf(page, await page.locator("#canvas").screenshot());
  const at = 4 * (Math.round(y) * width + Math.round(x));
  return isColoured(...data.subarray(at, at + 3));
}

async function checkTable(page, result) {
  await open(page, `${workshop.address("sensed")}#quantity=incident_upper&tab=table`);
  assert.match(await page.locator("#subtitle").textContent(), /^2 organs · 2 triangles · 3 sensors$/);
  assert.match(await page.locator("#shown").textContent(), /^2 of 2 organs, 3 of 3 sensors shown$/);
  const rows = await page.locator("#table tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.equal(rows.length, 5);
  for (const { name, incident_upper: upper, fluence_rate: rate } of result.sensors) {
    const row = rows.find(([own]) => own.endsWith(name));
    const { mean, standard_error: error } = (rate ?? upper).PAR;
    const value = Number.parseFloat(row[4].replace(/[^\d.].*/, ""));
    assert.ok(Math.abs(value - mean) <= Math.max(error, 1e-3 * mean), `${row}: ${mean} ± ${error}`);
    assert.deepEqual([row[1], row[2]], ["sensor", ""], "a sensor has no area");
  }
}

async function checkMarks(page) {
  await open(page, `${workshop.address("sensed")}#quantity=incident_upper&labels=${encodeURIComponent('{"sensors":["high"]}')}`);
  const found = await marks(page);
  assert.ok(found.count > 20 && found.count < 5000, `${found.count} pixels`);
  const box = await page.locator("#canvas").boundingBox();
  await page.mouse.click(box.x + found.x, box.y + found.y);
  await page.waitForSelector("#cards article");
  assert.match(await page.locator("#cards article").textContent(), /high.*sensor 3 · 1\.50*.m high/);
  await open(page, `${workshop.address("sensed")}#quantity=incident_upper`);
  assert.ok(await isColouredAt(page, found), "the mark is where it was alone");
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "sensors.png") });
  }
  await page.getByLabel("Sensors", { exact: true }).first().uncheck();
  assert.ok(!(await isColouredAt(page, found)), "the mark is still there");
}

/** A sensor is a point: a view of it shows where it hangs, and its mark takes a small part. */
async function checkZoom(page) {
  const address = `${workshop.address("sensed")}#quantity=incident_upper&pins=${encodeURIComponent('["sensor 2"]')}`;
  await open(page, address);
  await page.getByRole("button", { name: "Zoom to it" }).click();
  await page.waitForTimeout(500);
  const distance = await page.evaluate(() => JSON.parse(new URLSearchParams(location.hash.slice(1)).get("view")).distance);
  assert.ok(distance > 1 && distance < 4, `seen from ${distance} m`);
}

/** The histogram counts the three sensors alone, as they are more than the two leaves, and the headline is their mean. */
async function checkCharts(page, result) {
  await open(page, workshop.address("sensed"));
  assert.equal(await page.locator("#legend-title").textContent(), "Light on the upper side, PAR", "three sensors, two leaves");
  await open(page, `${workshop.address("sensed")}#quantity=incident_upper&by=count`);
  const labels = await page.locator("#histogram .hit").evaluateAll((hits) => hits.map((hit) => hit.getAttribute("aria-label")));
  const counts = labels.map((label) => Number(label.match(/: (\d+) sensor/)[1]));
  assert.equal(counts.reduce((a, b) => a + b, 0), 3, labels.join("\n"));
  const mean = result.sensors.reduce((sum, { incident_upper: upper, fluence_rate: rate }) => sum + (rate ?? upper).PAR.mean / 3, 0);
  const shown = Number.parseFloat(await page.locator("#headline .number").textContent());
  assert.ok(Math.abs(shown - mean) < 0.01 * mean, `${shown}: ${mean}`);
}

async function checkDifference(page, one, other) {
  await open(page, `${workshop.address("sensed")}#quantity=incident_upper&pins=${encodeURIComponent('["sensor 2"]')}`);
  await page.locator("#compared-file").setInputFiles(workshop.inFolder("low.json"));
  await page.waitForFunction(() => document.querySelector("#legend-title").textContent.includes(" − "));
  const number = async () => Number.parseFloat((await page.locator("#cards article .number").first().textContent()).replaceAll("−", "-"));
  const [a, b] = [one, other].map(({ sensors }) => sensors[1].incident_upper.PAR.mean);
  assert.ok(Math.abs((await number()) / (a - b) - 1) < 0.01, `${await number()}, ${a} - ${b}`);
  await open(page, `${workshop.address("minus")}#show=difference&quantity=incident_upper&pins=${encodeURIComponent('["sensor 2"]')}`);
  assert.ok(Math.abs((await number()) / (a - b) - 1) < 0.01, "by --minus");
}

const sensed = workshop.compute("sensed", runFile(60));
const low = workshop.compute("low", runFile(30));
workshop.report("sensed");
workshop.run("report", "sensed.json", "--minus", "low.json", "-o", "minus.html");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkTable(page, sensed);
  await checkMarks(page);
  await checkCharts(page, sensed);
  await checkZoom(page);
  await checkDifference(page, sensed, low);
  assert.deepEqual(workshop.faults, []);
});
