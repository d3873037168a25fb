// Parts of the page without a browser: node parts_test.mjs
//
// Rationale: names, orders and choices that the page derives from a result are seen in few examples, and go wrong in
// the others.
// Expected behaviour: as the name of each check says.

import assert from "node:assert/strict";
import { classCounts, highestKnown } from "../../web/src/legend.js";
import { columnsOf, organsInOrder } from "../../web/src/organ_table.js";
import { Timeline } from "../../web/src/timeline.js";
import { firstColumn } from "../../web/src/page.js";
import { sunPaths } from "../../web/src/sun_paths.js";

/** A result with a single step of a season, a step of each day, or of each hour. */
function resultOf(steps, days) {
  const times = [...steps.map(({ label }) => ({ part: "time_steps", label })), ...days.map((label) => ({ part: "days", label })), { part: "total", label: "" }];
  return { json: { times }, headOf: (index) => steps[index] };
}

function checkSeason() {
  const timeline = Timeline.ofRun(resultOf([{ label: "2023-04-01T00:00+00:00", seconds: 183 * 86400 }], ["2023-04-01/2023-09-30"]));
  const { title, note } = timeline.titleOf(timeline.total, () => 1);
  assert.equal(title, "Sum of 1 April to 30 September 2023");
  assert.equal(note, "1 April to 30 September 2023");
  assert.equal(timeline.wordsOf(timeline.total), "sum of 1 April to 30 September 2023");
  assert.equal(timeline.steps[0].name, "1 April to 30 September 2023");
  assert.ok(timeline.isEmpty, "a strip of one period");
}

function checkDays() {
  const labels = ["2023-06-20", "2023-06-21", "2023-06-22"];
  const timeline = Timeline.ofRun(resultOf(labels.map((date) => ({ label: `${date}T00:00+00:00`, seconds: 86400 })), labels));
  assert.ok(!timeline.isEmpty);
  assert.deepEqual(timeline.steps.map(({ short }) => short), ["20 June", "21 June", "22 June"]);
  assert.equal(timeline.titleOf(timeline.total, () => 1).note, "3 days");
  assert.deepEqual(timeline.stepsOf(timeline.days[1]), [timeline.steps[1]]);
  assert.deepEqual(timeline.stepsOf(timeline.total), timeline.steps);
}

function checkHours() {
  const hours = [11, 12].map((hour) => ({ label: `2023-06-21T${hour}:00+00:00`, seconds: 3600 }));
  const timeline = Timeline.ofRun(resultOf(hours, ["2023-06-21"]));
  assert.ok(!timeline.isEmpty && timeline.hasClock);
  assert.deepEqual(timeline.titleOf(timeline.total, () => 1), { title: "Sum of the day", note: "21 June, 2 h of light" });
}

/** Suns of whole hours on days of these declinations, degrees, at 45 degrees north. */
function sunsOf(declinations) {
  const [sin, cos] = [Math.sin(Math.PI / 4), Math.cos(Math.PI / 4)];
  return declinations.flatMap((degrees) => Array.from({ length: 24 }, (_, hour) => {
    const [up, angle] = [(degrees * Math.PI) / 180, ((hour - 12) * Math.PI) / 12];
    return [-Math.cos(up) * Math.sin(angle), Math.sin(up) * cos - Math.cos(up) * Math.cos(angle) * sin, Math.sin(up) * sin + Math.cos(up) * Math.cos(angle) * cos];
  }).filter(([, , z]) => z > 0));
}

/** Of a season three paths are drawn: they enclose all others. */
function checkPaths() {
  const season = Array.from({ length: 183 }, (_, day) => 23.4 * Math.sin((day * Math.PI) / 183) + 0.001 * day);
  const noons = sunPaths(sunsOf(season)).map((path) => Math.max(...path.map(([, , z]) => z)));
  const all = season.map((degrees) => Math.sin(((45 + degrees) * Math.PI) / 180));
  assert.equal(noons.length, 3);
  assert.ok(Math.abs(noons[0] - Math.min(...all)) < 1e-9 && Math.abs(noons[2] - Math.max(...all)) < 1e-9, `${noons}`);
  assert.ok(noons[0] < noons[1] && noons[1] < noons[2]);
  assert.equal(sunPaths(sunsOf([10])).length, 1);
  assert.equal(sunPaths([]).length, 0);
  assert.equal(sunPaths([[0, 0, 1]]).length, 0);
}

/** What is known to no better than 50 % comes last, however high its mean, and is not what the scale goes up to. */
function checkUnknown() {
  const values = { mean: Float32Array.of(5, 900, 7, NaN, 8), error: Float32Array.of(0.1, 800, NaN, NaN, 3), low: [], high: [] };
  const json = { unit: "m", organs: { labels: {} } };
  const shape = { areas: Float32Array.of(1, 1, 1, 1, 1), heights: Float32Array.of(1, 1, 1, 1, 1) };
  const run = { json, shape, organCount: 5, count: 5, columnName: () => "light" };
  const orderOf = (show) => organsInOrder(Uint8Array.of(1, 1, 1, 1, 1), columnsOf({ run, values, total: 1, column: 0, unit: "", state: { show } }).value);
  assert.deepEqual(orderOf("value"), [4, 2, 0, 1, 3]);
  assert.deepEqual(orderOf("difference"), [1, 4, 2, 0, 3]);
  assert.equal(highestKnown(values), 8);
}

/** Classes count plants alone: not the ground, nor a sensor, nor what is hidden. */
function checkCounts() {
  const counts = classCounts({ classes: [0, 0, 1, 0, 1], isShown: [1, 1, 1, 1, 0], run: { isPlant: [0, 1, 1, 0, 1] } });
  assert.deepEqual(counts.slice(0, 3), [1, 1, 0]);
}

/** A result of sensors opens with what they measure, one of plants with what these absorb. */
function checkFirst() {
  const columns = ["absorbed_flux_density", "incident_upper"].map((quantity) => ({ quantity, band: "PAR" }));
  const first = (isPlant, isSensor, known = columns) => firstColumn({ columns: known, isPlant, isSensor })?.quantity;
  assert.equal(first([0, 0, 0], [0, 1, 1]), "incident_upper");
  assert.equal(first([1, 0, 0], [0, 1, 1]), "incident_upper");
  assert.equal(first([1, 1, 0], [0, 0, 1]), "absorbed_flux_density");
  assert.equal(first([0], [0]), "absorbed_flux_density");
  assert.equal(first([0, 0], [0, 1], columns.slice(0, 1)), "absorbed_flux_density");
  assert.equal(first([1], [0], []), undefined);
}

checkSeason();
checkFirst();
checkCounts();
checkUnknown();
checkDays();
checkHours();
checkPaths();
