// The report: the run and its results, as tables. Texts of the result are never markup.

import { drawConvergence } from "./charts.js";
import { short, withError } from "./numbers.js";

export function make(name, text, attributes = {}) {
  const made = document.createElement(name);
  if (text !== undefined) {
    made.textContent = text;
  }
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, value);
  }
  return made;
}

/** Sets the entries of a list of choices. @param entries  pairs [value, text] */
export function fill(select, entries) {
  select.replaceChildren(...entries.map(([value, text]) => make("option", text, { value })));
}

/** @param rows  lists of texts, numbers as {number: text}, or nodes */
export function table(caption, heads, rows) {
  const made = make("table");
  if (caption) {
    made.append(make("caption", caption));
  }
  const head = make("tr");
  heads.forEach((text, i) => {
    const isNumber = rows.length > 0 && rows[0][i] && rows[0][i].number !== undefined;
    head.append(make("th", text, { scope: "col", ...(isNumber ? { class: "number" } : {}) }));
  });
  const body = make("tbody");
  for (const row of rows) {
    const line = make("tr");
    for (const cell of row) {
      const isNumber = cell !== null && typeof cell === "object" && cell.number !== undefined;
      const td = make("td", isNumber ? cell.number : cell instanceof Node ? undefined : String(cell ?? ""),
        isNumber ? { class: "number" } : {});
      if (cell instanceof Node) {
        td.append(cell);
      }
      line.append(td);
    }
    body.append(line);
  }
  const thead = make("thead");
  thead.append(head);
  made.append(...(heads.some(Boolean) ? [thead] : []), body);
  const scroll = make("div", undefined,
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption || "table" });
  scroll.append(made);
  return scroll;
}

const estimate = (e) => ({ number: e && e.mean !== null ? withError(e.mean, e.standard_error ?? NaN) : "—" });

function words(value) {
  if (value === null || value === undefined) {
    return "—";
  }
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}

function energyTable(energy, isRemainder) {
  const rows = Object.entries(energy).map(([band, e]) => [
    band, e.unit,
    { number: withError(e.emitted, e.emitted_standard_error ?? NaN) },
    estimate(e.absorbed_by_organs), estimate(e.absorbed_by_ground), estimate(e.escaped), estimate(e.cut_off),
    estimate(e.imbalance), { number: short(e.closure_error) },
  ]);
  const caption = isRemainder ? "Flux ± standard error. Escaped light is the remainder of the budget." : "Flux ± standard error";
  return table(caption,
    ["band", "unit", "emitted", "absorbed by organs", "by the ground", "escaped", "cut off", "imbalance", "closure error"],
    rows);
}

function groupTables(groups, bands, unitOf) {
  return bands.map((band) => {
    const rows = groups.map((group) => [
      group.by === "all" ? "all organs" : `${group.by} = ${words(group.value)}`,
      { number: String(group.organs) }, { number: short(group.area) },
      estimate(group.absorbed_flux?.[band]), estimate(group.absorbed_flux_density?.[band]),
      ...(groups.some((g) => g.sunlit_fraction) ? [estimate(group.sunlit_fraction)] : []),
    ]);
    return table(`${band}: sums over organs ± standard error`,
      ["group", "organs", "area", `absorbed flux (${unitOf("absorbed_flux", band)})`,
        `per area (${unitOf("absorbed_flux_density", band)})`,
        ...(groups.some((g) => g.sunlit_fraction) ? ["sunlit fraction"] : [])], rows);
  });
}

/** Advice on totals of labels without groups in the run: their errors do not follow from those of organs. */
function missingGroups(run, groups) {
  const kMaxLabels = 100; // maximum number of values of a label for groups
  const keys = Object.entries(run.json.organs.labels)
    .filter(([key, { values }]) => values.length <= kMaxLabels && !groups.some(({ by }) => by === key)).map(([key]) => key);
  return keys.length === 0 ? [] : [make("p",
    `For totals by label with their errors, set groups = ${JSON.stringify(keys)} in [run].`)];
}

/** How errors fell, round by round. */
function convergenceNodes(rounds) {
  const percent = (x) => ({ number: Number.isFinite(x) ? `${short(100 * x)} %` : "—" });
  const rows = rounds.map((round) => [
    { number: String(round.paths) }, { number: short(round.seconds) },
    percent(round.median_error), percent(round.worst_error), percent(round.fraction_at_target),
  ]);
  const chart = make("div", undefined, { id: "convergence" });
  drawConvergence(chart, rounds);
  return [chart, table("Relative standard errors of the flux absorbed by organs",
    ["paths", "seconds", "median", "largest", "at the target"], rows)];
}

function settingsTables(head) {
  const options = Object.entries(head.run_file?.run ?? {}).map(([key, value]) => [key, words(value)]);
  const inputs = (head.inputs ?? []).map((file) => [file.path, { number: String(file.bytes) }, file.sha256]);
  const text = make("details");
  text.append(make("summary", "Complete run file"), make("pre", JSON.stringify(head.run_file ?? {}, null, 1)));
  return [
    table("Input files", ["file", "bytes", "SHA-256"], inputs),
    table("Settings", ["option", "value"], options),
    text,
  ];
}

/** "65536 paths x 8 replicates, finished"; for a series, its time steps. */
function completedWords(completed) {
  const { paths, replicates, time_steps: steps, time_steps_requested: requested, computed, stop } = completed;
  return [
    ...(paths === undefined ? [] : [`${paths} paths x ${replicates} replicates`]),
    ...(steps === undefined ? [] : [`${steps} of ${requested} time steps, ${computed} computed`]),
    ...(stop === undefined ? [] : [stop.replaceAll("_", " ")]),
  ].join(", ");
}

function aboutTable(run, time) {
  const { head } = run.json;
  const now = run.headOf(time);
  const { organs, triangles, length_unit: unit } = head.scene ?? {};
  const method = now.method ?? head.method;
  const completed = now.completed ?? head.completed ?? {};
  const rows = [
    ["scene", `${organs} organs, ${triangles} triangles${unit ? `, lengths in ${unit}` : ""}`],
    ...(head.sources ?? []).map((source) => ["source", source]),
    ...(head.point ? [["point", words(head.point)]] : []),
    ...(head.time ? [["time steps", [head.time].flat().map(words).join("; ")]] : []),
    ...(method ? [["method", `${method.used}${method.reason ? `: ${method.reason}` : ""}`]] : []),
    ["completed", completedWords(completed)],
    ...(now.audit ? [["audit", `${now.audit.agrees ? "agrees" : "DISAGREES"} with an independent run (p = ${short(now.audit.p_value)})`]] : []),
    ["program", `QuasiMC ${head.program_version}`],
    ["run file", head.run_file_path],
  ];
  return table("", ["", ""], rows);
}

/** @param worst  a node with the organs that have the largest errors */
export function drawReport(parent, run, time, worst, unitOf) {
  const { head } = run.json;
  const now = run.headOf(time);
  const bands = [...new Set(run.json.columns.map((column) => column.band).filter(Boolean))];
  const of = run.timeName(time) ? ` — ${run.timeName(time)}` : "";
  parent.replaceChildren();
  const section = (title, ...nodes) => parent.append(make("h2", title), ...nodes);
  const warnings = (head.warnings ?? []).map((warning) => [warning.where, warning.text]);
  if (warnings.length > 0) {
    section("Warnings", table("", ["where", "warning"], warnings));
  }
  section("Run", aboutTable(run, time));
  if (now.rounds?.length > 0) {
    section(`Convergence${of}`, ...convergenceNodes(now.rounds));
  }
  if (now.energy) {
    section(`Energy${of}`, energyTable(now.energy, now.escaped_by_difference ?? head.escaped_by_difference));
  }
  if (now.groups?.length > 0) {
    section(`Groups of organs${of}`, ...groupTables(now.groups, bands, unitOf), ...missingGroups(run, now.groups));
  }
  section(`Largest errors${of}`, worst);
  section("Files and settings", ...settingsTables(head));
}
