// How errors fell, round by round.

import { svg } from "./dom.js";
import { counted, plain } from "./format.js";
import { startPlot } from "./plot.js";

/** The median and the worst error after each round, per cent, both axes logarithmic. */
export function drawConvergence(parent, rounds) {
  const known = rounds.filter((round) => round.median_error > 0 && round.worst_error > 0);
  if (known.length < 2) {
    return;
  }
  const log = Math.log10;
  const errors = known.flatMap((round) => [100 * round.median_error, 100 * round.worst_error]);
  const [low, high] = [Math.floor(log(Math.min(...errors))), Math.ceil(log(Math.max(...errors)))];
  const at = known.map(({ paths }) => log(paths));
  const powers = Array.from({ length: high - low + 1 }, (_, i) => low + i);
  const { node, x, y } = startPlot(parent, "Convergence", {
    left: 56, x: { low: at[0], high: at.at(-1), ticks: at, format: (power) => counted(10 ** power) },
    y: { low, high, ticks: powers, format: (power) => `${plain(10 ** power)} %`, grid: true } });
  for (const [key, name, below] of [["worst_error", "largest", -6], ["median_error", "median", 16]]) {
    const points = known.map((round, i) => [x(at[i]), y(log(100 * round[key]))]);
    node.append(svg("polyline", { class: "mean", points: points.map((point) => point.join()).join(" ") }));
    points.forEach(([cx, cy]) => node.append(svg("circle", { class: "dot", cx, cy, r: 3 })));
    node.append(svg("text", { x: points[0][0] + 6, y: points[0][1] + below }, name));
  }
}
