// A JSON result on this computer, read by the browser to be compared with the one that is shown.

import { estimateOf, headAt, layersOfResult } from "./energy.js";
import { plainUnit, unitText } from "./format.js";

const kVersion = 2; // of the format
const kMaxBytes = 500e6; // of the texts that browsers hold

/** Ids beyond the exact integers of numbers, as texts. */
const withExactIds = (text) => text.replace(/"id": ?(\d{16,})/g, '"id":"$1"');

const keyOf = ({ part, label }) => `${part || (label ? "time_steps" : "")} ${label}`;

/** The organs of a list, then its sensors, whose spheres have a fluence rate instead of an upper side. */
const rowsOf = ({ organs = [], sensors = [] } = {}) => (organs.length === 0 ? [] : [...organs,
  ...sensors.map((sensor) => ({ ...sensor, id: `sensor ${sensor.id}`, incident_upper: sensor.fluence_rate ?? sensor.incident_upper }))]);

/** Rows of organs by time. @param result  a result, or a point of a sweep */
function rowsByTime(result) {
  const { time_steps: steps = [], days = [], total } = result;
  const lists = [
    [{ part: "", label: "" }, rowsOf(result)], ...steps.map((step) => [{ part: "time_steps", label: step.time }, rowsOf(step)]),
    ...days.map((day) => [{ part: "days", label: day.date }, rowsOf(day)]), [{ part: "total", label: "" }, rowsOf(total)],
  ];
  return new Map(lists.filter(([, rows]) => rows.length > 0).map(([time, rows]) => [keyOf(time), rows]));
}

const numbersOf = (rows, column, key, factor) => Float64Array.from(rows, (row) => (estimateOf(row, column)?.[key] ?? NaN) * factor);

function parsed(name, text) {
  let json = null;
  try {
    json = JSON.parse(withExactIds(text));
  } catch (error) {
    throw new Error(`${name} is not a JSON result (${error.message}). Write one with quasimc run --json.`);
  }
  if (json?.format !== "quasimc-result") {
    throw new Error(`${name} is not a result of quasimc (it has no format "quasimc-result"). Write one with quasimc run --json.`);
  }
  if (json.format_version !== kVersion) {
    throw new Error(`${name} has format version ${json.format_version}, and this page reads version ${kVersion}. Compute it anew.`);
  }
  return json;
}

export class ResultFile {
  /** Reads a file. Rejects with a sentence for the user if it is not one result with organs. */
  static async read(file) {
    if (file.size > kMaxBytes) {
      throw new Error(`${file.name} is too large for a browser (${Math.round(file.size / 1e6)} MB). Use quasimc view --minus.`);
    }
    return new ResultFile(file.name, parsed(file.name, await file.text()));
  }

  constructor(name, json) {
    if (json.points?.length > 1) {
      throw new Error(`${name} has ${json.points.length} points of a sweep, and one result is compared. Compute one with quasimc run --sweep-point.`);
    }
    this.name = name;
    this.title = json.title || name;
    this.json = json.points?.[0] ?? json;
    this.result = { ...json, ...this.json };
    this.rows = rowsByTime(this.json);
    const [first] = this.rows.values();
    if (!first) {
      throw new Error(`${name} has no organs: the run did not write them, or was not completed.`);
    }
    this.ids = first.map(({ id }) => String(id));
    this.units = new Map((json.quantities ?? []).map(({ name: quantity, unit }) => [quantity, unit]));
  }

  /** The unit of a column; that of the column, if the file does not name one. */
  #unitOf({ quantity, band, unit }) {
    const own = this.units.get(quantity);
    return (band ? own?.[band] : undefined) ?? unit;
  }

  #has(column) {
    const [rows] = this.rows.values();
    return rows.some((row) => estimateOf(row, column) !== undefined);
  }

  /** See Comparison. */
  async values(time, column, factor) {
    const rows = this.rows.get(keyOf(time));
    return rows && this.#unitOf(column) === column.unit && this.#has(column)
      ? { mean: numbersOf(rows, column, "mean", factor), error: numbersOf(rows, column, "standard_error", factor) } : null;
  }

  /** See Comparison. */
  layers({ part, label }, column, factor) {
    return this.#unitOf(column) === column.unit ? layersOfResult(headAt(this.json, part, label), column, factor) : null;
  }

  /** Why it can't be compared, as a sentence; "" if it can. @param comparison  of it with a run */
  misfit({ run, common }) {
    const { name } = this;
    if (common === 0) {
      return `${name} has no organ of this result. Organs are matched by their ids, such as ${run.idOf(0)} here and ${this.ids[0]} there.`;
    }
    const both = run.columns.filter((column) => column.band && this.#has(column));
    if (both.length === 0) {
      return `${name} has no quantity and band of this result, such as ${run.columnName(run.columns[0].number)}.`;
    }
    if (!both.some((column) => this.#unitOf(column) === column.unit)) {
      const [here, there] = [both[0].unit, this.#unitOf(both[0])].map((unit) => unitText(plainUnit(unit).unit));
      return `${name} has other units: ${run.columnName(both[0].number)} is in ${here} here and in ${there} there.`;
    }
    if (!run.json.times.some((time) => this.rows.has(keyOf(time)))) {
      const [first] = run.json.times;
      return `${name} has no time of this result${first.label ? `, such as ${first.label}` : ", which is of a single time"}.`;
    }
    return "";
  }
}
