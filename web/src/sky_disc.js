// The sky of the time as a map of the hemisphere, north up, with the sun and its path.

import { byId, make, svg } from "./dom.js";
import { kRings, kSectors, skyColor } from "./dome.js";
import { many } from "./format.js";
import { lightsOf } from "./lights.js";

const kSize = 132;
const kRadius = 50;
const kMiddle = kSize / 2;
const kWinds = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

/** Between the middles of cells. */
function brightnessAt(cells, ring, sector) {
  const low = Math.min(kRings - 1, Math.max(0, Math.floor(ring)));
  const high = Math.min(kRings - 1, low + 1);
  const first = Math.floor(sector) % kSectors;
  const next = (first + 1) % kSectors;
  const [up, on] = [Math.min(1, Math.max(0, ring - low)), sector - Math.floor(sector)];
  const along = (k) => cells[k * kSectors + first] * (1 - on) + cells[k * kSectors + next] * on;
  return along(low) * (1 - up) + along(high) * up;
}

export class SkyDisc {
  constructor(page, parent, viewOf) {
    Object.assign(this, { page, parent, viewOf });
    this.canvas = make("canvas", { width: 200, height: 200, "aria-hidden": "true" });
    this.svg = svg("svg", { viewBox: `0 0 ${kSize} ${kSize}`, role: "img" });
    this.text = make("p");
    parent.append(this.canvas, this.svg, this.text);
  }

  /** The point of a unit vector on the map: azimuth around, height inwards. */
  #at([x, y, z]) {
    const [nx, ny] = this.page.run.json.north;
    const azimuth = Math.atan2(x * ny - y * nx, x * nx + y * ny);
    const far = (1 - Math.asin(Math.max(0, Math.min(1, z))) / (Math.PI / 2)) * kRadius;
    return [kMiddle + far * Math.sin(azimuth), kMiddle - far * Math.cos(azimuth)];
  }

  draw() {
    const { page, parent } = this;
    const lights = lightsOf(page);
    const hasSun = lights.suns.length > 0 || lights.paths.length > 0;
    parent.dataset.sky = lights.cells ? "yes" : "no";
    parent.hidden = page.isBeside || (!lights.cells && !hasSun);
    if (parent.hidden) {
      return;
    }
    this.canvas.hidden = !lights.cells;
    if (lights.cells) {
      this.#drawSky(lights.cells);
    }
    const paths = lights.paths.map((path) => svg("polyline", { class: "path", points: path.filter(([, , z]) => z > 0).map((v) => this.#at(v).join()).join(" ") }));
    const suns = lights.suns.filter(([, , z]) => z > 0).map((sun) => this.#at(sun)).map(([cx, cy]) => svg("circle", { class: "sun", cx, cy, r: 4.5 }));
    const rim = !lights.cells && svg("circle", { class: "rim", cx: kMiddle, cy: kMiddle, r: kRadius - 0.5 });
    const winds = [["N", 0, -1], ["E", 1, 0], ["S", 0, 1], ["W", -1, 0]].map(([letter, x, y]) => svg("text", { x: kMiddle + 59 * x, y: kMiddle + 59 * y }, letter));
    this.eye = svg("path", { class: "eye", d: "M0 -50l5 -8h-10z" });
    const words = this.#words(lights);
    this.svg.replaceChildren(...[svg("title", {}, words), rim, ...paths, ...suns, ...winds, this.eye].filter(Boolean));
    this.text.textContent = words;
    this.turned();
  }

  options() {
    this.draw();
  }

  #words({ suns, paths, cells }) {
    const [sun] = suns;
    if (suns.length > 1) {
      return many(suns.length, "sun");
    }
    if (!sun) {
      const way = paths.length > 1 ? "lowest, middle and highest path of the sun" : "sun’s path";
      const words = [...(cells ? [paths.length > 0 ? "mean sky" : "sky"] : []), ...(paths.length > 0 ? [way] : [])].join(", ");
      return words && words[0].toUpperCase() + words.slice(1);
    }
    const [nx, ny] = this.page.run.json.north;
    const azimuth = Math.atan2(sun[0] * ny - sun[1] * nx, sun[0] * nx + sun[1] * ny);
    const wind = kWinds[Math.round((azimuth / (2 * Math.PI)) * 8 + 8) % 8];
    const high = (Math.asin(sun[2]) * 180) / Math.PI;
    return high > 85 ? "Sun overhead" : high < 0 ? "Light from below" : `Sun ${Math.round(high)}° high, ${wind}`;
  }

  #drawSky(cells) {
    const pen = this.canvas.getContext("2d", { willReadFrequently: true });
    const { width } = this.canvas;
    const image = pen.createImageData(width, width);
    const [nx, ny] = this.page.run.json.north;
    for (let j = 0; j < width; ++j) {
      for (let i = 0; i < width; ++i) {
        const [x, y] = [(i + 0.5) / (width / 2) - 1, 1 - (j + 0.5) / (width / 2)];
        const far = Math.hypot(x, y);
        if (far <= 1) {
          // East is right of north; cells count from the x axis towards y.
          const around = Math.atan2(y * ny - x * nx, y * nx + x * ny);
          const color = skyColor(brightnessAt(cells, (1 - far) * kRings - 0.5, (around / (2 * Math.PI) + 1) * kSectors - 0.5));
          image.data.set([...color, 255], 4 * (j * width + i));
        }
      }
    }
    pen.putImageData(image, 0, 0);
  }

  /** A mark on the rim at the direction of the camera. */
  turned() {
    this.eye?.setAttribute("transform", `translate(${kMiddle} ${kMiddle}) rotate(${this.viewOf().azimuth.toFixed(1)})`);
  }
}
