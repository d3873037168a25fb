// How the page looks and is used: node looks_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: who sees little, sees no colours, has no mouse or reads from the screen by ear must be able
// to use the page, in light and dark.
// Expected behaviour: keys turn the scene as they say, every control has a name, every text stands out
// from what is behind it, and where light comes from is shown as long as it is asked for.

import assert from "node:assert/strict";
import path from "node:path";
import { faintTexts } from "./access.mjs";
import { countPixels, pixelsOf } from "./pixels.mjs";
import { Workshop, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("looks");
const { pictures } = workshop;

/** Two leaves under sun, sky and a lamp, to a target: a page with all it can have. */
const kRunFile = `
title = "Two leaves"
bands = ["PAR", "NIR"]
length_unit = "m"
irradiance_unit = "W m-2"
[run]
paths = 256
max_paths = 4096
[[source]]
type = "sun"
name = "sun"
azimuth_deg = 120
elevation_deg = 50
irradiance_facing = [500, 400]
[[source]]
type = "sky"
name = "sky"
model = "cie_overcast"
irradiance_horizontal = [100, 80]
[[source]]
type = "point"
name = "lamp"
position = [0.9, 0.9, 1.4]
power = [10, 10]${twoLeaves(1)}`;

/** The canvas at rest. */
async function canvasPixels(page) {
  await page.waitForTimeout(400); // thinned out and coarse while it moves, whole a quarter of a second after
  await page.waitForFunction(() => document.getElementById("canvas").dataset.rest === "yes");
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return pixelsOf(page, await page.locator("#canvas").screenshot());
}

/** The part of the pixels that differ. */
function difference(one, other) {
  let count = 0;
  for (let i = 0; i < one.data.length; i += 4) {
    count += [0, 1, 2].some((k) => Math.abs(one.data[i + k] - other.data[i + k]) > 24) ? 1 : 0;
  }
  return (4 * count) / one.data.length;
}

const leafPixels = (pixels) => countPixels(pixels, (red, green, blue) => Math.max(red, green, blue) - Math.min(red, green, blue) > 60);

async function checkKeys(page) {
  await page.locator("#directions").uncheck();
  await page.locator("#canvas").focus();
  const press = async (key, times = 1) => {
    for (let i = 0; i < times; ++i) {
      await page.keyboard.press(key);
    }
    return canvasPixels(page);
  };
  const home = await press("Home");
  assert.ok(leafPixels(home) > 1000, "nothing is seen");
  for (const key of ["ArrowLeft", "ArrowUp"]) {
    assert.ok(difference(home, await press(key)) > 0.01, `${key} does nothing`);
    await press("Home");
  }
  assert.ok(difference(home, await press("ArrowLeft", 36)) < 0.01, "36 steps of 10 degrees are once around");
  await press("ArrowRight", 3);
  assert.ok(difference(home, await press("ArrowLeft", 3)) < 0.005, "what goes right does not come back left");
  await press("ArrowDown", 2);
  assert.ok(difference(home, await press("ArrowUp", 2)) < 0.005);
  const near = await press("+", 2);
  assert.ok(leafPixels(near) > 1.5 * leafPixels(home), "+ does not come nearer");
  assert.ok(difference(home, await press("-", 2)) < 0.005, "- does not go away as far");
  await press("ArrowUp", 12);
  const box = await page.locator("#canvas").boundingBox();
  const [x, y] = (await page.getAttribute("#canvas", "data-shift")).split(",").map(Number);
  await page.mouse.move(box.x + box.width / 2 + x, box.y + box.height / 2 + y);
  await page.waitForSelector("#tip:not([hidden])");
  assert.equal(await page.locator("#tip b").textContent(), "upper", "from above the upper leaf is in front");
  await page.mouse.move(2, 2);
  await press("Home");
  await page.locator("#directions").check();
}

/** Everything that can be used has a name, as it is told to who reads by ear. */
async function checkNames(page) {
  const told = await page.locator("body").ariaSnapshot();
  const kRoles = /^\s*- (button|combobox|listbox|slider|radio|radiogroup|tab|searchbox|checkbox|textbox|application|img)\b(.*)$/gm;
  const found = [...told.matchAll(kRoles)];
  for (const role of ["combobox", "radio", "radiogroup", "tab", "checkbox", "button", "application"]) {
    assert.ok(found.some((match) => match[1] === role), `no ${role}:\n${told}`);
  }
  found.forEach(([line, , rest]) => assert.match(rest, /^ "[^"]+"/, `no name: ${line}`));
}

async function checkColours(page) {
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const papers = [];
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    await page.waitForSelector(`html[data-theme=${colorScheme}]`);
    papers.push(await paper());
    assert.deepEqual(await page.evaluate(faintTexts), [], colorScheme);
    assert.ok(leafPixels(await canvasPixels(page)) > 1000, `${colorScheme}: no leaves are seen`);
    if (pictures) {
      await page.screenshot({ path: path.join(pictures, `looks-${colorScheme}.png`), fullPage: true });
    }
  }
  assert.notEqual(papers[0], papers[1]);
  await page.emulateMedia({ colorScheme: "light" });
}

/** The sky, the sun and the lamp can be seen, and left out. */
async function checkLights(page) {
  const amber = (pixels) => countPixels(pixels, (red, green, blue) => red > 170 && green > 80 && green < 190 && blue < 60);
  await page.getByRole("button", { name: "Front" }).click();
  const usual = await canvasPixels(page);
  await page.locator("#dome").check();
  const withDome = await canvasPixels(page);
  assert.ok(difference(usual, withDome) > 0.05, "no dome is seen");
  await page.locator("#dome").uncheck();
  await page.locator("#directions").uncheck();
  const none = await canvasPixels(page);
  assert.ok(amber(usual) > amber(none) + 100, `sun and lamp: ${amber(usual)}, ${amber(none)}`);
  await page.locator("#directions").check();
  assert.ok(difference(usual, await canvasPixels(page)) < 0.005);
  assert.match(await page.locator("#disc").textContent(), /Sun 50° high, SE/);
}

/** What is printed has the picture, the charts and the tables, and nothing to press. */
async function checkPrint(page) {
  await page.pdf({ format: "A4", ...(pictures ? { path: path.join(pictures, "print.pdf") } : {}) });
  await page.emulateMedia({ media: "print" });
  for (const selector of ["#panel details >> nth=0", "#canvas", "#find", "#time"]) {
    assert.ok(!(await page.locator(selector).isVisible()), `${selector} is printed`);
  }
  for (const selector of ["#printed", "#legend", "#histogram svg", "#profile svg", "#table table", "#report table"]) {
    assert.ok(await page.locator(selector).first().isVisible(), `${selector} is not printed`);
  }
  const boxOf = (selector) => page.locator(selector).boundingBox();
  const [legend, charts] = [await boxOf("#legend"), await boxOf("#charts")];
  assert.ok(legend.y + legend.height <= charts.y, `the legend ends at ${legend.y + legend.height}, and charts begin at ${charts.y}`);
  const source = await page.locator("#printed").getAttribute("src");
  const leaves = leafPixels(await pixelsOf(page, Buffer.from(source.slice(source.indexOf(",") + 1), "base64")));
  assert.ok(leaves > 1000, `the picture has ${leaves} pixels of leaves`);
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "looks-print.png"), fullPage: true });
  }
  await page.emulateMedia({ media: "screen" });
}

/** A run under a sun from above. @param leaves  [name, corners] */
function sunnyRun(leaves) {
  const organs = leaves.map(([name, corners]) => `[[organ]]
name = "${name}"
material = "leaf"
shape = "triangle"
corners = ${JSON.stringify(corners)}
`);
  return `bands = ["PAR"]
irradiance_unit = "W m-2"
[run]
paths = 65536
[output]
json = "run.json"
[[source]]
type = "directional"
name = "sun"
direction = [0, 0, -1]
irradiance_facing = 1
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
${organs.join("")}`;
}

/** Charts of a single organ, and of one that is far brighter than all others, show what there is. */
async function checkOddCharts(page) {
  const show = async (leaves) => {
    workshop.compute("run", sunnyRun(leaves));
    await open(page, workshop.report("run"));
  };
  await show([["only", [[-1, -1, 1], [1, -1, 1], [0, 1, 1]]]]);
  for (const chart of ["#histogram", "#profile"]) {
    assert.equal(await page.locator(`${chart} .bar`).count(), 1);
    const { width, height } = await page.locator(`${chart} .bar`).boundingBox();
    assert.ok(width > 8 && height > 50, `${chart}: ${width} x ${height}`);
  }
  const steep = (x) => [[x, 0, 0], [x + 0.02 * (1 + x / 5), 0, 9], [x, 9, 0]];
  await show([...[0, 2, 4, 6].map((x) => [`steep ${x}`, steep(x)]), ["bright", [[-3, 0, 0], [-2.9, 0, 0], [-3, 0.1, 0]]]]);
  assert.match(await page.locator("#histogram").textContent(), /more/);
  const labels = await page.locator("#histogram .hit").evaluateAll((bars) => bars.map((bar) => bar.getAttribute("aria-label")));
  assert.ok(labels.length > 3, `those that are alike are told apart: ${labels}`);
  assert.match(labels.at(-1), /^more than [^:]*, up to 0\.[4-9][^:]*: 1 organ,/);
  assert.match(await page.locator("#legend").textContent(), /▲ up to 0\.[4-9]/);
}

workshop.compute("two", kRunFile);
workshop.report("two");
await workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  await open(page, workshop.address("two"));
  await checkKeys(page);
  await checkNames(page);
  await checkColours(page);
  await checkLights(page);
  await checkPrint(page);
  await checkOddCharts(page);
  assert.deepEqual(workshop.faults, []);
});
