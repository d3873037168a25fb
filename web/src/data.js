// The data of a run: elements of the page in a report, requests to the server otherwise.

import { kShares } from "./energy.js";
import { plainUnit, unitText } from "./format.js";
import { isOfSensors, weightsOf } from "./filters.js";
import { LayerAreas } from "./layer_areas.js";
import { shapeOf } from "./sensors.js";

/** The bytes of a base64 text. */
export function fromBase64(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) {
    bytes[i] = letters.charCodeAt(i);
  }
  return bytes.buffer;
}

function element(name) {
  return document.getElementById(name);
}

export async function request(name) {
  const answer = await fetch(name, { cache: "no-store" });
  if (!answer.ok) {
    throw new Error(`${name}: ${answer.status}`);
  }
  return answer;
}

export async function readJson(name) {
  const found = element(name);
  return found ? JSON.parse(found.textContent) : (await request(name)).json();
}

async function readBytes(name) {
  const found = element(name);
  if (!found) {
    return (await request(name)).arrayBuffer();
  }
  const bytes = fromBase64(found.textContent);
  found.remove(); // frees its text
  return bytes;
}

const shapes = new Map(); // promises, by name
const layers = new WeakMap(); // by shape

/** A shape that is read once: points of a sweep in a report share it. @param json  promise of its result */
function sharedShape(name, json) {
  const own = element(name)?.dataset.same ?? name;
  if (!shapes.has(own)) {
    shapes.set(own, Promise.all([readBytes(own), json]).then((both) => shapeOf(...both)));
  }
  return shapes.get(own);
}

const kNames = {
  absorbed_flux_density: "Absorbed per area", absorbed_flux: "Absorbed by organ", incident_upper: "Light on the upper side",
  incident_lower: "Light on the lower side", incident_direct: "Direct light on both sides",
  incident_scattered: "Scattered light on both sides", sunlit_fraction: "Sunlit fraction",
};

/** A kind of number in words. */
export function quantityName({ quantity, name }) {
  return kNames[quantity] ?? name[0].toUpperCase() + name.slice(1);
}

/** A band in words: names that are wavelengths have their unit. */
export const bandName = (band) => (/^(\d+: )?\d{3,4}(\.\d+)?$/.test(band) ? `${band}\u00a0nm` : band);

/** Means, standard errors, low and high ends from the bytes of all organs. */
function partsOf(bytes, n, factor) {
  const part = (k) => {
    const numbers = new Float32Array(bytes, 4 * n * k, n);
    return factor === 1 ? numbers : numbers.map((x) => x * factor);
  };
  return { mean: part(0), error: part(1), low: part(2), high: part(3) };
}

function oneOf(numbers, factor) {
  const [mean, error, low, high] = numbers.map((x) => x * factor);
  return { mean, error, low, high };
}

/** The data of a run; numbers of a time are read at the first request. */
export class RunData {
  /**
   * @param prefix  of the names of a point of a sweep
   * @param announce  called with the result before its shapes are read
   */
  static async load(prefix = "", announce = () => {}) {
    const reading = readJson(`${prefix}data`);
    const shape = sharedShape(`${prefix}shape`, reading);
    const colorMaps = (RunData.colorMaps ??= readJson("colors")); // points of a sweep share them
    const json = await reading;
    announce(json);
    const run = new RunData(json, await colorMaps, null, (blob) => readBytes(`${prefix}values-${blob}`));
    if (!element("data")) {
      run.readCourse = (column, organ) => request(`${prefix}course-${column}-${organ}`).then((answer) => answer.arrayBuffer());
    }
    run.shape = await shape;
    return run;
  }

  /**
   * @param shape  see readShape; null: it is set later
   * @param readBlob  returns a promise of the bytes of numbers, null if they are not available
   */
  constructor(json, colorMaps, shape, readBlob) {
    Object.assign(this, { json, colorMaps, shape, readBlob });
    this.count = json.organs.count;
    this.isGround = new Uint8Array(this.count);
    json.organs.ground.forEach((organ) => (this.isGround[organ] = 1));
    this.organCount = this.count - (json.sensors?.length ?? 0); // the others are sensors
    this.isSensor = new Uint8Array(this.count).fill(1, this.organCount);
    this.isPlant = this.isGround.map((ground, i) => (ground || this.isSensor[i] ? 0 : 1));
    this.isMeasured = isOfSensors(this);
    this.isCounted = this.isMeasured ? this.isSensor : this.isPlant; // in statistics
    this.countedNoun = this.isMeasured ? "sensor" : "organ";
    this.known = new Map();
    this.columns = json.columns
      .map((column, number) => ({ ...column, number }))
      .filter((column) => json.times.some((time) => time.values[column.number] >= 0));
  }

  /** How much each organ counts in scales, see weightsOf. */
  get weights() {
    return weightsOf(this, this.shape.areas);
  }

  /** The areas of organs in layers of height. What is at a limit but for rounding is above it. */
  get layers() {
    if (!layers.has(this.shape)) {
      layers.set(this.shape, new LayerAreas(this.shape, this.json.middle[2] + 1e-6 * (this.json.high[2] - this.json.low[2])));
    }
    return layers.get(this.shape);
  }

  /** Whether the page has the other points of its sweep. */
  get hasPoints() {
    return this.json.sweep?.points.length > 1;
  }

  /** By what the number of an organ is multiplied to add up over organs: its area, but 1 for flux and sensors. */
  weightOf(column, organ) {
    return this.isMeasured || this.json.columns[column].quantity === "absorbed_flux" ? 1 : this.shape.areas[organ];
  }

  has(time, column) {
    return this.json.times[time].values[column] >= 0;
  }

  /** {mean, error, low, high} of all organs, null if the result has none. A promise. */
  values(time, column) {
    return this.#valuesOf(this.json.times[time].values[column], this.factorOf(time, column));
  }

  #valuesOf(blob, factor) {
    if (blob < 0) {
      return Promise.resolve(null);
    }
    if (!this.known.has(blob)) {
      this.known.set(blob, this.readBlob(blob).then((bytes) => (bytes === null ? null : partsOf(bytes, this.count, factor))));
    }
    return this.known.get(blob);
  }

  /** Another result's values taken away; null if there is none. A promise. */
  difference(time, column) {
    const blob = this.json.times[time].minus?.[column] ?? -1;
    return this.#valuesOf(blob, this.factorOf(time, column));
  }

  /** {mean, error, low, high} of an organ at several times, null where it has none. A promise. */
  async course(times, column, organ) {
    if (this.readCourse) {
      const found = await this.readCourse(column, organ);
      const numbers = found && new Float32Array(found);
      return times.map((time) => numbers && this.has(time, column)
        ? oneOf(numbers.subarray(4 * time, 4 * time + 4), this.factorOf(time, column)) : null);
    }
    const all = await Promise.all(times.map((time) => this.values(time, column)));
    return all.map((values) => values && { mean: values.mean[organ], error: values.error[organ], low: values.low[organ], high: values.high[organ] });
  }

  #unitOf(time, column) {
    const part = this.json.times[time].part;
    const kind = this.json.columns[column];
    return plainUnit(part === "days" || part === "total" ? kind.sum_unit : kind.unit);
  }

  /** By which numbers of a column are multiplied to be in its unit. */
  factorOf(time, column) {
    return this.#unitOf(time, column).factor;
  }

  /** The unit of a column at a time: sums over days have another one. */
  unit(time, column) {
    const { unit } = this.#unitOf(time, column);
    return this.json.grows && this.json.columns[column].band ? kShares[unit] ?? unitText(unit) : unitText(unit);
  }

  /** The number of a column. -1: there is none */
  columnOf(quantity, band) {
    return this.json.columns.findIndex((column) => column.quantity === quantity && column.band === band);
  }

  columnName(column) {
    const kind = this.json.columns[column];
    return kind.band ? `${quantityName(kind)}, ${bandName(kind.band)}` : quantityName(kind);
  }

  /** The user's number of an organ, as text: it may exceed the exact integers of numbers. */
  idOf(organ) {
    return this.json.organs.id?.[organ] ?? String(organ + 1);
  }

  /** The index of an organ; -1 for unknown numbers. */
  organOfId(text) {
    const { id, count } = this.json.organs;
    const number = Number(text);
    return id ? id.indexOf(text) : String(number) === text && number >= 1 && number <= count ? number - 1 : -1;
  }

  organName(organ) {
    return this.json.organs.name?.[organ] || `organ ${this.idOf(organ)}`;
  }

  /** The label "kind" or "class" of an organ; "ground" or "sensor" for these, "" without labels. */
  kindOf(organ) {
    const kinds = this.json.organs.labels.kind ?? this.json.organs.labels.class;
    return this.isGround[organ] ? "ground" : this.isSensor[organ] ? "sensor" : kinds?.of[organ] >= 0 ? kinds.values[kinds.of[organ]] : "";
  }

  /** The result at a time without its organs: energy, groups, method. */
  headOf(time) {
    const { part, index } = this.json.times[time];
    const head = this.json.head;
    return part === "" ? head : part === "total" ? head.total : head[part][index];
  }
}
