// Numbers and their errors as text: node digits_test.mjs
//
// Rationale: a digit that is not known misleads, and in a column numbers are compared.
// Expected behaviour: an error has two digits if it begins with 1 or 2, else one, and its value ends there. A positive
// number known to no better than 50 % is a bound, which is rounded up. A column has one last digit and one power of ten.

import assert from "node:assert/strict";
import { columnStyle, estimate, evenly, interval, kSigned, percentWithError, plain, unitOfColumn, unitText, withError } from "../../web/src/format.js";

function checkErrors() {
  for (const [mean, error, text] of [
    [32.7512, 0.0213, "32.751 ± 0.021"], [32.7512, 0.0313, "32.75 ± 0.03"], [679.6, 11.3, "680 ± 11"], [12345.6, 230, "12,350 ± 230"],
    [5, 0.294, "5.00 ± 0.29"], [5, 0.296, "5.0 ± 0.3"], [5, 0.94, "5.0 ± 0.9"], [5, 0.98, "5.0 ± 1.0"], [35, 2, "35.0 ± 2.0"],
    [4.2e-5, 2.04e-6, "(4.20 ± 0.20) × 10⁻⁵"], [4.2e8, 4e6, "(4.20 ± 0.04) × 10⁸"], [NaN, 1, "–"], [3.14159, 0, "3.142"], [3.14159, NaN, "3.14"],
  ]) {
    assert.equal(withError(mean, error), text);
  }
  assert.equal(percentWithError(0.8812, 0.0003), "88.12 ± 0.03 %");
}

function checkBounds() {
  assert.deepEqual(estimate(2, 1.5, 3.14), { value: "below 3.2", error: "" });
  assert.equal(withError(2, 1.5), "below 5.0"); // its end follows from the error
  assert.equal(withError(0, NaN, 0.00044), "below 4.4 × 10⁻⁴");
  assert.equal(withError(0, NaN), "0 (no light found)");
  assert.equal(withError(0, 0), "0");
  assert.equal(withError(2, 1.5, kSigned), "2.0 ± 1.5");
  assert.equal(withError(-0.2, 3, kSigned), "0 ± 3");
  assert.equal(withError(1e-5, 0.3, kSigned), "0.0 ± 0.3");
  assert.equal(percentWithError(0.001, 0.002), "below 0.50 %");
}

function checkIntervals() {
  const of = (mean, error, low, high) => interval({ mean, error, low, high });
  assert.equal(of(330, 5.9, 318.8, 341.6), "319 – 342");
  assert.equal(of(12, 41, 0, 93.6), "0 – 94"); // the end that the bound has
  assert.equal(of(1.3e-5, 1e-6, 1.1e-5, 1.5e-5), "(1.10 – 1.50) × 10⁻⁵");
}

function checkColumns() {
  const mean = [36.8, 35.2, 0.81, 0.012, 4, 60];
  const error = [1.7, 2.04, 0.09, 0.004, 0.31, 40];
  const style = columnStyle({ mean, error });
  assert.deepEqual(style, { power: 0, digit: -1 });
  assert.deepEqual(mean.map((value, i) => withError(value, error[i], value + 2 * error[i], style)),
    ["36.8 ± 1.7", "35.2 ± 2.0", "0.8 ± 0.1", "below 0.1", "4.0 ± 0.3", "below 140.0"]);
  assert.equal(withError(7, 0.004, 7, style), "7.0 ± <0.1");
  const small = columnStyle({ mean: [4.2e-5, 3e-6], error: [2e-6, 1e-7] });
  assert.deepEqual([withError(4.2e-5, 2e-6, 5e-5, small), withError(3e-6, 1e-7, 4e-6, small), unitOfColumn("mol", small)],
    ["4.200 ± 0.200", "0.300 ± 0.010", "10⁻⁵\u00a0mol"]);
  assert.equal(withError(4.17, NaN, NaN, columnStyle({ mean: [412, 4.17], error: [NaN, NaN] })), "4");
}

function checkPlain() {
  assert.equal(plain(4.21e-5, 2), "4.2 × 10⁻⁵");
  assert.equal(unitText("umol m-2 s-1"), "µmol\u00a0m⁻²\u00a0s⁻¹");
  assert.deepEqual([1.1, 1.05, 0.984].map((height) => evenly(height, 1.2)), ["1.10", "1.05", "0.98"]);
  assert.deepEqual([evenly(123.4, 150), evenly(0.004, 1.2), evenly(0, 1.2)], ["123", "<0.01", "0.00"]);
}

checkErrors();
checkBounds();
checkIntervals();
checkColumns();
checkPlain();
