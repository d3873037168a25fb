// Horizon, north and suns about the scene.

import { BufferGeometry, CanvasTexture, Group, Line, LineBasicMaterial, LineLoop, Sprite, SpriteMaterial, Vector3 } from "three";

const kGrey = "#88919a";
const kSun = "#e09b00";

function letter(text, color) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d", { willReadFrequently: true }); // drawn without the graphics: two letters
  pen.font = "bold 44px sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = color;
  pen.fillText(text, 32, 34);
  return new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false }));
}

function line(points, color, Kind = Line) {
  return new Kind(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color }));
}

/**
 * Horizon, north and suns about a place. @param radius  of the scene
 * @param north, suns  unit vectors towards them
 */
export function makeDirections(middle, radius, north, suns) {
  const group = new Group();
  const size = 1.15 * radius;
  const at = (v, far) => middle.clone().addScaledVector(new Vector3(...v), far);
  const addLetter = (text, color, place) => {
    const sprite = letter(text, color);
    sprite.position.copy(place);
    sprite.scale.setScalar(0.16 * radius);
    group.add(sprite);
  };
  const ring = [];
  for (let i = 0; i < 72; ++i) {
    const angle = (i * Math.PI) / 36;
    ring.push(at([Math.cos(angle), Math.sin(angle), 0], size));
  }
  group.add(line(ring, kGrey, LineLoop), line([at(north, 0.92 * size), at(north, 1.08 * size)], kGrey));
  addLetter("N", kGrey, at(north, 1.16 * size));
  for (const sun of suns.slice(0, 24)) {
    group.add(line([at(sun, 0.85 * size), at(sun, 1.25 * size)], kSun));
    addLetter("☀", kSun, at(sun, 1.33 * size));
  }
  return group;
}

/** Gives back what the graphics hold of a group of directions. */
export function disposeDirections(group) {
  group.children.forEach((child) => {
    child.geometry.dispose();
    child.material.map?.dispose();
    child.material.dispose();
  });
}
