// What one does with the page: node use_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: what is compared, played, kept in the address and saved must be what is seen, on a desk
// and on a phone, and colours must mean what the legend says.
// Expected behaviour: plants fill the free part of the scene; letters, cards and charts name the same
// organs; the address restores the view; a saved picture shows what the page shows.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { countPixels, pixelsOf } from "./pixels.mjs";
import { kDay, Workshop, open as openAt } from "./workshop.mjs";

const workshop = new Workshop("use");
const { folder, pictures } = workshop;
const address = workshop.address("day");

/** Twelve leaves in a spiral around a stem, from hour to hour. */
function runFile() {
  const leaves = Array.from({ length: 12 }, (_, i) => {
    const [x, y, z] = [Math.cos(2.4 * i), Math.sin(2.4 * i), 0.3 + 0.15 * i];
    const across = (k) => [0.25 * x - k * 0.15 * y, 0.25 * y + k * 0.15 * x, z];
    const corners = [[0.05 * x, 0.05 * y, z], across(1), [0.8 * x, 0.8 * y, z + 0.2], [0.05 * x, 0.05 * y, z], [0.8 * x, 0.8 * y, z + 0.2], across(-1)];
    const vertices = corners.map((p) => `[${p.map((v) => v.toFixed(4)).join(", ")}]`).join(", ");
    return `[[organ]]\nname = "leaf ${i + 1}"\nlabels = { kind = "leaf" }\nmaterial = "leaf"\nshape = "mesh"\nvertices = [${vertices}]\nfaces = [[0, 1, 2], [3, 4, 5]]\n`;
  });
  return `title = "A plant of twelve leaves"
bands = ["PAR"]${kDay}[run]
paths = 2048
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
${leaves.join("")}`;
}

const leafAt = ({ width, data }, x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)];
const isLeaf = ([red, green, blue]) => Math.max(red, green, blue) - Math.min(red, green, blue) > 45;

/** The box of the leaves in a picture. */
function leafBox(pixels) {
  const box = { left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity };
  for (let y = 0; y < pixels.height; ++y) {
    for (let x = 0; x < pixels.width; ++x) {
      if (isLeaf(leafAt(pixels, x, y))) {
        Object.assign(box, { left: Math.min(box.left, x), right: Math.max(box.right, x), top: Math.min(box.top, y), bottom: Math.max(box.bottom, y) });
      }
    }
  }
  return box;
}

async function open(page, hash = "") {
  await openAt(page, address + hash);
  await page.waitForTimeout(800); // at rest
}

/** The scene alone: without what covers it. */
async function scenePixels(page) {
  await page.evaluate(() => ["legend", "disc", "hint", "before", "behind"].forEach((id) => (document.getElementById(id).style.visibility = "hidden")));
  return pixelsOf(page, await page.locator("#canvas").screenshot());
}

/** The plants fill what is free, and are not cut off. */
async function checkFraming(browser) {
  for (const [width, height, isMobile] of [[1280, 800, false], [390, 844, true], [720, 1280, false]]) {
    const context = await browser.newContext({ viewport: { width, height }, isMobile });
    const page = await context.newPage();
    await open(page);
    assert.equal(await page.evaluate(() => innerWidth), width, "made for another width");
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "the page is wider than the window");
    const pixels = await scenePixels(page);
    const box = leafBox(pixels);
    const name = `${width} x ${height}: ${JSON.stringify(box)} of ${pixels.width} x ${pixels.height}`;
    assert.ok(box.left > 2 && box.right < pixels.width - 3 && box.top > 2 && box.bottom < pixels.height - 3, `cut off, ${name}`);
    const fill = Math.max((box.right - box.left) / pixels.width, (box.bottom - box.top) / pixels.height);
    assert.ok(fill > 0.6, `small, ${name}`);
    await context.close();
  }
}

const kLetters = ["A", "B", "C"];

async function checkPins(page, result) {
  await open(page);
  for (const name of ["leaf 12", "leaf 1", "leaf 6"]) {
    await page.keyboard.press("/");
    await page.keyboard.type(name);
    await page.waitForSelector("#hits [role=option]");
    const hit = page.getByRole("option", { name: new RegExp(`^${name}\\D`) });
    await hit.dispatchEvent("pointerdown");
    await page.waitForFunction((own) => [...document.querySelectorAll("#cards h3")].some(({ textContent }) => textContent === own), name);
  }
  assert.deepEqual(await page.locator("#badges .badge").allTextContents(), kLetters);
  assert.deepEqual(await page.locator("#cards article .badge").allTextContents(), kLetters);
  assert.equal(await page.locator("#legend .arrow").count(), 3);
  assert.equal(await page.locator("#histogram path").count(), 3, "triangles of pinned organs");
  await page.waitForFunction(() => document.querySelectorAll("#course .letter").length === 3);
  // The differences are those of the result.
  const means = [11, 0, 5].map((i) => result.total.organs[i].absorbed_flux_density.PAR);
  const compared = await page.locator("#cards .compared tbody tr td:last-child").allTextContents();
  means.slice(1).forEach(({ mean, standard_error: error }, i) => {
    const difference = mean - means[0].mean;
    const isClear = Math.abs(difference) >= 1.96 * Math.hypot(error, means[0].standard_error);
    const shown = Number(/^([+−])([\d.]+) ± [\d.]+ %$/.exec(compared[i + 1])?.slice(1).join("").replace("−", "-"));
    assert.ok(isClear ? Math.abs(shown - (100 * difference) / means[0].mean) < 1.1 : compared[i + 1] === "no clear difference", `${compared[i + 1]}: ${difference}`);
  });
  assert.equal(await page.locator("#table tr.pinned").count(), 0);
  await page.getByRole("tab", { name: "Table" }).click();
  assert.equal(await page.locator("#table tr.pinned").count(), 3);
  await page.getByRole("tab", { name: "Charts" }).click();
}

async function checkPlay(page) {
  await open(page);
  const title = () => page.locator("#time-title").textContent();
  assert.equal(await title(), "Sum of the day");
  await page.locator("#title").click();
  await page.keyboard.press(" ");
  await page.waitForFunction(() => /^\d\d:00$/.test(document.querySelector("#time-title").textContent));
  const first = await title();
  await page.waitForFunction((before) => document.querySelector("#time-title").textContent !== before, first);
  assert.ok(await page.locator("#same").isChecked(), "played on one scale");
  const scale = await page.locator("#legend-scale").textContent();
  await page.keyboard.press(" ");
  const stopped = await title();
  await page.waitForTimeout(1600);
  assert.equal(await title(), stopped, "it plays on");
  await page.keyboard.press("]");
  await page.waitForFunction((before) => document.querySelector("#time-title").textContent !== before, stopped);
  assert.equal((await page.locator("#legend-scale").textContent()).replace(/▲.*$/, ""), scale.replace(/▲.*$/, ""), "another scale");
}

/** The address restores what was chosen; a broken one does no harm. */
async function checkAddress(page) {
  await open(page);
  await page.getByRole("radio", { name: "Hours" }).click();
  await page.getByRole("radio", { name: "Error" }).click();
  await page.keyboard.press("/");
  await page.keyboard.type("leaf 7");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Top" }).click();
  await page.getByRole("tab", { name: "Table" }).click();
  await page.waitForFunction(() => location.hash.includes("tab=table"));
  const seen = async () => [await page.locator("#time-title").textContent(), await page.locator("#legend").textContent(), await page.locator("#cards h3").allTextContents(),
    await page.locator("#disc .eye").getAttribute("transform"), await page.locator("#table").isVisible()];
  const before = await seen();
  await open(page, new URL(page.url()).hash);
  assert.deepEqual(await seen(), before);
  for (const hash of ["#%", "#view=%7B%7D", "#pins=7&map=none&time=never&show=all", "#ends=[1&quantity=x&labels=[]", "#view=[1]&layer=3&values={}"]) {
    await open(page, hash);
    assert.equal(await page.locator("#time-title").textContent(), "Sum of the day", hash);
    assert.match(await page.locator("#shown").textContent(), /^12 of 12/, hash);
  }
}

async function download(page, name) {
  await page.getByRole("button", { name: "Save" }).click();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("menuitem", { name }).click()]);
  return readFileSync(await file.path());
}

/** The saved picture is what is seen, twice as large; the table has the numbers. */
async function checkSaved(page, result) {
  await open(page);
  const text = String(await download(page, /^Table/));
  const rows = text.trim().split("\n").map((line) => line.split(","));
  assert.equal(rows.length, 13);
  result.total.organs.forEach((organ, i) => {
    const { mean } = organ.absorbed_flux_density.PAR;
    assert.ok(Math.abs(Number(rows[i + 1][5]) * 1e6 - mean) < 1e-5 * mean && rows[i + 1][1] === organ.name, rows[i + 1].join());
  });
  const png = await download(page, /^Picture/);
  if (pictures) { writeFileSync(path.join(pictures, "saved.png"), png); }
  const saved = await pixelsOf(page, png);
  await page.waitForTimeout(500);
  const seen = await scenePixels(page);
  assert.deepEqual([saved.width, saved.height], [2 * seen.width, 2 * seen.height]);
  let [same, any] = [0, 0];
  for (let y = 0; y < seen.height; ++y) {
    for (let x = Math.floor(seen.width / 4); x < seen.width - 180; ++x) { // beside legend and sky
      const [one, other] = [leafAt(seen, x, y), leafAt(saved, 2 * x, 2 * y)];
      if (isLeaf(one)) {
        ++any;
        same += one.every((value, k) => Math.abs(value - other[k]) < 40) ? 1 : 0;
      }
    }
  }
  assert.ok(any > 5000 && same > 0.9 * any, `${same} of ${any} pixels are alike`);
  const bar = Array.from({ length: saved.height }, (_, y) => leafAt(saved, 46, y)).filter(isLeaf);
  assert.ok(bar.length > 150, "the picture has no legend");
}

/** What is read off the legend is the value: colours of organs against their numbers. */
async function checkReading(page) {
  const high = 60;
  await open(page, `#ends=${encodeURIComponent(JSON.stringify([0, high]))}&directions=false`);
  const map = JSON.parse(await page.locator("#colors").textContent()).viridis;
  const pixels = await scenePixels(page);
  const box = await page.locator("#canvas").boundingBox();
  const partOf = (color) => {
    const far = (rgb) => rgb.reduce((sum, value, k) => sum + (value - color[k]) ** 2, 0);
    return map.reduce((best, rgb, i) => (far(rgb) < far(map[best]) ? i : best), 0) / (map.length - 1);
  };
  const errors = [];
  for (let i = 0; i < 400 && errors.length < 80; ++i) { // a grid of points
    const [x, y] = [Math.floor(pixels.width * (0.25 + 0.5 * ((i * 0.618) % 1))), Math.floor(pixels.height * (0.05 + 0.9 * (i / 400)))];
    if (isLeaf(leafAt(pixels, x, y))) {
      await page.mouse.move(box.x + x, box.y + y);
      const number = await page.evaluate(() => (document.querySelector("#tip").hidden ? "" : document.querySelector("#tip .number").textContent));
      const value = Number(/^[\d.]+/.exec(number)?.[0]);
      if (value > 0) {
        errors.push(Math.abs(partOf(leafAt(pixels, x, y)) - Math.min(1, value / high)));
      }
    }
  }
  errors.sort((a, b) => a - b);
  const median = errors[Math.floor(errors.length / 2)];
  console.log(`read off the legend: median ${(100 * median).toFixed(1)} % of the scale, ${errors.length} points`);
  assert.ok(errors.length > 30 && median < 0.03, `${errors.length} points, median ${median}`);
}

/** Another result taken away: the difference of each organ, grey where its error is larger. */
async function checkDifference(page, result) {
  const makeOther = (name, change) => {
    const other = workshop.compute(name, change(runFile()));
    workshop.run("report", "day.json", "--minus", `${name}.json`, "-o", `${name}.html`);
    return other;
  };
  const grey = async (name) => {
    await openAt(page, `${workshop.address(name)}#show=difference&pins=["12"]&directions=false`);
    await page.waitForTimeout(800);
    return countPixels(await scenePixels(page), (red, green, blue) => Math.abs(red - 196) < 7 && Math.abs(green - 201) < 7 && Math.abs(blue - 198) < 7);
  };
  const bright = makeOther("bright", (text) => text.replace("reflectance = 0.1", "reflectance = 0.5"));
  const clear = await grey("bright");
  assert.match(await page.locator("#legend-title").textContent(), /^This result − A plant of twelve leaves$/);
  const shown = Number(/^[\d.]+/.exec(await page.locator("#cards p.number").textContent())[0]) * 1e6;
  const [one, other] = [result, bright].map(({ total }) => total.organs[11].absorbed_flux_density.PAR);
  const error = Math.hypot(one.standard_error, other.standard_error);
  assert.ok(Math.abs(shown - (one.mean - other.mean)) < 0.6 * error + 1e-3 * shown, `${shown}: ${one.mean} - ${other.mean}`);
  makeOther("again", (text) => text.replace("paths = 2048", "paths = 2048\nseed = 2"));
  const unclear = await grey("again");
  assert.ok(unclear > 3000 && clear < 0.2 * unclear, `grey pixels: ${clear} and ${unclear}`);
}

/** Contrast of all pairs of tokens that meet, WCAG 2.2 AA. */
async function checkTokens(page) {
  const kPairs = [["ink", "panel", 4.5], ["ink", "stage", 4.5], ["ink", "stage2", 4.5], ["ink", "hover", 4.5], ["soft", "panel", 4.5], ["soft", "stage", 4.5], ["soft", "stage2", 4.5], ["soft", "hover", 4.5],
    ["accent", "panel", 4.5], ["accent", "tint", 4.5], ["on-accent", "accent", 4.5], ["warn", "warn-bg", 4.5], ["bad", "panel", 4.5], ["ink", "tint", 4.5],
    ["edge", "panel", 3], ["faint", "panel", 3], ["faint", "stage", 3], ["focus", "panel", 3], ["focus", "stage", 3], ["bar", "panel", 3], ["arc", "stage", 3], ["arc", "stage2", 3]];
  for (const theme of ["light", "dark"]) {
    await open(page, `#theme=${theme}`);
    const found = await page.evaluate((pairs) => {
      const style = getComputedStyle(document.documentElement);
      const luminance = (name) => [1, 3, 5].reduce((sum, at, k) => {
        const part = parseInt(style.getPropertyValue(`--${name}`).trim().slice(at, at + 2), 16) / 255;
        return sum + [0.2126, 0.7152, 0.0722][k] * (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
      }, 0);
      return pairs.map(([one, other]) => {
        const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
        return (high + 0.05) / (low + 0.05);
      });
    }, kPairs);
    kPairs.forEach(([one, other, least], i) => assert.ok(found[i] >= least, `${theme}: ${one} on ${other}: ${found[i]}`));
  }
}

/** From above the highest leaf is seen, whichever way it points: finding it leaves the view as it is. */
async function checkFind(page) {
  await openAt(page, address);
  await page.locator("#canvas").focus();
  await page.keyboard.press("6");
  await page.keyboard.press("/");
  await page.keyboard.type("leaf 12");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#cards article");
  await page.waitForFunction(() => location.hash.includes("pins"));
  const view = await page.evaluate(() => JSON.parse(new URLSearchParams(location.hash.slice(1)).get("view")));
  assert.deepEqual([view.azimuth, view.elevation], [180, 90]);
}

const result = workshop.compute("day", runFile());
workshop.report("day");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await checkFraming(browser);
  await checkPins(page, result);
  await checkPlay(page);
  await checkAddress(page);
  await checkSaved(page, result);
  await checkReading(page);
  await checkFind(page);
  await checkTokens(page);
  await checkDifference(page, result);
  assert.deepEqual(workshop.faults, []);
});
