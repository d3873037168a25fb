// Neighbours of a periodic cell: node neighbours_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: a periodic scene is one cell of a stand, and its light depends on what surrounds it;
// but the copies have no numbers, so they must neither hide the cell nor be taken for it.
// Expected behaviour: on request pale copies fill the surroundings; the pixels of the cell stay as they were; copies
// can't be picked; without a periodic cell there is no such choice.

import assert from "node:assert/strict";
import path from "node:path";
import { pixelsOf } from "./pixels.mjs";
import { Workshop, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("neighbours");

const runFile = (cell) => `
title = "Two leaves"
bands = ["PAR"]
irradiance_unit = "W m-2"
[run]
paths = 256
[[source]]
type = "directional"
azimuth_deg = 180
elevation_deg = 60
irradiance_facing = 400
${cell}
${twoLeaves()}`;

const kName = "Neighbours of the cell, pale";
const kView = encodeURIComponent('{"azimuth":180,"elevation":60,"distance":9,"target":[0,0,0]}');
const addressOf = (name, more = "") => `${workshop.address(name)}#directions=false&shading=false&view=${kView}${more}`;

/** The picture at rest, without what lies over the scene. */
async function picture(page) {
  await page.waitForTimeout(2000);
  await page.waitForSelector("#canvas[data-rest=yes]");
  await page.evaluate(() => ["legend", "disc", "before", "behind", "badges"].forEach((id) => (document.getElementById(id).style.visibility = "hidden")));
  return pixelsOf(page, await page.locator("#canvas").screenshot());
}

const at = ({ data }, i) => [...data.subarray(4 * i, 4 * i + 3)];
const apart = (one, other) => Math.max(...one.map((x, k) => Math.abs(x - other[k])));
const spread = (color) => Math.max(...color) - Math.min(...color);

/**
 * Pixels that differ between pictures, and among them those of the cell, without its edges, through which copies are seen;
 * `after` is the strongest colour of a copy.
 */
function changes(before, after) {
  const { width, height } = before;
  const isOwn = (i) => spread(at(before, i)) > 30;
  const around = (i) => [-1, 0, 1].flatMap((row) => [-1, 0, 1].map((column) => i + row * width + column)).filter((j) => j >= 0 && j < width * height);
  const all = [...Array(width * height).keys()].filter((i) => apart(at(before, i), at(after, i)) > 4);
  const copies = all.filter((i) => !around(i).some(isOwn));
  return { all, cell: all.filter((i) => around(i).every(isOwn)).length, after: Math.max(0, ...copies.map((i) => spread(at(after, i)))) };
}

async function checkCopies(page, name, copies) {
  await open(page, addressOf(name));
  const words = await page.locator("#headline").textContent();
  const alone = await picture(page);
  await open(page, addressOf(name));
  await page.getByLabel(kName, { exact: true }).check();
  const stand = await picture(page);
  if (workshop.pictures) {
    await page.screenshot({ path: path.join(workshop.pictures, `neighbours-${name}.png`) });
  }
  const { all, cell, after } = changes(alone, stand);
  const own = [...Array(alone.width * alone.height).keys()].filter((i) => spread(at(alone, i)) > 60).length;
  assert.ok(own > 1000, `the cell takes ${own} pixels`);
  assert.ok(all.length > 0.3 * copies * own && all.length < 3 * copies * own, `${all.length} pixels of ${copies} copies, ${own} of the cell`);
  assert.ok(cell === 0 && after < 60, `${cell} pixels of the cell changed, or copies are not pale: ${after}`);
  assert.equal(await page.locator("#headline").textContent(), words);
  await checkPicking(page, stand, all);
}

/** A click on a copy pins nothing. */
async function checkPicking(page, { width }, pixels) {
  const box = await page.locator("#canvas").boundingBox();
  const isInner = new Set(pixels);
  const inner = pixels.filter((i) => [-12 * width, 12 * width, -12, 12].every((step) => isInner.has(i + step)));
  const pixel = inner[Math.floor(inner.length / 2)];
  await page.mouse.click(box.x + (pixel % width), box.y + Math.floor(pixel / width));
  assert.equal(await page.locator("#cards article").count(), 0);
}

workshop.compute("both", runFile("[cell]\nx = [-1, 1]\ny = [-1, 1]"));
workshop.compute("rows", runFile("[cell]\nx = [-1, 1]"));
workshop.compute("single", runFile(""));
["both", "rows", "single"].forEach((name) => workshop.report(name));
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkCopies(page, "both", 8);
  await checkCopies(page, "rows", 2);
  await open(page, addressOf("single", "&neighbours=true"));
  assert.equal(await page.getByLabel(kName, { exact: true }).count(), 0);
  assert.deepEqual(workshop.faults, []);
});
