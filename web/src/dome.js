// The dome of the sky, and its colours.

import { BackSide, BufferGeometry, Color, Float32BufferAttribute, Mesh, MeshBasicMaterial, Scene, SRGBColorSpace, Vector3 } from "three";

export const kRings = 9; // rings of sky cells, from the horizon up
export const kSectors = 36; // from the x axis towards y
const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
// Colours from black to the brightest sky; all are visible on white.
const kSky = [[12, 24, 70], [30, 80, 160], [96, 170, 225], [190, 225, 245]];

/** The brightness of each cell of a sky relative to the brightest one, square roots. @param sky  base64 digits */
export function skyCells(sky) {
  return Float32Array.from(sky, (digit) => kDigits.indexOf(digit) / 63);
}

/** The mean of skies, brightest cell 1. */
export function meanSky(skies) {
  const sum = new Float32Array(kRings * kSectors);
  skies.forEach((sky) => skyCells(sky).forEach((cell, i) => (sum[i] += cell * cell)));
  const most = Math.max(...sum);
  return sum.map((cell) => Math.sqrt(cell / most));
}

/** The colour of a brightness between 0 and 1: bytes red, green, blue. */
export function skyColor(brightness) {
  const at = brightness * (kSky.length - 1);
  const below = Math.min(kSky.length - 2, Math.floor(at));
  return kSky[below].map((low, k) => Math.round(low + (at - below) * (kSky[below + 1][k] - low)));
}

/** The inner side of the dome, cell by cell; its near half is transparent. @param cells  see skyCells */
export function makeDome(middle, size, cells) {
  const at = (ring, sector) => {
    const elevation = (ring * Math.PI) / 2 / kRings;
    const azimuth = (sector * 2 * Math.PI) / kSectors;
    return middle.clone().addScaledVector(new Vector3(
      Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation)), size);
  };
  const vertices = [];
  const colors = [];
  for (let i = 0; i < kRings * kSectors; ++i) {
    const [ring, sector] = [Math.floor(i / kSectors), i % kSectors];
    const [a, b, c, d] = [at(ring, sector), at(ring, sector + 1), at(ring + 1, sector + 1), at(ring + 1, sector)];
    const color = new Color().setRGB(...skyColor(cells[i]).map((byte) => byte / 255), SRGBColorSpace).toArray();
    for (const corner of [a, b, c, a, c, d]) {
      vertices.push(...corner);
      colors.push(...color);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(vertices, 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  const dome = new Mesh(geometry, new MeshBasicMaterial({
    vertexColors: true, side: BackSide, transparent: true, opacity: 0.35, depthWrite: false, toneMapped: false,
  }));
  dome.frustumCulled = false;
  return new Scene().add(dome);
}

/** Frees the GPU memory of a dome. */
export function disposeDome(scene) {
  scene?.children.forEach(({ geometry, material }) => {
    geometry.dispose();
    material.dispose();
  });
}
