// The points of a sweep on the page: node points_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: a sweep is made to be compared; from one point all others must be reached, and their differences
// seen.
// Expected behaviour: the strip has a bar for each point, as high as its light; keys and clicks go from
// point to point; the numbers are those of the result, and differences those of two of its points.

import assert from "node:assert/strict";
import path from "node:path";
import { Workshop, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("points");
const { pictures } = workshop;

/** Two leaves under a sun of three heights. */
const kRunFile = `
title = "Two leaves under three suns"
bands = ["PAR"]
irradiance_unit = "W m-2"
[sweep]
source.sun.elevation_deg = [15, 45, 80]
[run]
paths = 1024
[[source]]
type = "directional"
name = "sun"
azimuth_deg = 180
elevation_deg = 40
irradiance_facing = 400${twoLeaves()}`;

/** The estimate of the upper leaf at a point of the result. */
const upperAt = (result, point) => result.points[point].organs[0].absorbed_flux_density.PAR;

const shown = (page) => page.locator("#time-title").textContent();
const cardValue = (page) => page.locator("#cards article .number").first().textContent();

async function checkPoints(page, address, result) {
  await open(page, address);
  assert.equal(await shown(page), "elevation 15°");
  await page.waitForFunction(() => document.querySelectorAll("#strip .step").length === 3 && !document.querySelector("#strip .unknown"));
  const heights = await page.locator("#strip .step").evaluateAll((bars) => bars.map((bar) => Number(bar.getAttribute("height"))));
  const lights = result.points.map(({ energy }) => energy.PAR.absorbed_by_organs.mean);
  heights.forEach((height, i) => assert.ok(Math.abs(height / heights[2] - lights[i] / lights[2]) < 0.03, `${heights} for ${lights}`));
  await page.keyboard.press("]");
  await page.waitForFunction(() => document.getElementById("time-title").textContent === "elevation 45°");
  await page.keyboard.press("/");
  await page.keyboard.type("upper");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#cards article");
  const value = Number.parseFloat(await cardValue(page));
  const { mean, standard_error: error } = upperAt(result, 1);
  assert.ok(Math.abs(value - mean) <= Math.max(error, 0.001 * mean), `${value}, ${mean} ± ${error}`);
  await page.waitForFunction(() => location.hash.includes("time=point-2"));
  await page.reload();
  await page.waitForSelector("html[data-state=ready]");
  assert.equal(await shown(page), "elevation 45°", "the address keeps the point");
}

/** A single point has no strip of points; neither is one asked for. */
async function checkSingle(page, address) {
  await open(page, address);
  assert.equal(await page.locator("#strip .step").count(), 0);
  assert.equal(await page.locator("#compared").count(), 0);
}

async function checkDifference(page, result) {
  await page.getByLabel("Compared with").selectOption({ label: "elevation 15°" });
  await page.waitForFunction(() => document.querySelector("#legend-title").textContent.includes("elevation 15°"));
  const difference = upperAt(result, 1).mean - upperAt(result, 0).mean;
  await page.waitForSelector("#cards article");
  const value = Number.parseFloat(await cardValue(page));
  assert.ok(Math.abs(value - difference) < 0.01 * difference, `${value}, ${difference}`);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "points-difference.png") });
  }
  await page.getByLabel("Compared with").selectOption({ label: "nothing" });
  await page.waitForFunction(() => !document.querySelector("#legend-title").textContent.includes("elevation"));
}

const result = workshop.compute("points", kRunFile);
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkPoints(page, await workshop.view("points"), result);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "points.png") });
  }
  await checkDifference(page, result);
  await checkPoints(page, workshop.report("points"), result);
  await checkDifference(page, result);
  await checkSingle(page, await workshop.view("points", "--sweep-point", "2"));
  await checkSingle(page, workshop.report("points", "--sweep-point", "2"));
  assert.deepEqual(workshop.faults, []);
});
