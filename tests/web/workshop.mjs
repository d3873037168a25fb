// What tests of the page share: a folder, the program, a browser, and scenes of two leaves.

import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

/** The folder, program and browser of a test that was started with QUASIMC CHROMIUM PACKAGES [PICTURES]. */
export class Workshop {
  constructor(name) {
    [this.quasimc, this.executablePath, this.packages, this.pictures] = process.argv.slice(2);
    this.chromium = createRequire(path.join(this.packages, "package.json"))("playwright-core").chromium;
    this.folder = mkdtempSync(path.join(tmpdir(), `quasimc-${name}-`));
    this.programs = [];
    this.faults = [];
  }

  inFolder(name) {
    return path.join(this.folder, name);
  }

  run(...words) {
    return execFileSync(this.quasimc, words, { cwd: this.folder, stdio: ["ignore", "pipe", "inherit"] });
  }

  /** Runs a run file, which writes its result as NAME.json. @returns the result */
  compute(name, runFile) {
    writeFileSync(this.inFolder(`${name}.toml`), runFile);
    this.run("run", `${name}.toml`, "--json", `${name}.json`, "--quiet");
    return JSON.parse(readFileSync(this.inFolder(`${name}.json`)));
  }

  /** Writes the report NAME.html of NAME.json. @returns its address */
  report(name, ...words) {
    this.run("report", `${name}.json`, "-o", `${name}.html`, ...words);
    return this.address(name);
  }

  address(name) {
    return pathToFileURL(this.inFolder(`${name}.html`)).href;
  }

  /** Serves a result. @returns a promise of its address */
  async view(name, ...words) {
    const program = spawn(this.quasimc, ["view", `${name}.json`, ...words], { cwd: this.folder, stdio: ["ignore", "pipe", "ignore"] });
    this.programs.push(program);
    return (await once(createInterface({ input: program.stdout }), "line"))[0];
  }

  /** Runs NAME.toml with a page that follows it. @returns {program, address, ended} */
  follow(name, ...words) {
    return this.watch("run", `${name}.toml`, ...words);
  }

  /** Starts a command with a page that follows it. @returns {program, address, ended} */
  async watch(...words) {
    const program = spawn(this.quasimc, [...words, "--view"], { cwd: this.folder, stdio: ["ignore", "ignore", "pipe"] });
    this.programs.push(program);
    const lines = createInterface({ input: program.stderr });
    for await (const line of lines) {
      const address = line.match(/http:\S+/)?.[0];
      if (address) {
        program.stderr.resume();
        return { program, address, ended: once(program, "exit") };
      }
    }
    throw new Error(`${words.join(" ")}: no page`);
  }

  /** A browser that draws on the processor. */
  launch() {
    return this.chromium.launch({ executablePath: this.executablePath, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  }

  /** A page whose errors are kept in `faults`. */
  async page(browser, options = { viewport: { width: 1280, height: 800 } }) {
    const page = await (await browser.newContext(options)).newPage();
    page.on("pageerror", (error) => this.faults.push(String(error)));
    return page;
  }

  /** Calls a test with a browser, and leaves nothing behind. */
  async use(test) {
    const browser = await this.launch();
    try {
      await test(browser);
    } finally {
      await browser.close();
      this.programs.forEach((program) => program.kill());
      rmSync(this.folder, { recursive: true, force: true });
    }
  }
}

/** Opens an address anew, and waits until the page shows it. */
export async function open(page, address) {
  await page.goto("about:blank");
  await page.goto(address);
  await page.waitForSelector("html[data-state=ready]");
}

/** Two leaves, one above the other. @param low  size of the lower one */
export const twoLeaves = (low = 0.8) => `
[[material]]
name = "leaf"
reflectance = 0.1
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
corners = [[-${low}, -${low}, 0.5], [${low}, -${low}, 0.5], [0, ${1.1 * low}, 0.5]]
`;

/** Two leaves under a sun of three heights: a sweep. */
export const threeSuns = (paths) => `
title = "Two leaves under three suns"
bands = ["PAR"]
irradiance_unit = "W m-2"
[sweep]
source.sun.elevation_deg = [15, 45, 80]
[run]
paths = ${paths}
[[source]]
type = "directional"
name = "sun"
azimuth_deg = 180
elevation_deg = 40
irradiance_facing = 400${twoLeaves()}`;

/** A day in June. */
export const kDay = `
irradiance_unit = "W m-2"
[site]
latitude_deg = 45
longitude_deg = 0
[time]
day = "2024-06-21"
utc_offset_hours = 0
`;
