// examples/03-coupled in a real browser: node example_test.mjs ENVIRONMENT FOLDER CHROMIUM PACKAGES [PICTURES]
//
// Rationale: what the manual tells people to start must start, and show the plant that grows.
// Expected behaviour: watch.sh prints an address; the page there follows to the last step, with as
// many organs as the plant says it has leaves, and goes back to an earlier one; Enter ends it.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { countPixels, pixelsOf } from "./pixels.mjs";

const [environment, example, executablePath, packages, pictures] = process.argv.slice(2);
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "quasimc-example-"));
const kSteps = 4;

/** Resolves with what `find` finds in what a process says. */
function until(child, said, find) {
  return new Promise((done, fail) => {
    const look = () => {
      const found = find(said());
      if (found) {
        done(found);
      }
    };
    child.stdout.on("data", look);
    child.stderr.on("data", look);
    child.once("exit", (code) => fail(new Error(`it ended with ${code}, having said:\n${said()}`)));
    look();
  });
}

async function check(browser, child, said) {
  const address = await until(child, said, (text) => /view: (http:\S+\/)\n/.exec(text)?.[1]);
  await until(child, said, (text) => text.includes("press Enter"));
  const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(address);
  child.stdin.write("\n");
  await page.waitForSelector("html[data-state=ready]");
  await until(child, said, (text) => text.includes("All steps are there"));
  await page.waitForSelector(`html[data-frame="${kSteps}"]`);
  const leaves = [...said().matchAll(/^step +\d+: .* (\d+) leaves/gm)].map((match) => Number(match[1]));
  assert.equal(leaves.length, kSteps);
  const checkFrame = async (frame) => {
    await page.waitForSelector(`html[data-frame="${frame}"]`);
    assert.match(await page.locator("#subtitle").textContent(), new RegExp(`^${leaves[frame - 1]} organs?,`));
  };
  await checkFrame(kSteps);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const pixels = await pixelsOf(page, await page.locator("#canvas").screenshot());
  const isColored = (red, green, blue) => Math.max(red, green, blue) - Math.min(red, green, blue) > 60;
  assert.ok(countPixels(pixels, isColored) > 2000, "no plant is seen");
  if (pictures) {
    await page.screenshot({ path: path.join(pictures, "example.png") });
  }
  await page.locator("#time").fill("1");
  await checkFrame(2);
  assert.deepEqual(faults, []);
  child.removeAllListeners("exit");
  child.stdin.end("\n");
  await page.waitForSelector("html[data-ended]");
}

cpSync(example, folder, { recursive: true });
const child = spawn(path.join(folder, "watch.sh"), ["--steps", String(kSteps), "--program", environment],
  { stdio: ["pipe", "pipe", "pipe"] });
let text = "";
const status = new Promise((done) => child.once("close", done));
child.stdout.on("data", (bytes) => (text += bytes));
child.stderr.on("data", (bytes) => (text += bytes));
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  await check(browser, child, () => text);
  assert.equal(await status, 0, text);
} finally {
  await browser.close();
  child.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}
