// Areas of organs in layers of height: node layer_areas_test.mjs
//
// Rationale: a leaf that spans many layers, put into one of them, gives a canopy steps that it does not have.
// Expected behaviour: parts of triangles are those of a sum over many small ones; the parts of an organ add up to its
// area; limits of layers are round; a flat organ is in one layer; means and filters take organs by their parts.

import assert from "node:assert/strict";
import { givenLayers, layersOf } from "../../web/src/bins.js";
import { organsPassing } from "../../web/src/filters.js";
import { LayerAreas, partBelow, roundLimits } from "../../web/src/layer_areas.js";

/** The shape of organs of one triangle each, about a middle of 0. */
function shapeOf(triangles, areas) {
  const n = triangles.length;
  return {
    areas: Float32Array.from(areas), counts: new Uint32Array(n).fill(1), vertices: Float32Array.from(triangles.flat(2)),
    corners: Uint32Array.from({ length: 3 * n }, (_, i) => i), first: Uint32Array.from({ length: n + 1 }, (_, i) => 3 * i),
  };
}

/** The part of a triangle below a height, from the middles of many small ones. */
function summedPart(height, a, b, c) {
  const n = 400;
  let below = 0;
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < 2 * (n - i) - 1; ++j) {
      const [u, v] = j % 2 === 0 ? [(i + 1 / 3) / n, (j / 2 + 1 / 3) / n] : [(i + 2 / 3) / n, ((j - 1) / 2 + 2 / 3) / n];
      below += a + u * (b - a) + v * (c - a) < height ? 1 : 0;
    }
  }
  return below / n ** 2;
}

function checkParts() {
  for (const [a, b, c] of [[0, 0.3, 1], [0, 0, 1], [0, 1, 1]]) {
    for (const height of [-0.1, 0.1, 0.3, 0.7, 1, 1.2]) {
      assert.ok(Math.abs(partBelow(height, a, b, c) - summedPart(height, a, b, c)) < 0.005, `${height} of ${a} ${b} ${c}`);
    }
  }
  assert.equal(partBelow(0.5, 0, 0.5, 1), 0.5);
}

function checkLimits() {
  assert.deepEqual(roundLimits(0.13, 0.52), [0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55]);
  assert.deepEqual(roundLimits(0, 1).at(-1), 1.1); // what is 1 high is in a layer
  assert.deepEqual(roundLimits(2, 2), [1.8, 2.2]);
}

// A wall from 0 to 1, as wide below as 0 above: three quarters are in the lower half; a leaf at 0.6, and a plate that is not shown.
const shape = shapeOf([[[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 0, 0.6], [1, 0, 0.6], [0, 1, 0.6]], [[0, 0, 5], [1, 0, 5], [0, 1, 5]]], [2, 0.5, 9]);

function checkShares() {
  const { limits, areas } = new LayerAreas(shape, 0).of((organ) => organ < 2);
  assert.deepEqual([limits[0], limits.at(-1), limits.length], [0, 1.1, 12]);
  const rowOf = (organ) => [...areas.subarray(11 * organ, 11 * organ + 11)];
  rowOf(0).forEach((area, i) => assert.ok(Math.abs(area - (i < 10 ? 0.02 * (19 - 2 * i) : 0)) < 1e-6, `${area} in ${i}`));
  assert.deepEqual(rowOf(1).map((area, i) => (area > 0 ? i : -1)).filter((i) => i >= 0), [6]);
  assert.equal(rowOf(1)[6], 0.5);
}

function checkMeans() {
  const layers = new LayerAreas(shape, 0);
  const found = layersOf({ numbers: Float32Array.of(10, 20, 7), areas: shape.areas, layers, isShown: Uint8Array.of(1, 1, 0) });
  const [mean, other] = [found.bins[6].mean, found.bins[5].mean];
  assert.ok(Math.abs(mean - (10 * 0.14 + 20 * 0.5) / 0.64) < 1e-5 && Math.abs(other - 10) < 1e-6, `${mean} ${other}`);
  assert.deepEqual([found.bins[6].count, found.bins[5].count, found.has(0, 3), found.has(1, 3), found.has(1, 6)], [2, 1, true, false, true]);
  const medians = layersOf({ numbers: Float32Array.of(10, 20, 7), areas: shape.areas, layers, isShown: Uint8Array.of(1, 1, 0), isMedian: true });
  assert.equal(medians.bins[6].mean, 20);
  assert.ok(found.has(0, 0) && !found.has(2, 0));
  const given = givenLayers({ layers: [{ height_min: 0, height_max: 1, area: 1, organs: 1, mean: 2, error: 1 }], heights: [0.3, 1], isShown: [1, 1] });
  assert.ok(given.has(0, 0) && given.has(1, 0));
}

function checkFilter() {
  const run = { count: 3, shape, layers: new LayerAreas(shape, 0), isGround: [0, 0, 0], isSensor: [0, 0, 0], json: { organs: { labels: {} } } };
  const passing = (layer) => [...organsPassing(run, [1, 1, 1], [0, 0, 0],
    { show: "value", ground: true, sensors: true, labels: {}, ranges: {}, layer, values: null, errorClass: null })];
  assert.deepEqual(passing([0.6, 0.7]), [1, 1, 0]);
  assert.deepEqual(passing([0.5, 0.6]), [1, 0, 0]);
  assert.deepEqual(passing(null), [1, 1, 1]);
}

/** Many small triangles take little time: the first picture waits for the charts. */
function checkSpeed() {
  const n = 1e6;
  const at = (i, k) => ((i * 7919 + k * 104729) % 10007) / 10007;
  const vertices = Float32Array.from({ length: 9 * n }, (_, i) => at(Math.floor(i / 9), i % 3) + 0.01 * at(i, 5));
  const many = { vertices, corners: Uint32Array.from({ length: 3 * n }, (_, i) => i), counts: new Uint32Array(n / 50).fill(50),
    areas: new Float32Array(n / 50).fill(1), first: Uint32Array.from({ length: n / 50 + 1 }, (_, i) => 150 * i) };
  const begun = performance.now();
  new LayerAreas(many, 0).of(() => true);
  console.log(`1,000,000 triangles: ${Math.round(performance.now() - begun)} ms`);
}

checkParts();
checkLimits();
checkShares();
checkMeans();
checkFilter();
if (process.argv.includes("--speed")) {
  checkSpeed();
}
