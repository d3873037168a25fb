// Sensors in the scene: they are listed after the organs, have no area, and are drawn as octahedra.

import { readShape } from "./shape.js";

const kSize = 0.012; // radius of a mark, of the diagonal of the scene
const kApart = 0.3; // and at most, of the usual distance between two
const kTips = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
const kFaces = [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];

const distance = (one, other) => Math.hypot(...one.map((x, k) => x - other[k]));

/** The median distance between neighbours in the list; infinite for one. */
function usualDistance(positions) {
  const apart = positions.slice(1).map((position, i) => distance(position, positions[i])).filter((d) => d > 0).sort((a, b) => a - b);
  return apart[Math.floor(apart.length / 2)] ?? Infinity;
}

function joined(Type, one, other) {
  const all = new Type(one.length + other.length);
  all.set(one);
  all.set(other, one.length);
  return all;
}

/**
 * A shape with sensors as its last organs.
 * @param shape  see readShape
 * @param json  of the result: its sensors are positions about its middle
 */
function withSensors(shape, { sensors = [], low, high, middle }) {
  if (sensors.length === 0) {
    return shape;
  }
  const size = Math.min(kSize * distance(low, high), kApart * usualDistance(sensors)) || 1;
  const start = shape.vertices.length / 3;
  const each = (make) => sensors.flatMap(make);
  return {
    areas: joined(Float32Array, shape.areas, sensors.map(() => 0)),
    heights: joined(Float32Array, shape.heights, sensors.map((position) => middle[2] + position[2])),
    counts: joined(Uint32Array, shape.counts, sensors.map(() => kFaces.length / 3)),
    triangles: shape.triangles,
    vertices: joined(Float32Array, shape.vertices, each((position) => kTips.flatMap((tip) => tip.map((t, k) => position[k] + size * t)))),
    corners: joined(Uint32Array, shape.corners, each((_, i) => kFaces.map((corner) => start + kTips.length * i + corner))),
    first: joined(Uint32Array, shape.first, sensors.map((_, i) => start + kTips.length * (i + 1))),
  };
}

/** The shape of a scene with its sensors. @param bytes  see readShape  @param json  of the result */
export const shapeOf = (bytes, json) => withSensors(readShape(bytes, json.organs.count - (json.sensors?.length ?? 0)), json);
