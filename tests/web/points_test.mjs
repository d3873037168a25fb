// The points of a sweep on the page: node points_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: a sweep is made to be compared; from one point all others must be reached, and their differences
// seen.
// Expected behaviour: the strip has a bar for each point, as high as its light; keys and clicks go from
// point to point; the numbers are those of the result, and differences those of two of its points.

import assert from "node:assert/strict";
import path from "node:path";
import { Workshop, kDay, open, threeSuns, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("points");
const { pictures } = workshop;

const kRunFile = threeSuns(1024);

/** Three days with weights: a year. */
const kWeights = [120, 130, 115];
const kYear = `
title = "A year from three days"
bands = ["PAR"]${kDay}
[run]
paths = 256
[sweep]
weights = [${kWeights}]
time.day = ["2023-01-15", "2023-06-15", "2023-11-15"]
[cell]
x = [-1, 1]
y = [-1, 1]
[ground]
material = "leaf"${twoLeaves()}`;

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
  const left = await page.locator("#strip .step").evaluateAll((bars) => bars.map((bar) => Number(bar.getAttribute("x"))));
  assert.ok(left[1] - left[0] < 100, "few points stand together");
  await page.keyboard.press("]");
  await page.waitForFunction(() => document.getElementById("time-title").textContent === "elevation 45°");
  await page.keyboard.press("/");
  await page.keyboard.type("upper");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#cards article");
  const value = Number.parseFloat(await cardValue(page));
  const { mean, standard_error: error } = upperAt(result, 1);
  assert.ok(Math.abs(value - mean) <= Math.max(error, 0.001 * mean), `${value}, ${mean} ± ${error}`);
  await page.waitForFunction(() => location.hash.includes("time=point-2") && location.hash.includes("pins"));
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

/** Texts of the strip that touch each other. */
const crowded = (page) => page.locator("#strip text").evaluateAll((texts) => texts.map((text) => text.getBoundingClientRect())
  .filter((box, i, all) => i > 0 && box.left < all[i - 1].right).length);

/** The names of the values that a page requests while an action is done. */
async function readDuring(page, act) {
  const names = new Set();
  const note = (request) => /values-/.test(request.url()) && names.add(request.url());
  page.on("request", note);
  await act();
  page.off("request", note);
  return names.size;
}

/** The sum with the given weights is the first entry; each day has its own name, bar and hours. */
async function checkYear(page, address, result) {
  await open(page, address);
  await page.waitForFunction(() => document.querySelectorAll("#strip .step").length === 3 && !document.querySelector("#strip .unknown"));
  const days = result.points.map(({ total }) => total.groups.find(({ by }) => by === "all").absorbed_flux.PAR);
  const sum = days.reduce((all, { mean }, i) => all + kWeights[i] * mean, 0) / 4e6; // MJ, of 4 square metres
  const headline = async () => Number.parseFloat((await page.locator("#headline .number").textContent()).replace(/,/g, ""));
  assert.equal(await shown(page), `${kWeights.reduce((all, weight) => all + weight, 0)} days`);
  assert.equal(await page.locator("#course-unit").textContent(), "MJ\u00a0m⁻²\u00a0d⁻¹");
  await page.getByRole("tab", { name: "Run and warnings" }).click();
  assert.match(await page.locator("#report").textContent(), /points3: 15 January 2023 to 15 November 2023; 256 paths × \d+ replicates eachsite/);
  await page.getByRole("tab", { name: "Charts" }).click();
  assert.ok(Math.abs((await headline()) - sum) < 0.005 * sum, `${await headline()} for ${sum}`);
  const error = kWeights.reduce((all, weight, i) => all + weight * days[i].standard_error, 0) / 4e6;
  const own = Number.parseFloat((await page.locator("#headline .number .error").textContent()).replace(/[^\d.]/g, ""));
  assert.ok(Math.abs(own - error) < 0.1 * error, `the bound ${own} for ${error}`);
  await page.getByRole("radio", { name: "Days" }).click();
  await page.waitForFunction(() => document.getElementById("time-title").textContent === "15 June 2023"); // the day of most light
  assert.ok(Math.abs((await headline()) - days[1].mean / 4e6) < 0.005 * days[1].mean / 4e6);
  await page.setViewportSize({ width: 390, height: 844 });
  assert.equal(await crowded(page), 0);
  await page.setViewportSize({ width: 1280, height: 800 });
  assert.equal(await crowded(page), 0);
  const read = await readDuring(page, async () => {
    await page.getByRole("radio", { name: "Hours" }).click();
    await page.waitForFunction(() => /^\d\d:00$/.test(document.getElementById("time-title").textContent));
  });
  const hours = result.points[1].time_steps.filter(({ energy }) => energy.PAR.absorbed_by_organs.mean > 0).length;
  assert.ok(read <= result.points[1].time_steps.length, `${read} times were read for the scale of the hours of the brightest day`);
  assert.ok(Math.abs((await page.locator("#strip .step:not(.day)").count()) - hours) <= 1, "bars of hours");
  await page.waitForFunction(() => location.hash.includes("point-2%20"));
  const end = await page.locator("#legend-scale .tick.last").textContent();
  await page.locator("#strip").click({ position: { x: 2, y: 8 } }); // the first day in the row above
  await page.waitForFunction(() => document.getElementById("time-title").textContent === "15 January 2023");
  await page.getByRole("radio", { name: "Hours" }).click();
  await page.waitForFunction(() => location.hash.includes("point-1%20"));
  assert.equal(await page.locator("#legend-scale .tick.last").textContent(), end, "hours of all days have one scale");
  await page.reload();
  await page.waitForSelector("html[data-state=ready]");
  assert.match(await shown(page), /^\d\d:00$/, "the address keeps the hour of a day");
}

const result = workshop.compute("points", kRunFile);
const year = workshop.compute("year", kYear);
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
  await checkYear(page, await workshop.view("year"), year);
  await checkYear(page, workshop.report("year"), year);
  assert.deepEqual(workshop.faults, []);
});
