// Run and warnings: how the result was computed, as sentences and tables. Texts of results are never markup.

import { drawConvergence } from "./convergence.js";
import { make } from "./dom.js";
import { lightBudget } from "./energy.js";
import { methodWords, sourceWords, timeWords } from "./run_text.js";
import { columnStyle, counted, evenly, kSigned, kUnknownText, many, percent, percentWithError, plain, unitOfColumn, unitText, plainUnit, withError, withUnit } from "./format.js";
import { lowerMedian } from "./numbers.js";

/** @param rows  lists of texts, numbers as {number: text}, or nodes */
export function table(caption, heads, rows) {
  const cell = (value) => {
    const isNumber = value !== null && typeof value === "object" && value.number !== undefined;
    return make("td", { class: isNumber && "number" }, isNumber ? value.number : value ?? "");
  };
  const isNumber = (i) => rows[0]?.[i]?.number !== undefined;
  const made = make("table", {}, caption && make("caption", {}, caption),
    heads.some(Boolean) && make("thead", {}, make("tr", {}, heads.map((text, i) => make("th", { scope: "col", class: isNumber(i) && "number" }, text)))),
    make("tbody", {}, rows.map((row) => make("tr", {}, row.map(cell)))));
  return make("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption || "table" }, made);
}

function words(value) {
  return value === null || value === undefined ? kUnknownText : typeof value === "object" ? JSON.stringify(value) : String(value);
}

/** An estimate in a unit, converted to one that does not mix lengths. @param isSigned  see kSigned */
function estimateIn(factor, isSigned = false) {
  return (e) => ({ number: e && e.mean !== null ? withError(e.mean * factor, (e.standard_error ?? NaN) * factor, isSigned ? kSigned : (e.ci95_high ?? NaN) * factor) : kUnknownText });
}

/** A column of estimates, some of which may be missing: its head, and a cell for each. @param head  of a unit */
function estimateColumn(estimates, factor, head) {
  const numbersOf = (key) => estimates.map((e) => (e?.[key] ?? NaN) * factor);
  const [mean, error, high] = ["mean", "standard_error", "ci95_high"].map(numbersOf);
  const style = columnStyle({ mean, error });
  return { head: head(style), cells: mean.map((one, i) => ({ number: withError(one, error[i], high[i], style) })) };
}

/** All parts add up to what is emitted: paths that chance prolongs are a surplus of the others. */
const negative = (e) => e && { ...e, mean: e.mean === null ? null : -e.mean };

function energyParts(energy, isRemainder) {
  const rows = Object.entries(energy).map(([band, e]) => {
    const { unit, factor } = plainUnit(e.unit);
    const estimate = estimateIn(factor);
    const isExact = e.emitted_standard_error === 0;
    return [band, unitText(unit), isExact ? { number: plain(e.emitted * factor, 5) } : estimate({ mean: e.emitted, standard_error: e.emitted_standard_error }), estimate(e.absorbed_by_organs),
      estimate(e.absorbed_by_ground), estimate(e.escaped), estimate(e.cut_off), estimateIn(factor, true)(negative(e.imbalance))];
  });
  const worst = Math.max(...Object.values(energy).map(({ closure_error: error }) => error ?? 0));
  const closes = worst > 0 ? `The budget adds up to 1 part in ${plain(1 / worst, 1)}.` : "The budget adds up exactly.";
  return [make("p", {}, closes, isRemainder ? " Escaped light is the remainder of the budget." : ""), table("Light ± standard error",
    ["Band", "unit", "emitted", "absorbed by organs", "by the ground", "escaped", "cut off", "ended by chance"], rows)];
}

function groupTables(groups, bands, unitOf, factorOf, length) {
  const hasSunlit = groups.some(({ sunlit_fraction: fraction }) => fraction);
  const areas = lowerMedian(groups.map(({ area }) => area));
  const nameOf = ({ by, value }) => (by === "all" ? "all organs" : `${by} = ${words(value)}`);
  const columnIn = (band) => ([name, quantity]) => estimateColumn(groups.map((group) => group[quantity]?.[band]), factorOf(quantity, band),
    (style) => `${name} (${unitOfColumn(unitOf(quantity, band), style)})`);
  return bands.map((band) => {
    const columns = [["absorbed", "absorbed_flux"], ["absorbed per area", "absorbed_flux_density"]].map(columnIn(band));
    const all = hasSunlit ? [...columns, estimateColumn(groups.map((group) => group.sunlit_fraction), 1, () => "sunlit fraction")] : columns;
    return table(`${band}: sums over organs ± standard error`, ["group", "organs", length ? `area (${unitText(length)}²)` : "area", ...all.map(({ head }) => head)],
      groups.map((group, i) => [nameOf(group), { number: counted(group.organs) }, { number: evenly(group.area, areas) }, ...all.map(({ cells }) => cells[i])]));
  });
}

/** Advice on totals of labels without groups in the run: their errors do not follow from those of organs. */
function missingGroups(run, groups) {
  const kMaxLabels = 100; // maximum number of values of a label for groups
  const keys = Object.entries(run.json.organs.labels)
    .filter(([key, { values }]) => values.length <= kMaxLabels && !groups.some(({ by }) => by === key)).map(([key]) => key);
  return keys.length > 0 && make("p", {}, `For totals by label with their errors, set groups = ${JSON.stringify(keys)} in [run].`);
}

function convergenceParts(rounds) {
  const rows = rounds.map((round) => [{ number: counted(round.paths) }, { number: plain(round.seconds) },
    ...[round.median_error, round.worst_error, round.fraction_at_target].map((part) => ({ number: percent(part) }))]);
  const chart = make("div", { id: "convergence" });
  drawConvergence(chart, rounds);
  return [chart, table("Relative standard errors of the flux absorbed by organs", ["paths", "seconds", "median", "largest", "at the target"], rows)];
}

const kStops = {
  finished: "stopped: all paths done", paths_done: "stopped: all paths done", interrupted: "stopped by the user",
};

/** "65,536 paths × 8 replicates; stopped: all paths done" */
function completedWords({ paths, replicates, time_steps: steps, time_steps_requested: requested, computed, stop }) {
  return [
    ...(paths === undefined ? [] : [`${counted(paths)} paths × ${replicates} replicates`]),
    ...(steps === undefined ? [] : [`${steps} of ${many(requested, "time step")}${computed < steps ? `, ${computed} computed, others dark or scaled copies` : ""}`]),
    ...(stop === undefined ? [] : [kStops[stop] ?? `stopped: ${stop.replaceAll("_", " ")}`]),
  ].join("; ");
}

/** "site: latitude 52 deg" as a name and a text. @param usual  the name of texts without one */
function named(text, usual) {
  const at = text.indexOf(": ");
  return at > 0 && at < 20 ? [text.slice(0, at), text.slice(at + 2)] : [usual, text];
}

/** @param points  in words, where all of a sweep are shown; empty for one */
function aboutRun(run, now, points) {
  const { head } = run.json;
  const { organs, triangles, length_unit: unit } = head.scene ?? {};
  const step = (head.time_steps ?? []).reduce((best, one) => ((one.completed?.paths ?? 0) > (best?.completed?.paths ?? 0) ? one : best), undefined);
  const method = now.method ?? head.method ?? step?.method;
  const { paths, replicates } = step?.completed ?? {};
  const rows = [
    ["scene", `${many(organs ?? run.organCount, "organ")}, ${many(triangles ?? run.shape.triangles, "triangle")}${unit ? `, lengths in ${unit}` : ""}`],
    ...sourceWords(head.sources ?? []).map((source) => ["source", source]),
    ...(points ? [["points", `${points}; ${completedWords(head.run_file?.run ?? {})} each`]] : head.point ? [["point", words(head.point)]] : []),
    ...[head.time ?? []].flat().map((text) => named(timeWords(words(text)), "time steps")),
    ...(method ? [["method", methodWords(method)]] : []),
    ...(points ? [] : [["completed", [completedWords({ paths, replicates, ...(now.completed ?? head.completed) }), head.timing && `${plain(head.timing.total_s)}\u00a0s`].filter(Boolean).join("; ")]]),
    ...(now.audit ? [["audit", `${now.audit.agrees ? "agrees" : "DISAGREES"} with an independent run (p = ${plain(now.audit.p_value)})`]] : []),
    ["program", head.program_version ? `QuasiMC ${head.program_version}` : run.json.program],
    ...(head.run_file_path ? [["run file", head.run_file_path]] : []),
  ];
  return table("", ["", ""], rows);
}

function settings(head) {
  const options = Object.entries(head.run_file?.run ?? {}).map(([key, value]) => [key, words(value)]);
  const inputs = (head.inputs ?? []).map((file) => [file.path, { number: counted(file.bytes) }, file.sha256]);
  const text = make("details", {}, make("summary", {}, "Complete run file"), make("pre", {}, JSON.stringify(head.run_file ?? {}, null, 1)));
  return make("details", {}, make("summary", {}, "Files and settings"),
    inputs.length > 0 && table("Input files", ["file", "bytes", "SHA-256"], inputs), options.length > 0 && table("Settings", ["option", "value"], options), text);
}

export class RunTab {
  constructor(page, parent) {
    Object.assign(this, { page, parent });
  }

  draw() {
    const { page } = this;
    const key = `${page.time} ${page.run.json.title}`;
    if (this.isOf !== page.run || this.key !== key) {
      Object.assign(this, { isOf: page.run, key });
      this.#show();
    }
  }

  /** "PAR: plants 88.2 %, ground 7.7 %, back to the sky 4.1 %." */
  #lightWords(bands) {
    return bands.flatMap((band) => {
      const parts = lightBudget(this.page, this.page.entry, band)?.parts ?? [];
      return parts.length > 0 ? [make("p", {}, `${band}: ${parts.map(({ name, part, error }) => `${name.toLowerCase()} ${percentWithError(part, error)}`).join(", ")}.`)] : [];
    });
  }

  #show() {
    const { run, head: now, timeline, entry } = this.page;
    const { head } = run.json;
    const bands = [...new Set(run.json.columns.map(({ band }) => band).filter(Boolean))];
    const when = entry.name ? `, ${timeline.wordsOf(entry)}` : "";
    const columnOf = (quantity, band) => run.columnOf(quantity, band);
    const unitOf = (quantity, band) => (columnOf(quantity, band) < 0 ? "" : run.unit(this.page.time, columnOf(quantity, band)));
    const factorOf = (quantity, band) => (columnOf(quantity, band) < 0 ? 1 : run.factorOf(this.page.time, columnOf(quantity, band)));
    const warnings = head.warnings ?? [];
    const section = (title, ...nodes) => [make("h2", {}, title), ...nodes];
    this.parent.replaceChildren(...[
      ...(warnings.length > 0 ? section(many(warnings.length, "warning"), make("ul", { class: "warnings" },
        warnings.map(({ where, text }) => make("li", {}, where && make("b", {}, `${where}: `), text)))) : []),
      ...section("How it was computed", aboutRun(run, now, entry.point === -1 ? `${timeline.points.length}: ${timeline.points[0].name} to ${timeline.points.at(-1).name}` : "")),
      ...section(`Where the light goes${when}`, ...this.#lightWords(bands), ...(now.energy ? energyParts(now.energy, now.escaped_by_difference ?? head.escaped_by_difference) : [])),
      ...(now.rounds?.length > 0 ? section(`Convergence${when}`, ...convergenceParts(now.rounds)) : []),
      ...(now.groups?.length > 0 ? section(`Groups of organs${when}`, ...groupTables(now.groups, bands, unitOf, factorOf, run.json.unit), missingGroups(run, now.groups)) : []),
      settings(head),
    ].filter(Boolean));
  }
}
