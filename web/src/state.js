// What the user has chosen: one plain object, kept in the address of the page.

/** The choices of a fresh page. */
export const kStart = {
  quantity: "", band: "", show: "value", map: "viridis", sameScale: false, isLog: false, ends: null,
  time: "", by: "area", ground: true, directions: true, dome: false, shading: true, beside: false, cut: "", cutAt: 0.5,
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

/** Whether a value from an address can stand for a choice. */
function fits(value, usual) {
  if (usual === null) {
    return value === null || typeof value === "object" || typeof value === "number";
  }
  return typeof value === typeof usual && Array.isArray(value) === Array.isArray(usual) && value !== null;
}

/** The choices in an address; what can't be read is left out. */
export function readAddress(text, start = kStart) {
  const found = {};
  for (const pair of text.replace(/^#/, "").split("&").filter(Boolean)) {
    try {
      const [key, value] = pair.split("=").map(decodeURIComponent);
      const read = typeof start[key] === "string" ? value : JSON.parse(value);
      if (key in start && fits(read, start[key])) {
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
