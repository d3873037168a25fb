// Horizon, north, suns, lamps and sky around the scene.

import {
  BackSide, BufferGeometry, CanvasTexture, Color, Float32BufferAttribute, Group, Line, LineBasicMaterial, LineLoop, Mesh,
  MeshBasicMaterial, Sprite, SpriteMaterial, SRGBColorSpace, Vector3,
} from "three";

const kGrey = "#75808a";
const kSun = "#e09b00";
const kRings = 9; // rings of sky cells, from the horizon up
const kSectors = 36; // from the x axis towards y
const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
// Colours from black to the brightest sky; all are visible on white.
const kSky = [[12, 24, 70], [30, 80, 160], [96, 170, 225], [190, 225, 245]];

/** A sign of 64 x 64 pixels, drawn by `draw`. */
function sign(draw, color) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d", { willReadFrequently: true }); // on the CPU: there are few signs
  pen.fillStyle = pen.strokeStyle = color;
  pen.lineWidth = 5;
  draw(pen);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  return new Sprite(new SpriteMaterial({ map, depthTest: false }));
}

function drawNorth(pen) {
  pen.font = "bold 44px sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = "#3a434b"; // with a white rim, legible on any background
  pen.strokeStyle = "#ffffff";
  pen.lineWidth = 8;
  pen.strokeText("N", 32, 34);
  pen.fillText("N", 32, 34);
}

function drawDisk(pen, radius) {
  pen.beginPath();
  pen.arc(32, 32, radius, 0, 2 * Math.PI);
  pen.fill();
}

/** Drawn, as not every font has a symbol for it. */
function drawSun(pen) {
  drawDisk(pen, 15);
  pen.beginPath();
  for (let i = 0; i < 8; ++i) {
    const [x, y] = [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)];
    pen.moveTo(32 + 20 * x, 32 + 20 * y);
    pen.lineTo(32 + 30 * x, 32 + 30 * y);
  }
  pen.stroke();
}

function drawLamp(pen) {
  drawDisk(pen, 12);
  pen.beginPath();
  pen.arc(32, 32, 22, 0, 2 * Math.PI);
  pen.stroke();
}

function line(points, color, Kind = Line) {
  return new Kind(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color }));
}

/** The linear colour of a digit of the sky. */
function skyColor(digit) {
  const at = (kDigits.indexOf(digit) / 63) * (kSky.length - 1);
  const below = Math.min(kSky.length - 2, Math.floor(at));
  const rgb = kSky[below].map((low, k) => (low + (at - below) * (kSky[below + 1][k] - low)) / 255);
  return new Color().setRGB(...rgb, SRGBColorSpace).toArray();
}

/** The inner side of the sky's dome, cell by cell. Its near half is transparent. */
function makeDome(middle, size, sky) {
  const at = (ring, sector) => {
    const elevation = (ring * Math.PI) / 2 / kRings;
    const azimuth = (sector * 2 * Math.PI) / kSectors;
    return middle.clone().addScaledVector(new Vector3(
      Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation)), size);
  };
  const places = [];
  const colors = [];
  for (let i = 0; i < kRings * kSectors; ++i) {
    const [ring, sector] = [Math.floor(i / kSectors), i % kSectors];
    const [a, b, c, d] = [at(ring, sector), at(ring, sector + 1), at(ring + 1, sector + 1), at(ring + 1, sector)];
    const color = skyColor(sky[i]);
    for (const corner of [a, b, c, a, c, d]) {
      places.push(...corner);
      colors.push(...color);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  const dome = new Mesh(geometry, new MeshBasicMaterial({
    vertexColors: true, side: BackSide, transparent: true, opacity: 0.5, depthWrite: false, toneMapped: false,
  }));
  dome.renderOrder = -1;
  return dome;
}

/**
 * Horizon, north and sources around a point. @param radius  radius of the scene
 * @param north  unit vector  @param lights  {suns, lamps, sky} of a time
 * @param hasSky  whether the dome of the sky is shown, if there is one
 */
export function makeDirections(middle, radius, north, { suns, lamps, sky }, hasSky) {
  const group = new Group();
  const size = 1.1 * radius; // fits in the view of the whole scene
  const at = (v, far) => middle.clone().addScaledVector(new Vector3(...v), far);
  const addSign = (draw, color, place) => {
    const sprite = sign(draw, color);
    sprite.position.copy(place);
    sprite.scale.setScalar(0.16 * radius);
    group.add(sprite);
  };
  const ring = [];
  for (let i = 0; i < 72; ++i) {
    const angle = (i * Math.PI) / 36;
    ring.push(at([Math.cos(angle), Math.sin(angle), 0], size));
  }
  group.add(line(ring, kGrey, LineLoop), line([at(north, 0.92 * size), at(north, 1.04 * size)], kGrey));
  addSign(drawNorth, kGrey, at(north, 1.12 * size));
  for (const sun of suns.slice(0, 24)) {
    group.add(line([at(sun, 0.8 * size), at(sun, size)], kSun));
    addSign(drawSun, kSun, at(sun, 1.06 * size));
  }
  for (const lamp of lamps.slice(0, 100)) {
    const place = new Vector3(...lamp);
    const far = place.distanceTo(middle);
    // A lamp far away is drawn in its direction.
    addSign(drawLamp, kSun, far <= 2 * size ? place : place.sub(middle).multiplyScalar((1.1 * size) / far).add(middle));
  }
  if (hasSky && sky) {
    group.add(makeDome(middle, size, sky));
  }
  return group;
}

/** Frees the GPU memory of a group of directions. */
export function disposeDirections(group) {
  group.children.forEach((child) => {
    child.geometry.dispose();
    child.material.map?.dispose();
    child.material.dispose();
  });
}
