// Layers with errors in "Mean by height": node layers_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: errors of layers do not follow from those of organs, which depend on each other, so only the run has
// them.
// Expected behaviour: in a result with layers the bars are those layers, with the 95 % intervals of the result;
// without layers, of other organs than all, and of flux, which layers sum, there are none. Differences of results with
// the same layers have the errors of independent results; of others none, and the chart says so.

import assert from "node:assert/strict";
import path from "node:path";
import { Workshop, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("layers");
const { pictures } = workshop;

const runFile = (layers) => `
title = "Two leaves"
bands = ["PAR"]
irradiance_unit = "W m-2"
[run]
paths = 256
${layers}
[[source]]
type = "sky"
model = "cie_overcast"
irradiance_horizontal = 100
${twoLeaves(0.4)}`;

const labelsOf = (page) => page.locator("#profile .hit").evaluateAll((hits) => hits.map((hit) => hit.getAttribute("aria-label")));
const whiskers = (page) => page.locator("#profile .error:not(.rim)");

/** The ends of bars and of error bars, from the lowest layer up: pixels from the axis. */
const lengthsOf = (page) => page.evaluate(() => {
  const width = (node) => node.getBBox().width;
  const byHeight = (one, other) => other.getBBox().y - one.getBBox().y;
  const of = (selector) => [...document.querySelectorAll(`#profile ${selector}`)].sort(byHeight).map(width);
  return { bars: of(".bar"), errors: of(".error:not(.rim)") };
});

async function checkLayers(page, result) {
  await open(page, workshop.address("layered"));
  const layers = result.groups.filter(({ by, organs }) => by === "layer" && organs > 0);
  const estimates = layers.map(({ absorbed_flux_density: density }) => density.PAR);
  const labels = await labelsOf(page);
  assert.equal(labels.length, 2, labels.join("\n"));
  labels.forEach((label, i) => {
    const [from, to, mean, error] = label.replace(/^height ([\d.]+) to ([\d.]+).m: mean ([\d.]+) ± ([\d.]+).*/, "$1 $2 $3 $4").split(" ").map(Number);
    assert.deepEqual([from, to], [layers[i].height_min, layers[i].height_max], label);
    assert.ok(Math.abs(mean - estimates[i].mean) <= estimates[i].standard_error, label);
    assert.ok(Math.abs(error / estimates[i].standard_error - 1) < 0.3, label);
  });
  const { bars, errors } = await lengthsOf(page);
  estimates.forEach(({ mean, ci95_low: low, ci95_high: high }, i) =>
    assert.ok(Math.abs(errors[i] / bars[i] - (high - low) / mean) < 0.02, `${errors} of ${bars}`));
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "layers.png") });
  }
  await page.locator("#profile .hit").first().click();
  await page.waitForFunction(() => document.querySelectorAll("#profile .error").length === 0);
  await page.getByRole("button", { name: "Clear filters" }).first().click();
  await page.waitForFunction(() => document.querySelectorAll("#profile .error:not(.rim)").length === 2);
  await page.locator("#quantity").selectOption("absorbed_flux");
  await page.waitForFunction(() => document.querySelectorAll("#profile .error").length === 0);
}

/** The bars and intervals are those of the layers of one result minus another. */
async function checkDifference(page, one, other) {
  const layersOf = ({ groups }) => groups.filter(({ by, organs }) => by === "layer" && organs > 0).map(({ absorbed_flux_density: density }) => density.PAR);
  const [own, others] = [one, other].map(layersOf);
  // The line of area is beside means alone.
  await page.waitForFunction(() => document.querySelectorAll("#profile .error:not(.rim)").length === 2 && !document.querySelector("#profile .area"));
  const { bars, errors } = await lengthsOf(page);
  own.forEach((a, i) => {
    const b = others[i];
    const expected = (2 * 1.96 * Math.hypot(a.standard_error, b.standard_error)) / Math.abs(a.mean - b.mean);
    assert.ok(Math.abs(errors[i] / bars[i] / expected - 1) < 0.1, `${errors} of ${bars}: ${expected}`);
  });
}

/** The line of leaf area begins where bars of means do; those of differences and errors begin elsewhere. */
async function checkArea(page) {
  for (const [show, count] of [["value", 1], ["difference", 0], ["error", 0]]) {
    await open(page, `${workshop.address("minus")}#show=${show}`);
    assert.equal(await page.locator("#profile .area").count(), count, show);
    assert.equal(await page.locator("#profile-area").isVisible(), count === 1, show);
  }
}

async function checkDifferences(page, one, other) {
  await open(page, `${workshop.address("minus")}#show=difference`);
  await checkDifference(page, one, other);
  await open(page, workshop.address("layered"));
  await page.locator("#compared-file").setInputFiles(workshop.inFolder("dim.json"));
  await checkDifference(page, one, other);
  await page.locator("#compared-file").setInputFiles(workshop.inFolder("plain.json"));
  await page.waitForFunction(() => document.querySelectorAll("#profile .error").length === 0);
  assert.equal(await page.locator("#profile-errors").textContent(), "errors not known");
}

const kLayers = "layer_heights = [0, 0.25, 0.75, 1.5]";
const layered = workshop.compute("layered", runFile(kLayers));
const dim = workshop.compute("dim", runFile(`${kLayers}\nseed = 7`).replace("horizontal = 100", "horizontal = 98"));
workshop.compute("plain", runFile(""));
["layered", "plain"].forEach((name) => workshop.report(name));
workshop.run("report", "layered.json", "--minus", "dim.json", "-o", "minus.html");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkLayers(page, layered);
  await open(page, workshop.address("plain"));
  assert.ok((await labelsOf(page)).length > 0);
  assert.equal(await whiskers(page).count(), 0, "errors without layers");
  await checkArea(page);
  await checkDifferences(page, layered, dim);
  assert.deepEqual(workshop.faults, []);
});
