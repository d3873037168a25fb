// Another result, opened on the page: node compare_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: one compares a result with a colleague's file, and a number from files that do not fit is worse than
// none.
// Expected behaviour: the page subtracts the file that is opened, organ by organ, with errors as of independent
// results; files that do not fit change nothing, and a sentence says why.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { Workshop, kDay, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("compare");
const { pictures } = workshop;

const kSun = `irradiance_unit = "W m-2"
[[source]]
type = "directional"
name = "sun"
azimuth_deg = 180
elevation_deg = 40
irradiance_facing = 400`;

const runFile = ({ title = "Two leaves", bands = '["PAR"]', light = kSun, leaves = twoLeaves(), more = "" }) => `
title = "${title}"
bands = ${bands}
${light.replace(/\n\[/, `\n${more}[run]\npaths = 1024\n[`)}${leaves}`;

/** Leaves with other ids. */
const withIds = (leaves, first) => leaves.replace(/\[\[organ\]\]/g, () => `[[organ]]\nid = ${first++}`);

const file = (name) => workshop.inFolder(`${name}.json`);
const choose = (page, name) => page.locator("#compared-file").setInputFiles(name);
const said = (page) => page.locator("#panel [role=alert]").textContent();

/** The mean and the standard error of a card: "12.3 ± 0.2 W m⁻²", with a true minus. */
async function cardNumbers(page) {
  const text = (await page.locator("#cards article .number").first().textContent()).replaceAll("−", "-");
  return text.match(/-?[\d.]+/g).slice(0, 2).map(Number);
}

async function checkNumbers(page, one, other, estimateOf) {
  const [a, b] = [one, other].map(estimateOf);
  const mean = a.mean - b.mean;
  const error = Math.hypot(a.standard_error, b.standard_error);
  await page.waitForFunction(() => document.querySelector("#legend-title").textContent.includes("Low sun"));
  const [shown, shownError] = await cardNumbers(page);
  assert.ok(Math.abs(shown - mean) <= error, `${shown}, ${mean} ± ${error}`);
  assert.ok(Math.abs(shownError - error) <= 0.51 * 10 ** Math.floor(Math.log10(error)), `${shownError}, ${error}`);
  assert.match(await page.locator("#legend .known").getAttribute("title"), /√\(a² \+ b²\).*no replicates/);
}

async function checkDifference(page, one, other) {
  await open(page, `${workshop.address("one")}#pins=%5B%221%22%5D`);
  assert.equal(await page.getByRole("radio", { name: "Difference" }).count(), 0, "there is nothing to subtract");
  await choose(page, file("low"));
  await checkNumbers(page, one, other, ({ organs }) => organs[0].absorbed_flux_density.PAR);
  await checkHeadline(page, one, other, ({ energy }) => energy.PAR.absorbed_by_organs);
  assert.match(await page.locator("#shown").textContent(), /1 of 3 organs shown, 4 in one result only/);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "compare.png") });
  }
  await page.getByRole("button", { name: "Stop comparing with low.json" }).click();
  await page.waitForFunction(() => !document.querySelector("#legend-title").textContent.includes("Low sun"));
  assert.equal(await page.getByRole("radio", { name: "Difference" }).count(), 0);
}

/** The light of all plants, its error, and how much more or less it is. */
async function checkHeadline(page, one, other, plantsOf) {
  const [a, b] = [one, other].map(plantsOf);
  const text = (await page.locator("#headline").textContent()).replaceAll("−", "-");
  const [mean, error] = text.match(/(-?[\d.]+)\u00a0± ?\u00a0?([\d.]+)/).slice(1).map(Number);
  const expected = Math.hypot(a.standard_error, b.standard_error);
  assert.ok(Math.abs(mean - (a.mean - b.mean)) <= expected, `${text}: ${a.mean} - ${b.mean} ± ${expected}`);
  assert.ok(Math.abs(error - expected) <= 0.51 * 10 ** Math.floor(Math.log10(expected)), text);
  const [, part, word] = text.match(/([\d.]+) ± [\d.]+ % (more|less) than “Low sun”$/);
  assert.ok(Math.abs(Number(part) / ((100 * Math.abs(a.mean - b.mean)) / b.mean) - 1) < 0.02, text);
  assert.equal(word, a.mean > b.mean ? "more" : "less");
}

/** A day: the sum, in megajoules, and an hour. */
async function checkDay(page, one, other) {
  await open(page, `${workshop.address("day")}#pins=%5B%221%22%5D`);
  const widths = () => page.locator("#charts .plot:visible").evaluateAll((plots) => plots.map((plot) => [plot.clientWidth, Number(plot.querySelector("svg").getAttribute("width"))]));
  const before = await widths();
  await choose(page, file("lowday"));
  let after = await widths();
  for (let i = 0; i < 60 && !(after.length === 2 && after.every(([wide, drawn]) => wide === drawn)); ++i) {
    await page.waitForTimeout(100);
    after = await widths();
  }
  assert.ok(before.length === 3 && after.length === 2 && after[0][0] > before[0][0], `${before}; ${after}`);
  after.forEach(([wide, drawn]) => assert.equal(drawn, wide, "a chart keeps its old width"));
  const inMegajoules = ({ mean, standard_error: error }) => ({ mean: mean / 1e6, standard_error: error / 1e6 });
  await checkNumbers(page, one, other, ({ total }) => inMegajoules(total.organs[0].absorbed_flux_density.PAR));
  await checkHeadline(page, one, other, ({ total }) => inMegajoules(total.groups.find(({ by }) => by === "all").absorbed_flux.PAR));
  const noon = ({ time_steps: steps }) => steps.find(({ time }) => time.includes("T12:00")).organs[0].absorbed_flux_density.PAR;
  await page.evaluate(() => document.getElementById("strip").focus());
  await page.getByRole("radio", { name: "Hours" }).click();
  for (let i = 0; i < 24 && (await page.locator("#time-title").textContent()) !== "12:00"; ++i) {
    await page.keyboard.press("]");
    await page.waitForTimeout(50);
  }
  await page.waitForFunction(() => document.querySelector("#legend-note").textContent.includes("12:00 – 13:00"));
  assert.match(await page.locator("#time").textContent(), /bars: this result alone/);
  await checkNumbers(page, one, other, noon);
}

async function checkMisfits(page) {
  writeFileSync(workshop.inFolder("notes.json"), "not JSON");
  writeFileSync(workshop.inFolder("table.json"), "{}");
  writeFileSync(workshop.inFolder("newer.json"), JSON.stringify({ ...JSON.parse(readFileSync(file("one"))), format_version: 9 }));
  await open(page, workshop.address("one"));
  const before = await page.locator("#legend").textContent();
  for (const [name, why] of [
    ["notes", /^notes\.json is not a JSON result \(.*\)\. Write one with/], ["table", /^table\.json is not a result of quasimc/], ["newer", /version 9, and this page reads version 2/],
    ["ids", /no organ of this result\. Organs are matched by their ids, such as 1 here and 11 there/], ["nir", /no quantity and band of this result, such as Absorbed per area, PAR/],
    ["photons", /other units: Absorbed per area, PAR is in W.m⁻² here and in µmol.m⁻².s⁻¹ there/], ["sweep", /2 points of a sweep/], ["day", /no time of this result, which is of a single time/],
  ]) {
    await choose(page, file(name));
    await page.locator("#panel [role=alert]", { hasText: `${name}.json` }).waitFor({ timeout: 5000 }).catch(() => {});
    assert.match(await said(page), why);
    assert.equal(await page.locator("#legend").textContent(), before, "the page has changed");
  }
}

const low = kSun.replace("elevation_deg = 40", "elevation_deg = 15");
const other = "\n[[organ]]\nmaterial = \"leaf\"\nshape = \"triangle\"\ncorners = [[2, 0, 1], [3, 0, 1], [2, 1, 1]]\n";
const one = workshop.compute("one", runFile({ leaves: twoLeaves() + other }));
const two = workshop.compute("low", runFile({ title: "Low sun", light: low, leaves: withIds(twoLeaves() + other, 1).replace("id = 2", "id = 12").replace("id = 3", "id = 13") }));
const day = workshop.compute("day", runFile({ light: kDay }));
const lowDay = workshop.compute("lowday", runFile({ title: "Low sun", light: kDay.replace("45", "60") }));
workshop.compute("ids", runFile({ leaves: withIds(twoLeaves(), 11) }));
workshop.compute("nir", runFile({ bands: '["NIR"]' }));
workshop.compute("photons", runFile({ light: kSun.replace("W m-2", "umol m-2 s-1") }));
workshop.compute("sweep", runFile({ more: "[sweep]\nsource.sun.elevation_deg = [15, 45]\n" }));
workshop.report("one");
workshop.report("day");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkDifference(page, one, two);
  await checkDay(page, day, lowDay);
  await checkMisfits(page);
  assert.deepEqual(workshop.faults, []);
});
