// Contrast, keys, names and motion in all states: node access_test.mjs QUASIMC CHROMIUM PACKAGES
//
// Rationale: a state that is seldom seen, such as the difference of two results in the dark, is the one
// in which texts fade or a button can't be reached.
// Expected behaviour: in light and dark, for values, errors and differences, in every tab, with pins,
// without any organ, in a dialog, on a phone and while a run is followed, every text has a contrast of
// 4.5 (WCAG 2.2, level AA), every control has a name and is reached by keys, and Tab shows where it is.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";
import { faintTexts, moving, nameless, unreachable } from "./access.mjs";

const [quasimc, executablePath, packages] = process.argv.slice(2);
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "quasimc-access-"));
const run = (...words) => execFileSync(quasimc, words, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });

/** Two leaves above a ground, from hour to hour. */
const runFile = (reflectance, json) => `title = "Two leaves"
bands = ["PAR", "NIR"]
irradiance_unit = "W m-2"
[site]
latitude_deg = 45
longitude_deg = 0
[time]
day = "2024-06-21"
utc_offset_hours = 0
[run]
paths = 256
[output]
json = "${json}"
[ground]
material = "leaf"
x = [-1, 1]
y = [-1, 1]
[[material]]
name = "leaf"
reflectance = ${reflectance}
transmittance = 0.1
[[organ]]
name = "upper"
labels = { kind = "blade", plant = "1" }
material = "leaf"
shape = "triangle"
corners = [[-0.5, -0.5, 1], [0.5, -0.5, 1], [0, 0.6, 1]]
[[organ]]
name = "lower"
labels = { kind = "stem", plant = "1" }
material = "leaf"
shape = "triangle"
corners = [[-0.8, -0.8, 0.5], [0.8, -0.8, 0.5], [0, 0.9, 0.5]]
`;

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

async function open(page, hash) {
  await page.goto("about:blank");
  await page.goto(`${pathToFileURL(path.join(folder, "two.html")).href}#${hash}`);
  await page.waitForSelector("html[data-state=ready]");
}

async function checkStates(browser) {
  for (const [size, viewport] of Object.entries({ desk: { width: 1280, height: 800 }, phone: { width: 390, height: 844 } })) {
    for (const theme of ["light", "dark"]) {
      const page = await browser.newPage({ viewport, colorScheme: theme });
      for (const [name, hash] of Object.entries(kStates)) {
        await open(page, hash);
        await checkState(page, `${size}, ${theme}, ${name}`);
      }
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
  await open(page, "");
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
  await open(page, "");
  assert.deepEqual(await page.evaluate(moving), []);
  assert.equal(await page.getByRole("button", { name: "Play" }).count(), 0, "play is offered");
  await page.close();
}

async function checkLive(browser) {
  const program = spawn(quasimc, ["run", "two.toml", "--view", "--json", "live.json"], { cwd: folder, stdio: ["ignore", "ignore", "pipe"] });
  try {
    let address = "";
    for await (const line of createInterface({ input: program.stderr })) {
      address = line.match(/http:\S+/)?.[0] ?? "";
      if (address) {
        break;
      }
    }
    program.stderr.resume();
    for (const theme of ["light", "dark"]) {
      const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: theme });
      await page.goto(address);
      await page.waitForSelector("html[data-state=ready]");
      await checkState(page, `${theme}, followed`);
      await page.close();
    }
  } finally {
    program.kill();
    await once(program, "exit");
  }
}

/** The checks find what they are for. */
async function checkTheChecks(page) {
  await open(page, "");
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

const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  writeFileSync(path.join(folder, "two.toml"), runFile(0.1, "two.json"));
  writeFileSync(path.join(folder, "other.toml"), runFile(0.5, "other.json"));
  run("run", "two.toml", "--quiet");
  run("run", "other.toml", "--quiet");
  run("report", "two.json", "--minus", "other.json", "-o", "two.html");
  await checkStates(browser);
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await checkTab(page);
  await checkTheChecks(page);
  await checkMotion(browser);
  await checkLive(browser);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
