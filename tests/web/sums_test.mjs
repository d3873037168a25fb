// What the page says of sums: node sums_test.mjs QUASIMC CHROMIUM PACKAGES [PICTURES]
//
// Rationale: the largest number of the page is the one that is published; a right number with wrong words is false.
// Expected behaviour: it is of all organs, or of those that are shown: with the error of a group of the result that has
// just these, else without one. Parts of the light that enters are given in a periodic cell alone, and light goes back to
// the sky only where a ground takes the rest; elsewhere there is the mean per area. Parts have the errors of the result. What has no
// sum over a day is shown at its brightest hour.

import assert from "node:assert/strict";
import { Workshop, kDay, open, twoLeaves } from "./workshop.mjs";

const workshop = new Workshop("sums");

const runFile = (more = "", run = "") => `
title = "Two leaves"
bands = ["PAR"]
irradiance_unit = "W m-2"
[run]
paths = 256
${run}
[[source]]
type = "sky"
model = "cie_overcast"
irradiance_horizontal = 100
${more}
${twoLeaves()}`;

const kCell = `[cell]
x = [-1, 1]
y = [-1, 1]
`;
const kGround = `[ground]
material = "leaf"
`;

const textOf = async (page) => (await page.locator("#headline").textContent()).replaceAll("\u00a0", " ");
const numberOf = async (page) => (await textOf(page)).match(/([\d.,]+)(?: ± ([\d.,]+))? W m⁻²of ground/).slice(1).map((text) => (text === undefined ? null : Number(text.replace(/,/g, ""))));
const press = (page, value) => page.getByRole("group", { name: "kind", exact: true }).getByRole("button", { name: value }).click();
const groupOf = (result, value, quantity = "absorbed_flux") => result.groups.find((group) => group.value === value)[quantity].PAR;

/** Number and error are those of an estimate, over the 4 square metres of the cell. */
function checkIs([mean, error], estimate) {
  assert.ok(Math.abs(mean - estimate.mean / 4) <= estimate.standard_error / 4, `${mean}: ${estimate.mean / 4}`);
  assert.ok(Math.abs(error / (estimate.standard_error / 4) - 1) < 0.3, `${error}: ${estimate.standard_error / 4}`);
}

async function checkShown(page, result) {
  await open(page, workshop.address("grouped"));
  assert.match(await textOf(page), /^All organs absorb\d/);
  checkIs(await numberOf(page), groupOf(result, ""));
  await press(page, /^stem/);
  await page.waitForFunction(() => document.querySelector("#headline").textContent.startsWith("Organs of kind stem absorb"));
  checkIs(await numberOf(page), groupOf(result, "stem"));
  await press(page, /^blade/); // both: all organs again
  await page.waitForFunction(() => document.querySelector("#headline").textContent.startsWith("All organs absorb"));
}

/** Without a group the sum is known, its error not. */
async function checkWithoutGroups(page, result) {
  await open(page, `${workshop.address("plain")}#labels=${encodeURIComponent('{"kind":["stem"]}')}`);
  await page.waitForFunction(() => document.querySelector("#headline").textContent.startsWith("1 organ shown absorbs"));
  const [mean, error] = await numberOf(page);
  const stem = result.organs.find(({ name }) => name === "lower").absorbed_flux.PAR;
  assert.ok(Math.abs(mean / (stem.mean / 4) - 1) < 1e-3, `${mean}: ${stem.mean / 4}`);
  assert.equal(error, null);
  assert.match(await textOf(page), /Error not known/);
}

/** What enters is known in a cell alone, and all that is not absorbed goes up where there is a ground. */
async function checkParts(page, result) {
  await open(page, workshop.address("plain"));
  assert.match(await textOf(page), /of ground · [\d.]+ ± [\d.]+ % of incoming PAR/);
  assert.match(await textOf(page), /Back to the sky/);
  await open(page, workshop.address("bare"));
  assert.match(await textOf(page), /of incoming PAR.*Passes or leaves[\d.]+(?: ± [\d.]+)? %$/);
  await open(page, workshop.address("alone"));
  const text = await textOf(page);
  assert.ok(!text.includes("%") && !text.includes("sky"), text);
  const { mean, standard_error: error } = groupOf(result, "", "absorbed_flux_density");
  const [shown, own] = text.match(/mean per area ([\d.]+) ± ([\d.]+) W m⁻²/).slice(1).map(Number);
  assert.ok(Math.abs(shown - mean) <= error && Math.abs(own / error - 1) < 0.3, text);
  const [passing, unsure] = text.match(/Passes or leaves([\d.]+) ± ([\d.]+) W$/).slice(1).map(Number);
  const { escaped, cut_off: cut } = result.energy.PAR;
  assert.ok(Math.abs(passing - escaped.mean - cut.mean) <= unsure && Math.abs(unsure / (escaped.standard_error + cut.standard_error) - 1) < 0.2, text);
}

/** "Organs87.1 ± 0.6 %" is the fraction of the result. */
async function checkFractions(page, result) {
  await open(page, workshop.address("plain"));
  const text = await textOf(page);
  const canopy = result.canopy.PAR;
  for (const [name, { mean, standard_error: error }] of [["Organs", canopy.absorptance], ["Ground", canopy.ground_absorptance], ["sky", canopy.reflectance]]) {
    const [shown, own] = text.match(new RegExp(`${name}([\\d.]+) ± ([\\d.]+) %`)).slice(1).map(Number);
    assert.ok(Math.abs(shown / 100 - mean) <= error && Math.abs(own / 100 / error - 1) < 0.3, `${text}: ${mean} ± ${error}`);
  }
}

/** A fraction has no sum: the brightest hour is shown, and the day can't be chosen. */
async function checkFraction(page, result) {
  await open(page, `${workshop.address("day")}#quantity=sunlit_fraction&band=`);
  await page.waitForFunction(() => document.querySelectorAll("#histogram .hit").length > 0);
  const lights = result.time_steps.map(({ energy }) => energy.PAR.absorbed_by_organs.mean);
  const brightest = result.time_steps[lights.indexOf(Math.max(...lights))].time.slice(11, 16);
  assert.equal(await page.locator("#time-title").textContent(), brightest);
  assert.ok(await page.getByRole("radio", { name: "Day" }).isDisabled());
  await page.locator("#quantity").selectOption("absorbed_flux_density");
  await page.waitForFunction(() => !document.querySelector("#period button").disabled);
  await page.getByRole("radio", { name: "Day" }).click();
  await page.waitForFunction(() => document.querySelector("#time-title").textContent === "Sum of the day");
  await page.locator("#quantity").selectOption("sunlit_fraction");
  await page.waitForFunction((time) => document.querySelector("#time-title").textContent === time, brightest);
}

const kDayFile = `
title = "A day"
bands = ["PAR"]
${kDay}
[run]
paths = 64
${kCell}${kGround}${twoLeaves()}`;

/** Groups have the unit of their column, with its power of ten: energy of a day is in joules, per area in megajoules. */
async function checkGroups(page, result) {
  await open(page, `${workshop.address("day")}#tab=run`);
  const group = result.total.groups.find(({ by }) => by === "all");
  const table = page.getByRole("region", { name: "PAR: sums over organs" });
  const units = (await table.locator("th").allTextContents()).slice(3, 5);
  const numbers = (await table.locator("tbody tr").first().locator("td").allTextContents()).slice(3, 5);
  const powers = units.map((unit) => 10 ** Number([.../\(10([⁰¹²³⁴⁵⁶⁷⁸⁹]+)/.exec(unit)?.[1] ?? "⁰"].map((sign) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(sign)).join("")));
  const read = (i) => Number(numbers[i].match(/^[\d.,]+/)[0].replace(/,/g, "")) * powers[i];
  assert.match(units.join(), /[(\u00a0]J\),.*\(MJ\u00a0m⁻²\)/);
  [group.absorbed_flux.PAR, group.absorbed_flux_density.PAR].forEach(({ mean, standard_error: error }, i) =>
    assert.ok(Math.abs(read(i) - mean / [1, 1e6][i]) <= error / [1, 1e6][i], `${numbers}: ${mean}`));
}

workshop.use(async (browser) => {
  const page = await workshop.page(browser);
  const grouped = workshop.compute("grouped", runFile(kCell + kGround, 'groups = ["kind"]'));
  const plain = workshop.compute("plain", runFile(kCell + kGround));
  workshop.compute("bare", runFile(kCell));
  const alone = workshop.compute("alone", runFile());
  const day = workshop.compute("day", kDayFile);
  ["grouped", "plain", "bare", "alone", "day"].forEach((name) => workshop.report(name));
  await checkShown(page, grouped);
  await checkWithoutGroups(page, plain);
  await checkParts(page, alone);
  await checkFractions(page, plain);
  await checkFraction(page, day);
  await checkGroups(page, day);
  assert.deepEqual(workshop.faults, []);
});
