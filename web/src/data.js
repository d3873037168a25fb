// The data of a run: elements of the page in a report, requests to the server otherwise.

import { readShape } from "./shape.js";

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

/** The data of a run; numbers of a time are read at the first request. */
export class RunData {
  static async load() {
    const shape = readBytes("shape");
    const colorMaps = readJson("colors");
    const run = new RunData(await readJson("data"), await colorMaps, null, (blob) => readBytes(`values-${blob}`));
    if (run.columns.length > 0) {
      run.values(0, run.columns[0].number); // shown first: loads together with the shape
    }
    run.shape = readShape(await shape, run.count);
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
    this.known = new Map();
    this.columns = json.columns
      .map((column, number) => ({ ...column, number }))
      .filter((column) => json.times.some((time) => time.values[column.number] >= 0));
  }

  has(time, column) {
    return this.json.times[time].values[column] >= 0;
  }

  /** {mean, error, low, high} of all organs, null if the result has none. A promise. */
  values(time, column) {
    const blob = this.json.times[time].values[column];
    if (blob < 0) {
      return Promise.resolve(null);
    }
    if (!this.known.has(blob)) {
      const n = this.count;
      this.known.set(
        blob,
        this.readBlob(blob).then((bytes) => {
          if (bytes === null) {
            return null;
          }
          const part = (k) => new Float32Array(bytes, 4 * n * k, n);
          return { mean: part(0), error: part(1), low: part(2), high: part(3) };
        }),
      );
    }
    return this.known.get(blob);
  }

  /** The unit of a column at a time: sums over days have another one. */
  unit(time, column) {
    const part = this.json.times[time].part;
    const kind = this.json.columns[column];
    return part === "days" || part === "total" ? kind.sum_unit : kind.unit;
  }

  columnName(column) {
    const kind = this.json.columns[column];
    return kind.band ? `${kind.name}, ${kind.band}` : kind.name;
  }

  timeName(time) {
    const { part, label } = this.json.times[time];
    return part === "total" ? "sum of all times" : label;
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

  /** The result at a time without its organs: energy, groups, method. */
  headOf(time) {
    const { part, index } = this.json.times[time];
    const head = this.json.head;
    return part === "" ? head : part === "total" ? head.total : head[part][index];
  }
}
