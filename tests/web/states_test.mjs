// What the page shows before, without and beside a finished picture: node states_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: one sees a page first while it loads, and results without a title, light or organ are as
// common as others.
// Expected behaviour: names are short, hints cover no plant, and what is not there yet, or is not there at all, is said.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
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

/** The picture comes back when the GPU was reset, as on a laptop that slept. */
async function checkReset(page, address) {
  await open(page, address);
  const { width, height } = await page.locator("#canvas").boundingBox();
  const coloured = () => colouredIn(page, { x: 0, y: 0, width, height });
  const before = await coloured();
  await page.evaluate(() => {
    globalThis.reset = document.getElementById("canvas").getContext("webgl2").getExtension("WEBGL_lose_context");
    globalThis.reset.loseContext();
  });
  await page.waitForTimeout(200);
  const lost = await coloured();
  await page.evaluate(() => globalThis.reset.restoreContext());
  await page.waitForTimeout(1500);
  const after = await coloured();
  assert.ok(lost < before - 3000 && Math.abs(after - before) < 0.05 * (before - lost), `${before} pixels, without context ${lost}, after a reset ${after}`);
}

/** The letters of the winds are before the scene, and seen from everywhere: no plant cuts one into pieces. */
async function checkWinds(page, address) {
  for (const azimuth of [20, 110, 200, 290]) {
    await open(page, `${address}#view=${encodeURIComponent(JSON.stringify({ azimuth, elevation: 14, distance: 6, target: [0, 0, 0] }))}`);
    const letters = await page.locator("#before .wind").allTextContents();
    assert.ok(letters.length === 4 && await page.locator("#behind .wind").count() === 0, `${azimuth}: ${letters}`);
    const outside = await page.evaluate(() => {
      const [stage, legend] = ["stage", "legend"].map((id) => document.getElementById(id).getBoundingClientRect());
      return [...document.querySelectorAll("#before .wind")].map((text) => text.getBoundingClientRect()).filter(({ left, right, top, bottom }) =>
        left < stage.left || right > stage.right || top < stage.top || bottom > stage.bottom || (left < legend.right && top < legend.bottom)).length;
    });
    assert.equal(outside, 0, `${azimuth}: letters are hidden`);
  }
}

/** Times below the course of a day stand at equal distances, each in the middle of its tick. */
async function checkTimes(browser, address) {
  const page = await workshop.page(browser, { viewport: { width: 2400, height: 900 } });
  await open(page, address);
  await page.locator("#course text", { hasText: "20:00" }).waitFor();
  const labels = await page.locator("#course text").evaluateAll((all) => all.filter((text) => /^\d\d:\d\d$/.test(text.textContent)).map((text) => {
    const { x, width } = text.getBBox();
    return x + width / 2;
  }));
  const apart = labels.slice(1).map((x, i) => x - labels[i]);
  assert.ok(apart.length > 3 && apart.every((d) => Math.abs(d - apart[0]) < 1.5), `${apart}`);
  await page.context().close();
}

/** While shapes are read, the page has its title and its final form. */
async function checkLoading(browser, address) {
  const page = await workshop.page(browser, { viewport: { width: 1024, height: 768 }, colorScheme: "dark" });
  let go;
  const asked = new Promise((done) => (go = done));
  await page.route("**/shape", async (route) => {
    await asked;
    await route.continue();
  });
  await page.goto(address);
  const loading = page.locator("#loading");
  await loading.filter({ hasText: "Reading the shapes of 2 organs…" }).waitFor();
  assert.equal(await page.locator("#title").textContent(), "day.json");
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  const boxes = () => page.evaluate(() => ["head", "panel", "stage", "histogram"].map((id) => document.getElementById(id).getBoundingClientRect()).map(({ x, y, width }) => [x, y, width].map(Math.round)));
  const before = await boxes();
  if (workshop.pictures) {
    await page.screenshot({ path: `${workshop.pictures}/loading.png` });
  }
  go();
  await page.waitForSelector("html[data-state=ready]");
  assert.ok(!(await loading.isVisible()), "it has been loaded");
  const after = await boxes();
  assert.deepEqual(before.slice(0, 3), after.slice(0, 3), "parts of the page have moved");
  await page.context().close();
}

/** A run that is followed says how many of its hours are computed; those to come are dashed. */
async function checkFollowed(browser) {
  writeFileSync(workshop.inFolder("slow.toml"), kRunFile.replace("paths = 256", "paths = 1048576\nreplicates = 4\nmethod = \"light_tracing\"\nthreads = 1"));
  const { program, address, ended } = await workshop.follow("slow", "--json", "slow.json");
  const page = await workshop.page(browser);
  await page.goto(address);
  const said = page.locator("#progress").filter({ hasText: /^Computing: [1-9]\d* of 1[5-7] hours, about \d+ s left$/ });
  await said.waitFor();
  const [, done, all] = /(\d+) of (\d+)/.exec(await said.textContent()).map(Number);
  await page.waitForSelector("#strip .unknown");
  const coming = await page.locator("#strip rect.unknown").count();
  assert.ok(done < all && coming > 0 && coming <= all - done + 1, `${coming} hours to come after ${done} of ${all}`);
  if (workshop.pictures) {
    await page.screenshot({ path: `${workshop.pictures}/followed.png` });
  }
  await page.waitForSelector("html[data-ended]");
  assert.ok(await page.locator("#strip .step").count() >= all, "hours are missing");
  assert.equal(await page.locator("#strip .unknown").count(), 0);
  program.kill("SIGINT");
  await ended;
  await page.context().close();
}

/** A model that grows without light is seen in its own colours, without scales and units. */
async function checkBare(browser) {
  writeFileSync(workshop.inFolder("bare.l"), "Lsystem: 1\nderivation length: 3\nAxiom: A\nA --> F(9)[+(30)F(5)]A\nendlsystem\n");
  const { program, address, ended } = await workshop.watch("grow", "bare.l");
  const page = await workshop.page(browser);
  await open(page, address);
  await page.waitForSelector("html[data-ended]");
  assert.equal(await page.locator("#legend-title").textContent(), "No light was computed");
  assert.equal(await page.locator("#quantity:visible, #beside:visible, #sides:visible").count(), 0);
  assert.equal(await page.locator("#histogram-unit").textContent(), "");
  const stage = await page.locator("#stage").boundingBox();
  assert.ok(await colouredIn(page, { x: 0, y: 0, width: stage.width, height: stage.height }) > 3000, "no plant is seen");
  program.kill("SIGINT");
  await ended;
  await page.context().close();
}

workshop.compute("day", kRunFile);
const address = workshop.report("day");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkTitle(page, address);
  await checkHint(browser, address);
  await checkTimes(browser, address);
  await checkWinds(page, address);
  await checkReset(page, address);
  await checkLoading(browser, await workshop.view("day"));
  await checkFollowed(browser);
  await checkBare(browser);
  assert.deepEqual(workshop.faults, []);
});
