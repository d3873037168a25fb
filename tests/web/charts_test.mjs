// Charts and the table with their units, errors and keys: node charts_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: beside open cards charts are narrow; points of a sweep have errors and distances; a table is also read by
// keys.
// Expected behaviour: at 1440 pixels with cards, units of all charts are seen and no text covers another. The area in
// layers has an axis. Points of a sweep are at the distances of their numbers, with the intervals of the result, and can
// be read and chosen. In the table arrows go through the organs; a head sorts, then the other way round, and stays
// focused.

import assert from "node:assert/strict";
import path from "node:path";
import { Workshop, kDay, open, threeSuns, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("charts");
const { pictures } = workshop;

const kSuns = threeSuns(64);

const kDays = `
title = "Three days"
bands = ["PAR"]${kDay}
[run]
paths = 64
[sweep]
time.day = ["2023-01-15", "2023-06-15", "2023-07-15"]${twoLeaves()}`;

const kDayFile = `
title = "Two leaves, a day"
bands = ["PAR"]${kDay}
[run]
paths = 16${twoLeaves()}`;

const kPins = "pins=%5B%221%22%2C%222%22%5D";

/** Texts of charts that are not seen whole, or touch each other. */
const crowded = (page) => page.evaluate(() => [...document.querySelectorAll("#charts figure")].flatMap((figure) => {
  const texts = [...figure.querySelectorAll("figcaption > b, figcaption > span:not(.space, [hidden]), .plot text:not(.letter)")]
    .filter((node) => node.textContent.trim() && node.checkVisibility());
  const boxes = texts.map((node) => ({ text: node.textContent, box: node.getBoundingClientRect() }));
  const edge = figure.getBoundingClientRect();
  const touch = ({ box: a }, { box: b }) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 3;
  const cut = boxes.filter(({ box }) => box.left < edge.left - 4 || box.right > edge.right + 1).map(({ text }) => `cut: ${text}`);
  return [...cut, ...boxes.flatMap((one, i) => boxes.slice(i + 1).filter((other) => touch(one, other)).map((other) => `${one.text} on ${other.text}`))];
}));

async function checkNarrow(page) {
  await page.setViewportSize({ width: 1440, height: 900 });
  await open(page, `${workshop.address("day")}#${kPins}`);
  await page.waitForFunction(() => document.querySelectorAll("#course .hit").length > 0 && document.querySelectorAll("#cards article").length === 2);
  for (const id of ["histogram-unit", "profile-unit", "profile-area", "course-unit", "course-mean"]) {
    const node = page.locator(`#${id}`);
    assert.ok(await node.isVisible() && (await node.textContent()).length > 0, id);
  }
  assert.deepEqual(await crowded(page), []);
  await open(page, `${workshop.address("day")}#${kPins}&show=error`);
  await page.waitForFunction(() => document.querySelectorAll("#cards article").length === 2);
  assert.deepEqual(await crowded(page), []);
  await open(page, `${workshop.address("day")}#${kPins}`);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "charts.png") });
  }
}

/** The outline of the area ends where the upper axis has the area of its greatest layer. */
async function checkArea(page, result) {
  const { line, ticks } = await page.evaluate(() => ({
    line: document.querySelector("#profile .area").getAttribute("points").split(" ").map((point) => Number(point.split(",")[0])),
    ticks: [...document.querySelectorAll("#profile text")].filter((text) => Number(text.getAttribute("y")) < 20 && Number.isFinite(Number(text.textContent)))
      .map((text) => [Number(text.textContent), Number(text.getAttribute("x"))]),
  }));
  const areas = result.total.organs.map(({ area }) => area); // flat leaves, each in a layer
  const [[zero, from], [last, to]] = [ticks[0], ticks.at(-1)];
  const shown = zero + ((Math.max(...line) - from) / (to - from)) * (last - zero);
  assert.equal(await page.locator("#profile-area").textContent(), "organ area, m²");
  assert.ok(Math.abs(shown / Math.max(...areas) - 1) < 0.01, `${shown} for ${areas}`);
}

const allPlants = ({ groups }) => groups.find(({ by }) => by === "all").absorbed_flux_density.PAR;

async function checkSuns(page, result) {
  await open(page, `${workshop.address("suns")}#pins=%5B%221%22%5D`);
  await page.waitForFunction(() => document.querySelectorAll("#course .point").length === 6);
  const { points, bars, ticks } = await page.evaluate(() => ({
    points: [...document.querySelectorAll("#course .point")].map((point) => [Number(point.getAttribute("cx")), Number(point.getAttribute("cy"))]),
    bars: [...document.querySelectorAll("#course .upright")].map((bar) => bar.getBBox().height),
    ticks: [...document.querySelectorAll("#course text")].filter((text) => text.getAttribute("text-anchor") === "end").map((text) => [Number(text.textContent), Number(text.getAttribute("y"))]).slice(0, 2),
  }));
  const [a, b, c] = points.map(([x]) => x);
  assert.ok(Math.abs((b - a) / (c - b) - 30 / 35) < 0.01, `${a} ${b} ${c} for 15, 45 and 80 degrees`);
  const perUnit = (ticks[0][1] - ticks[1][1]) / (ticks[1][0] - ticks[0][0]);
  const all = result.points.map(allPlants);
  all.forEach(({ ci95_low: low, ci95_high: high }, i) =>
    assert.ok(Math.abs(bars[i] - perUnit * (high - low)) < 0.6, `${bars[i]} for ${low} to ${high}`));
  await page.locator("#course .hit").nth(1).hover();
  const words = await page.locator("#shown").textContent();
  const [, mean] = words.match(/^elevation 45°: mean of all organs ([\d.]+) ± [\d.]+, A upper [\d.]+ ± [\d.]+\sW\sm⁻²$/);
  assert.ok(Math.abs(mean / all[1].mean - 1) < 0.02, words);
  await page.locator("#course .hit").nth(2).click();
  await page.waitForFunction(() => document.getElementById("time-title").textContent === "elevation 80°");
}

/** The mean of all organs has the unit of the axis: energy of days is in joules in the result. */
async function checkDays(page, result) {
  await open(page, workshop.address("days"));
  await page.waitForFunction(() => document.querySelectorAll("#course .point").length === 3);
  const xs = await page.locator("#course .point").evaluateAll((points) => points.map((point) => Number(point.getAttribute("cx"))));
  assert.ok(Math.abs((xs[1] - xs[0]) / (xs[2] - xs[1]) - 151 / 30) < 0.05, `${xs} for January, June and July`);
  const label = await page.locator("#course .hit").nth(1).getAttribute("aria-label");
  const [, mean, unit] = label.match(/^15 June 2023: mean of all organs ([\d.]+)[^M]*(MJ\sm⁻²)$/);
  assert.ok(unit && Math.abs((1e6 * mean) / allPlants(result.points[1].total).mean - 1) < 0.03, label);
}

/** Shares of the light of all organs are the same, whether it is shown per area or by organ. */
async function checkShares(page, result) {
  const lights = result.total.organs.map(({ absorbed_flux: flux }) => flux.PAR.mean);
  const all = lights.reduce((sum, light) => sum + light, 0);
  for (const quantity of ["absorbed_flux_density", "absorbed_flux"]) {
    await open(page, `${workshop.address("day")}#tab=table&quantity=${quantity}`);
    const shares = await page.locator("#table tbody tr").evaluateAll((rows) => rows.map((row) => [Number(row.dataset.organ), Number(row.lastElementChild.textContent)]));
    shares.forEach(([organ, share]) => assert.ok(Math.abs(share - (100 * lights[organ]) / all) < 0.6, `${quantity}: ${shares} of ${lights}`));
  }
}

async function checkTable(page) {
  await open(page, `${workshop.address("day")}#tab=table`);
  const names = () => page.locator("#table .link").allTextContents();
  const focused = () => page.evaluate(() => document.activeElement.textContent);
  const before = await names();
  assert.equal(await page.locator("#table .link[tabindex='0']").count(), 1, "stops of Tab");
  await page.locator("#table .link").first().focus();
  await page.keyboard.press("ArrowDown");
  assert.equal(await focused(), before[1]);
  await page.keyboard.press("Enter");
  await page.waitForFunction((name) => document.querySelector("#cards h3")?.textContent === name, before[1]);
  const head = page.locator("#table th", { hasText: "Height" });
  assert.equal(await head.locator("small").textContent(), "m");
  await head.locator("button").focus();
  for (const [order, sort] of [[["upper", "lower"], "descending"], [["lower", "upper"], "ascending"]]) {
    await page.keyboard.press("Enter");
    await page.waitForFunction((first) => document.querySelector("#table .link").textContent === first, order[0]);
    assert.deepEqual([await names(), await head.getAttribute("aria-sort"), await focused()], [order, sort, "Height"]);
  }
}

const day = workshop.compute("day", kDayFile);
const suns = workshop.compute("suns", kSuns);
const days = workshop.compute("days", kDays);
["day", "suns", "days"].forEach((name) => workshop.report(name));
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkNarrow(page);
  await checkArea(page, day);
  await checkSuns(page, suns);
  await checkDays(page, days);
  await checkShares(page, day);
  await checkTable(page);
  assert.deepEqual(workshop.faults, []);
});
