// Parts of the page without a browser: node parts_test.mjs
//
// Rationale: names, orders and choices that the page derives from a result are seen in few examples, and go wrong in
// the others.
// Expected behaviour: as the name of each check says.

import assert from "node:assert/strict";
import { scaleOfKnown } from "../../web/src/color_scale.js";
import { isOfSensors, weightsOf } from "../../web/src/filters.js";
import { scaleOf } from "../../web/src/numbers.js";
import { classCounts, countUnknown, highestKnown } from "../../web/src/legend.js";
import { isUnknown, kStriped, organColors } from "../../web/src/organ_colors.js";
import { columnsOf, organsInOrder } from "../../web/src/organ_table.js";
import { Timeline } from "../../web/src/timeline.js";
import { firstColumn } from "../../web/src/page.js";
import { methodWords, sourceWords, timeWords } from "../../web/src/run_text.js";
import { positionsOf } from "../../web/src/course.js";
import { pointNames } from "../../web/src/point_names.js";
import { sunPaths, sunsOf } from "../../web/src/sun_paths.js";

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
function seasonOf(declinations) {
  const [sin, cos] = [Math.sin(Math.PI / 4), Math.cos(Math.PI / 4)];
  return declinations.flatMap((degrees) => Array.from({ length: 24 }, (_, hour) => {
    const [up, angle] = [(degrees * Math.PI) / 180, ((hour - 12) * Math.PI) / 12];
    return [-Math.cos(up) * Math.sin(angle), Math.sin(up) * cos - Math.cos(up) * Math.cos(angle) * sin, Math.sin(up) * sin + Math.cos(up) * Math.cos(angle) * cos];
  }).filter(([, , z]) => z > 0));
}

/** Of a season three paths are drawn: they enclose all others. */
function checkPaths() {
  const season = Array.from({ length: 183 }, (_, day) => 23.4 * Math.sin((day * Math.PI) / 183) + 0.001 * day);
  const noons = sunPaths(seasonOf(season)).map((path) => Math.max(...path.map(([, , z]) => z)));
  const all = season.map((degrees) => Math.sin(((45 + degrees) * Math.PI) / 180));
  assert.equal(noons.length, 3);
  assert.ok(Math.abs(noons[0] - Math.min(...all)) < 1e-9 && Math.abs(noons[2] - Math.max(...all)) < 1e-9, `${noons}`);
  assert.ok(noons[0] < noons[1] && noons[1] < noons[2]);
  assert.equal(sunPaths(seasonOf([10])).length, 1);
  assert.equal(sunPaths([]).length, 0);
  assert.equal(sunPaths([[0, 0, 1]]).length, 0);
}

/** A page that shows organs of one value each. */
function pageOf({ mean, error, show = "value", kinds }) {
  const n = mean.length;
  const ones = new Float32Array(n).fill(1);
  const values = { mean: Float32Array.from(mean), error: Float32Array.from(error), low: mean.map((m, i) => m - 2 * error[i]), high: mean.map((m, i) => m + 2 * error[i]) };
  const json = { unit: "m", low: [0, 0, 0], high: [1, 1, 1], organs: { labels: kinds ? { kind: {} } : {} } };
  const run = { json, shape: { areas: ones, heights: ones }, organCount: n, count: n, columnName: () => "light", kindOf: (i) => kinds[i], isSensor: new Uint8Array(n), isPlant: ones, weightOf: () => 1 };
  return { run, values, isShown: new Uint8Array(n).fill(1), total: mean.reduce((a, b) => a + (b || 0), 0), column: 0, unit: "W", state: { show } };
}

/** A time with a clock has one sun, which moves; other suns are beside each other, each once, unless they are a path. */
function checkSuns() {
  const two = [[0, 0, 1], [0, 0.6, 0.8]];
  assert.equal(sunsOf(two, { start: 12 }).suns.length, 1);
  assert.deepEqual(sunsOf([...two, two[0]], { start: null }).suns, two);
  assert.deepEqual(sunsOf([], { start: 12 }), { suns: [], paths: [] });
  const day = Array.from({ length: 48 }, (_, i) => [Math.cos((i * Math.PI) / 47), 0, Math.sin((i * Math.PI) / 47)]);
  const { suns, paths } = sunsOf(day, {});
  assert.equal(suns.length, 0);
  assert.equal(paths.length, 1);
}

/** Organs of which nothing is known have stripes by value and by error, and are counted; those known to be dark are not. */
function checkStripes() {
  const values = { mean: Float32Array.of(5, 5, 0, 0, NaN), error: Float32Array.of(1, 6, NaN, 0, NaN) };
  assert.deepEqual([0, 1, 2, 3, 4].map((i) => isUnknown(values.mean[i], values.error[i])), [false, true, true, false, false]);
  const scale = { low: 0, high: 10 };
  const striped = (show) => [...organColors({ state: { show }, values, classes: [5, 6, 8, 7, 9], scale, map: [[0, 0, 0], [255, 255, 255]] })].map((color) => (color & kStriped) !== 0);
  assert.deepEqual(striped("value"), [false, true, true, false, false]);
  assert.deepEqual(striped("error"), [false, true, true, false, false]);
  assert.deepEqual(striped("difference"), [false, false, false, false, false]);
  assert.equal(countUnknown({ values, isShown: [1, 1, 1, 1, 1], run: { isCounted: [1, 1, 1, 1, 1] } }), 2);
  assert.equal(countUnknown({ values, isShown: [1, 0, 1, 1, 1], run: { isCounted: [1, 1, 1, 1, 1] } }), 1);
}

/** What is known to no better than 50 % comes last, however high its mean, and is not what the scale goes up to. */
function checkUnknown() {
  const [mean, error] = [[5, 900, 7, NaN, 8], [0.1, 800, NaN, NaN, 3]];
  const orderOf = (show, isReversed) => {
    const page = pageOf({ mean, error, show });
    return organsInOrder(page.isShown, columnsOf(page).value, isReversed);
  };
  assert.deepEqual(orderOf("value"), [4, 2, 0, 1, 3]);
  assert.deepEqual(orderOf("value", true), [0, 2, 4, 1, 3]);
  assert.deepEqual(orderOf("difference"), [1, 4, 2, 0, 3]);
  assert.equal(highestKnown(pageOf({ mean, error }).values), 8);
  const page = pageOf({ mean: [1, 1, 1], error: [0, 0, 0], kinds: ["stem", "", "leaf"] });
  assert.deepEqual(organsInOrder(page.isShown, columnsOf(page).kind), [2, 0, 1]);
}

/** Heads have the units, cells the same decimals, and bounds are those of intervals. */
function checkCells() {
  const page = pageOf({ mean: [36.8, 35.2, 0.81, 4], error: [1.7, 2.04, 0.09, 3.9] });
  const { area, value, interval, error, share } = columnsOf(page);
  const textsOf = ({ text }) => [0, 1, 2, 3].map(text);
  assert.deepEqual([area.unit, value.unit, error.unit, share.unit], ["m²", "W", "%", "%"]);
  assert.deepEqual(textsOf(value), ["36.8 ± 1.7", "35.2 ± 2.0", "0.8 ± 0.1", "below 11.8"]);
  assert.deepEqual(textsOf(interval), ["33.4 – 40.2", "31.1 – 39.3", "0.6 – 1.0", "−3.8 – 11.8"]);
  assert.deepEqual(textsOf(error), ["4.6", "5.8", "11.1", "> 50"]);
  assert.deepEqual(textsOf(share), ["48", "46", "1", ""]);
}

/** Classes count plants alone: not the ground, nor a sensor, nor what is hidden. */
function checkCounts() {
  const counts = classCounts({ classes: [0, 0, 1, 0, 1], isShown: [1, 1, 1, 1, 0], run: { isCounted: [0, 1, 1, 0, 1] } });
  assert.deepEqual(counts.slice(0, 3), [1, 1, 0]);
}

/** The scale is that of organs: a bright ground, which has no weight, does not darken them. */
function checkScale() {
  assert.deepEqual(scaleOf(Float32Array.of(5, 90, 7, NaN), Float32Array.of(1, 0, 1, 1)), { low: 0, high: 7 });
  assert.deepEqual(scaleOf(Float32Array.of(5, 90), Float32Array.of(0, 0)), { low: 0, high: 90 });
  const areas = Float32Array.of(4, 1, 2);
  const weights = (flags) => [...weightsOf({ isMeasured: false, isPlant: [0, 1, 1], isGround: [1, 0, 0], isSensor: [0, 0, 0], ...flags }, areas)];
  assert.deepEqual(weights({}), [0, 1, 2]);
  assert.deepEqual(weights({ isMeasured: true, isPlant: [0, 0, 0], isSensor: [0, 1, 1] }), [0, 1, 1]);
  assert.deepEqual(weights({ isPlant: [0, 0, 0], isGround: [1, 1, 1] }), [4, 1, 2]);
}

/** Neither one large organ, nor one that is small, nor one that is hardly known sets the scale of many others. */
function checkScaleOfMany() {
  const many = (value, area) => [Float32Array.from({ length: 400 }, (_, i) => (i === 0 ? value : 10)), Float32Array.from({ length: 400 }, (_, i) => (i === 0 ? area : 1))];
  assert.equal(scaleOf(...many(90, 300)).high, 10);
  assert.equal(scaleOf(...many(90, 0.01)).high, 10);
  const [mean, areas] = [Float32Array.of(5, 90), Float32Array.of(1, 1)];
  assert.equal(scaleOfKnown({ mean, error: Float32Array.of(1, 80) }, areas).high, 5);
  assert.equal(scaleOfKnown({ mean, error: Float32Array.of(4, 80) }, areas).high, 90, "none is known");
  assert.equal(scaleOfKnown({ mean, error: Float32Array.of(4, 1) }, Float32Array.of(1, 0)).high, 5, "the ground alone is known");
}

/** A result of sensors opens with what they measure, one of plants with what these absorb. */
function checkFirst() {
  const columns = ["absorbed_flux_density", "incident_upper"].map((quantity) => ({ quantity, band: "PAR" }));
  const first = (isPlant, isSensor, known = columns) => firstColumn({ columns: known, isMeasured: isOfSensors({ isPlant, isSensor }) })?.quantity;
  assert.equal(first([0, 0, 0], [0, 1, 1]), "incident_upper");
  assert.equal(first([1, 0, 0], [0, 1, 1]), "incident_upper");
  assert.equal(first([1, 1, 0], [0, 0, 1]), "absorbed_flux_density");
  assert.equal(first([0], [0]), "absorbed_flux_density");
  assert.equal(first([0, 0], [0, 1], columns.slice(0, 1)), "absorbed_flux_density");
  assert.equal(first([1], [0], []), undefined);
}

/** Dates have names of their own, with the year where there are several. */
function checkPoints() {
  assert.deepEqual(pointNames([{ "time.day": "2023-01-15" }, { "time.day": "2023-02-15" }]).map(({ name, short }) => [name, short]),
    [["15 January 2023", "15 Jan"], ["15 February 2023", "15 Feb"]]);
  assert.equal(pointNames([{ "time.day": "2023-01-15" }, { "time.day": "2024-01-15" }])[1].short, "15 Jan 2024");
  const [sun] = pointNames([{ "source.sun.elevation_deg": "20" }]);
  assert.equal(sun.value, 20);
  const days = pointNames([{ "time.day": "2023-01-15" }, { "time.day": "2023-02-15" }]).map(({ value }) => value);
  assert.equal(days[1] - days[0], 31);
  assert.ok(Number.isNaN(pointNames([{ "run.method": "first_hits" }])[0].value));
  assert.deepEqual([sun.name, sun.short, sun.by, sun.isDate], ["elevation 20°", "20°", "elevation", false]);
}

/** Steps are at their true distances where they are numbers. */
function checkPositions() {
  const axisOf = (values) => positionsOf(values.map((value) => ({ start: null, hours: 0, value })));
  assert.deepEqual(axisOf([40, 10, 20]), { order: [1, 2, 0], at: [10, 20, 40], isTrue: true });
  assert.deepEqual(axisOf([40, NaN, 20]), { order: [0, 1, 2], at: [0, 1, 2], isTrue: false });
  assert.deepEqual(axisOf([1, 1]), { order: [0, 1], at: [0, 1], isTrue: false });
  assert.deepEqual(positionsOf([{ start: 12, hours: 1 }, { start: 13, hours: 1 }]).at, [12.5, 13.5]);
}

/** What a result says of a run is in words, and twelve lamps are one row. */
function checkWords() {
  const lamp = (i) => `hps ${i}: spot lamp at (${i}, 1, 3.6), aimed along (0, 0, -1); emits PPFD 1700 umol s-1`;
  assert.deepEqual(sourceWords([lamp(1), lamp(2), "sun: a disk, 500 W m-2"]),
    ["hps 1 to 2: 2 alike, each a spot lamp aimed along (0, 0, -1); emits PPFD 1700 µmol\u00a0s⁻¹", "sun: a disk, 500 W\u00a0m⁻²"]);
  assert.equal(sourceWords([lamp(1)])[0], "hps 1: spot lamp at (1, 1, 3.6), aimed along (0, 0, -1); emits PPFD 1700 µmol\u00a0s⁻¹");
  assert.equal(timeWords("site: latitude 51.97 deg, longitude -5.67 deg (east positive), elevation 10 m"), "site: 51.97° N, 5.67° W, 10\u00a0m above the sea");
  assert.equal(timeWords("sky: perez; without direct light cie_overcast; a sun position every 5 min"),
    "sky: Perez sky, overcast (CIE) where there is no sun; a sun position every 5 min");
  assert.equal(methodWords({ used: "from_organs", reason: "pilot runs: the error for equal work would be 1.9 times by first_hits" }),
    "paths from organs; pilot runs: for equal work first hits would have 1.9 times the error");
  assert.equal(methodWords({ used: "first_hits", reason: "" }), "first hits");
}

checkSeason();
checkPoints();
checkPositions();
checkWords();
checkFirst();
checkScale();
checkScaleOfMany();
checkStripes();
checkSuns();
checkCounts();
checkUnknown();
checkCells();
checkDays();
checkHours();
checkPaths();
