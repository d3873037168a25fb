// Save: the picture with its legend, the table, and the address of the view.

import { byId, make } from "./dom.js";
import { tableText } from "./organ_table.js";

const kScale = 2; // pixels of the saved picture per pixel of the screen

function download(name, href) {
  make("a", { href, download: name }).click();
}

const token = (name) => getComputedStyle(byId("stage")).getPropertyValue(`--${name}`).trim();

/** A layer of vectors as a picture, with the styles that it has in the page. */
async function layerPicture(layer) {
  const copy = layer.cloneNode(true);
  const kStyles = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "opacity", "font-size", "font-family", "font-weight", "text-anchor", "dominant-baseline", "paint-order"];
  const own = [...layer.querySelectorAll("*")];
  copy.querySelectorAll("*").forEach((node, i) => kStyles.forEach((key) => node.setAttribute(key, getComputedStyle(own[i])[key.replace(/-./g, (x) => x[1].toUpperCase())])));
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", layer.clientWidth || layer.parentElement.clientWidth);
  copy.setAttribute("height", layer.clientHeight || layer.parentElement.clientHeight);
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await picture.decode();
  return picture;
}

/** Draws the legend as the page has it. */
function drawLegend(pen, page) {
  const { left, top } = byId("stage").getBoundingClientRect();
  const font = getComputedStyle(document.body).fontFamily;
  const write = (node, text = node.textContent) => {
    const box = node.getBoundingClientRect();
    const style = getComputedStyle(node);
    pen.font = `${style.fontWeight} ${style.fontSize} ${font}`;
    pen.fillStyle = style.color;
    pen.textBaseline = "middle";
    pen.fillText(text, box.left - left, box.top - top + Math.min(box.height, 1.5 * parseFloat(style.fontSize)) / 2);
  };
  [byId("legend-title"), byId("legend-note")].forEach((node) => write(node));
  byId("legend").querySelectorAll(".tick, .over, li span").forEach((node) => write(node));
  const boxOf = (node) => {
    const box = node.getBoundingClientRect();
    return [box.left - left, box.top - top, box.width, box.height];
  };
  byId("legend").querySelectorAll(".swatch, .quality i").forEach((node) => {
    pen.fillStyle = getComputedStyle(node).backgroundColor;
    pen.fillRect(...boxOf(node));
  });
  const bar = byId("legend-bar");
  if (bar) {
    const [x, y, width, height] = boxOf(bar);
    const isFlat = width > height;
    const run = isFlat ? pen.createLinearGradient(x, 0, x + width, 0) : pen.createLinearGradient(0, y + height, 0, y);
    page.map.forEach((rgb, i) => run.addColorStop(i / (page.map.length - 1), `rgb(${rgb.join(",")})`));
    pen.fillStyle = run;
    pen.fillRect(x, y, width, height);
  }
}

/** Letters of pinned organs. */
function drawBadges(pen) {
  byId("badges").querySelectorAll(".badge").forEach((badge) => {
    const [x, y] = [parseFloat(badge.style.left), parseFloat(badge.style.top)];
    pen.fillStyle = badge.style.backgroundColor;
    pen.beginPath();
    pen.arc(x, y, 9, 0, 2 * Math.PI);
    pen.fill();
    pen.fillStyle = "#ffffff";
    pen.font = `700 11px ${getComputedStyle(document.body).fontFamily}`;
    pen.textAlign = "center";
    pen.fillText(badge.textContent, x, y + 0.5);
    pen.textAlign = "start";
  });
}

/** What is seen of the scene, with its legend, as a canvas. @param window  the SceneWindow */
export async function scenePicture(page, window, scale = kScale) {
  const scene = window.copy(scale);
  const canvas = make("canvas", { width: scene.width, height: scene.height });
  const pen = canvas.getContext("2d");
  const ratio = scene.width / byId("canvas").clientWidth;
  pen.fillStyle = token("stage");
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.scale(ratio, ratio);
  const [width, height] = [canvas.width / ratio, canvas.height / ratio];
  const layers = await Promise.all(["behind", "before"].map((id) => layerPicture(byId(id))));
  pen.drawImage(layers[0], 0, 0);
  pen.drawImage(scene, 0, 0, width, height);
  pen.drawImage(layers[1], 0, 0);
  drawLegend(pen, page);
  drawBadges(pen);
  return canvas;
}

/** The menu of what can be saved. */
export class SaveMenu {
  constructor(page, window) {
    Object.assign(this, { page, window });
    this.menu = byId("save-menu");
    this.button = byId("save-button");
    const item = (text, act) => make("button", { type: "button", role: "menuitem", onclick: () => {
      this.close();
      act();
    } }, text);
    this.menu.append(...[
      window && item("Picture (PNG, twice the size, with legend)", () => this.savePicture()),
      item("Table of what is shown (CSV)", () => this.saveTable()),
      item("Link to this view", () => this.copyLink())].filter(Boolean));
    this.button.addEventListener("click", () => this.toggle());
    this.menu.addEventListener("keydown", (event) => this.#key(event));
    addEventListener("pointerdown", ({ target }) => !this.menu.parentElement.contains(target) && this.close());
  }

  toggle() {
    this.menu.hidden = !this.menu.hidden;
    this.button.setAttribute("aria-expanded", String(!this.menu.hidden));
    if (!this.menu.hidden) {
      this.menu.querySelector("button").focus();
    }
  }

  close() {
    this.menu.hidden = true;
    this.button.setAttribute("aria-expanded", "false");
  }

  #key(event) {
    const all = [...this.menu.querySelectorAll("button")];
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) {
      event.preventDefault();
      all[(all.indexOf(document.activeElement) + step + all.length) % all.length].focus();
    } else if (event.key === "Escape") {
      this.close();
      this.button.focus();
    }
    event.stopPropagation();
  }

  get #name() {
    return this.page.run.json.title.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "").slice(0, 60) || "scene";
  }

  async savePicture() {
    download(`${this.#name}.png`, (await scenePicture(this.page, this.window)).toDataURL("image/png"));
  }

  saveTable() {
    const url = URL.createObjectURL(new Blob([tableText(this.page)], { type: "text/csv" }));
    download(`${this.#name}.csv`, url);
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  async copyLink() {
    const text = this.page.address.addressOf();
    const link = `${location.href.split("#")[0]}${text ? `#${text}` : ""}`;
    await navigator.clipboard?.writeText(link).catch(() => {});
    this.page.say("The link is copied; it is also in the address of the page");
  }
}
