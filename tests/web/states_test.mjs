// What the page shows before, without and beside a finished picture: node states_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: one sees a page first while it loads, and results without a title, light or organ are as
// common as others.
// Expected behaviour: names are short, hints cover no plant, and what is not there yet, or is not there at all, is said.

import assert from "node:assert/strict";
import { pixelsOf } from "./pixels.mjs";
import { Workshop, kDay, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("states");

const kRunFile = `bands = ["PAR"]${kDay}[run]\npaths = 256\n${twoLeaves()}`;

/** A result without a title has the name of its file, without folders. */
async function checkTitle(page, address) {
  await open(page, address);
  assert.equal(await page.locator("#title").textContent(), "day.json");
  assert.equal(await page.title(), "day.json — QuasiMC");
}

/** How many pixels of a box in the scene are coloured by light. */
async function colouredIn(page, box) {
  const { width, data } = await pixelsOf(page, await page.locator("#canvas").screenshot({ omitBackground: true }));
  let count = 0;
  for (let y = Math.floor(box.y); y < box.y + box.height; ++y) {
    for (let x = Math.floor(box.x); x < box.x + box.width; ++x) {
      const [red, green, blue] = data.subarray(4 * (y * width + x));
      count += Math.max(red, green, blue) - Math.min(red, green, blue) > 45 ? 1 : 0;
    }
  }
  return count;
}

/** The hint is seen, beside the plants, until an organ is pinned. */
async function checkHint(browser, address) {
  for (const [width, height] of [[1024, 768], [1280, 800], [720, 1280]]) {
    const page = await workshop.page(browser, { viewport: { width, height } });
    await open(page, `${address}#directions=false`);
    await page.waitForTimeout(800); // at rest
    const [hint, stage] = await page.evaluate(() => ["hint", "stage"].map((id) => document.getElementById(id).getBoundingClientRect().toJSON()));
    assert.ok(hint.height > 10 && hint.bottom <= stage.bottom, `${width} x ${height}: the hint is not seen`);
    await page.evaluate(() => (document.getElementById("legend").style.visibility = "hidden"));
    assert.equal(await colouredIn(page, { ...hint, x: hint.x - stage.x, y: hint.y - stage.y }), 0, `${width} x ${height}: the hint covers leaves`);
    assert.ok(await colouredIn(page, { x: 0, y: 0, width: stage.width, height: stage.height }) > 3000, "no leaf is seen");
    await open(page, `${address}#pins=["1"]`);
    assert.ok(!(await page.locator("#hint").isVisible()), "the hint stays");
    await page.context().close();
  }
}

workshop.compute("day", kRunFile);
const address = workshop.report("day");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkTitle(page, address);
  await checkHint(browser, address);
  assert.deepEqual(workshop.faults, []);
});
