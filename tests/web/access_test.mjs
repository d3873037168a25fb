// Contrast, keys, names and motion in all states: node access_test.mjs QUASIMC CHROMIUM PACKAGES
//
// Rationale: a state that is seldom seen, such as the difference of two results in the dark, is the one
// in which texts fade or a button can't be reached.
// Expected behaviour: in light and dark, for values, errors and differences, in every tab, with pins,
// without any organ, in a dialog, on a phone and while a run is followed, every text has a contrast of
// 4.5 (WCAG 2.2, level AA), every control has a name and is reached by keys, and Tab shows where it is.

import assert from "node:assert/strict";
import { faintTexts, moving, nameless, unreachable } from "./access.mjs";
import { Workshop, kDay, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("access");

/** Two leaves above a ground, from hour to hour. */
const runFile = (reflectance) => `title = "Two leaves"
bands = ["PAR", "NIR"]${kDay}[run]
paths = 256
[ground]
material = "soil"
x = [-1, 1]
y = [-1, 1]
[[material]]
name = "soil"
reflectance = ${reflectance}
${twoLeaves()}`;

/** The states of a finished result, as addresses. */
const kStates = {
  value: "", error: "show=error", difference: "show=difference", "an hour": "time=2024-06-21T12%3A00%2B00%3A00", table: "tab=table", run: "tab=run",
  pins: "pins=%5B%221%22%2C%222%22%5D", "no organ": "values=%5B1e9%2C2e9%5D", folded: "panel=false&drawer=false",
};

async function checkState(page, name) {
  for (const [what, found] of Object.entries({ faint: faintTexts, unreachable, nameless })) {
    assert.deepEqual(await page.evaluate(found), [], `${name}: ${what}`);
  }
}

const openState = (page, hash) => open(page, `${workshop.address("two")}#${hash}`);

async function checkStates(browser) {
  for (const [size, viewport] of Object.entries({ desk: { width: 1280, height: 800 }, phone: { width: 390, height: 844 } })) {
    for (const theme of ["light", "dark"]) {
      const page = await browser.newPage({ viewport, colorScheme: theme });
      for (const [name, hash] of Object.entries(kStates)) {
        await openState(page, hash);
        await checkState(page, `${size}, ${theme}, ${name}`);
      }
      await openState(page, "");
      await page.locator("#compared-file").setInputFiles(workshop.inFolder("two.toml"));
      await page.locator("#panel [role=alert]").waitFor();
      await checkState(page, `${size}, ${theme}, a file that does not fit`);
      await page.locator("#compared-file").setInputFiles(workshop.inFolder("other.json"));
      await page.locator("#compared-file + .chip").waitFor();
      await checkState(page, `${size}, ${theme}, a file that fits`);
      if (size === "desk") {
        await page.getByRole("button", { name: "Keys" }).click();
        await checkState(page, `${theme}, keys`);
      }
      await page.close();
    }
  }
}

/** The element that has the focus, and whether it shows it. */
const kFocus = () => {
  const element = document.activeElement;
  const { outlineStyle, outlineWidth, stroke, strokeWidth } = getComputedStyle(element);
  const isOutlined = outlineStyle !== "none" && parseFloat(outlineWidth) >= 2;
  const isStroked = element instanceof SVGElement && stroke !== "none" && parseFloat(strokeWidth) >= 2; // bars of charts
  return { name: element === document.body ? "" : element.id || element.outerHTML.slice(0, 90), isShown: isOutlined || isStroked };
};

/** Tab goes through the page, and every stop is seen. */
async function checkTab(page) {
  await openState(page, "");
  const stops = new Set();
  for (let i = 0; i < 120; ++i) {
    await page.keyboard.press("Tab");
    const { name, isShown } = await page.evaluate(kFocus);
    if (name === "" || stops.has(name)) {
      break;
    }
    assert.ok(isShown, `the focus is not seen: ${name}`);
    stops.add(name);
  }
  for (const id of ["panel-button", "find", "save-button", "theme-button", "keys-button", "quantity", "canvas", "strip"]) {
    assert.ok(stops.has(id), `Tab does not reach ${id}: ${[...stops].join("\n")}`);
  }
}

/** Nothing moves where reduced motion is asked for. */
async function checkMotion(browser) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, reducedMotion: "reduce" });
  await openState(page, "");
  assert.deepEqual(await page.evaluate(moving), []);
  assert.equal(await page.getByRole("button", { name: "Play" }).count(), 0, "play is offered");
  await page.close();
}

async function checkLive(browser) {
  const { program, address, ended } = await workshop.follow("two", "--json", "live.json");
  for (const theme of ["light", "dark"]) {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: theme });
    await open(page, address);
    await checkState(page, `${theme}, followed`);
    await page.close();
  }
  program.kill();
  await ended;
}

/** The checks find what they are for. */
async function checkTheChecks(page) {
  await openState(page, "");
  await page.evaluate(() => {
    const add = (tag, text, style, attributes = {}) => {
      const made = Object.assign(document.createElement(tag), { textContent: text });
      Object.assign(made.style, style);
      Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
      document.getElementById("head").append(made);
    };
    add("p", "faint", { color: "rgb(190, 190, 190)", transition: "color 1s" });
    add("div", "by mouse only", {}, { role: "button" });
    add("button", "", { width: "9px", height: "9px" });
  });
  for (const [found, text] of [[faintTexts, /faint/], [unreachable, /by mouse only/], [nameless, /9px/], [moving, /faint/]]) {
    const all = await page.evaluate(found);
    assert.equal(all.length, 1, all.join("\n"));
    assert.match(all[0], text);
  }
}

workshop.compute("two", runFile(0.1));
workshop.compute("other", runFile(0.5));
workshop.report("two", "--minus", "other.json");
await workshop.use(async (browser) => {
  await checkStates(browser);
  const page = await workshop.page(browser);
  await checkTab(page);
  await checkTheChecks(page);
  await checkMotion(browser);
  await checkLive(browser);
  assert.deepEqual(workshop.faults, []);
});
