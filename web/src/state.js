// What the user has chosen: one plain object, kept in the address of the page.

/** The choices of a fresh page. */
const kStart = {
  quantity: "", band: "", show: "value", map: "viridis", sameScale: false, isLog: false, ends: null,
  time: "", by: "area", ground: true, sensors: true, directions: true, dome: false, shading: true, beside: false, neighbours: false, cut: "", cutAt: 0.5,
  labels: {}, ranges: {}, values: null, layer: null, errorClass: null, pins: [], view: null,
  panel: true, drawer: true, tab: "charts", theme: "", sort: "",
};

/** The choices of a fresh page in a window of this size. */
export function startOf(width, height) {
  const isPhone = width <= 640 && height >= 480;
  return { ...kStart, panel: isPhone || (width >= 1100 && height >= 480), drawer: isPhone || height >= 700 };
}

/** Choices as the part of an address behind "#": those that differ from a fresh page. */
export function addressOf(state, start = kStart) {
  const pairs = Object.keys(start)
    .filter((key) => JSON.stringify(state[key]) !== JSON.stringify(start[key]))
    .map((key) => [key, typeof start[key] === "string" ? state[key] : JSON.stringify(state[key])]);
  return pairs.map((pair) => pair.map(encodeURIComponent).join("=")).join("&");
}

const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
const isPair = (x) => Array.isArray(x) && x.length === 2 && x.every(isNumber);
const isTable = (x, fits) => typeof x === "object" && x !== null && !Array.isArray(x) && Object.values(x).every(fits);
const isList = (x) => Array.isArray(x) && x.every((one) => typeof one === "string");
/** Tests of choices whose type alone says too little. */
const kTests = {
  ends: isPair, values: isPair, layer: isPair, labels: (x) => isTable(x, isList), ranges: (x) => isTable(x, isPair),
  errorClass: (x) => Number.isInteger(x) && x >= 0 && x < 7, pins: (x) => Array.isArray(x) && x.every((one) => ["string", "number"].includes(typeof one)),
  view: (x) => isTable(x, (one) => isNumber(one) || Array.isArray(one)) && [x.azimuth, x.elevation, x.distance].every(isNumber) && x.distance > 0 &&
    Array.isArray(x.target) && x.target.length === 3 && x.target.every(isNumber),
};

/** The choices in an address; what can't be read is left out. */
export function readAddress(text, start = kStart) {
  const found = {};
  for (const pair of text.replace(/^#/, "").split("&").filter(Boolean)) {
    try {
      const [key, value] = pair.split("=").map(decodeURIComponent);
      const read = typeof start[key] === "string" ? value : JSON.parse(value);
      const isRight = kTests[key] ?? ((x) => typeof x === typeof start[key]);
      if (key in start && isRight(read)) {
        found[key] = read;
      }
    } catch {
      // Addresses are typed by people, and cut off by mail programs.
    }
  }
  return found;
}

/** Keeps the choices in the address, some time after the last change. */
export class AddressKeeper {
  /** @param addressOf  returns the address of now */
  constructor(addressOf) {
    this.addressOf = addressOf;
  }

  later() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      const text = this.addressOf();
      const { pathname, search } = location;
      try {
        history.replaceState(null, "", `${pathname}${search}${text ? `#${text}` : ""}`);
      } catch {
        location.replace(`#${text}`); // pages from a file, in some browsers
      }
    }, 300);
  }
}
