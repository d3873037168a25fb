// Sensors in the scene: they are listed after the organs, have no area, and are drawn as tiles or octahedra.

import { readShape } from "./shape.js";

const kSize = 0.012; // radius of a mark, of the diagonal of the scene
const kApart = 0.3; // and at most, of the usual distance between two
const kTile = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
const kTilePart = 0.45; // half a tile, of the distance between two
const kTips = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
const kFaces = [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];

const distance = (one, other) => Math.hypot(...one.map((x, k) => x - other[k]));

const medianOf = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

/** The median distance between neighbours in the list; infinite for one. */
const usualDistance = (positions) =>
  medianOf(positions.slice(1).map((position, i) => distance(position, positions[i])).filter((d) => d > 0)) ?? Infinity;

/** The distances between rows and columns of a horizontal grid: [along x, along y]; null for other positions. */
function gridOf(positions) {
  const steps = [0, 1].map((axis) => {
    const at = [...new Set(positions.map((position) => Number(position[axis].toPrecision(6))))].sort((a, b) => a - b);
    return { count: at.length, apart: medianOf(at.slice(1).map((x, i) => x - at[i])) };
  });
  const isFlat = positions.every((position) => position[2] === positions[0][2]);
  const isFull = positions.length > 3 && positions.length >= 0.5 * steps[0].count * steps[1].count;
  return isFlat && isFull && steps.every(({ count }) => count > 1) ? steps.map(({ apart }) => apart) : null;
}

/** The corners and faces of the mark of a sensor: a tile of a grid, which makes a map of it, or else an octahedron. */
function markOf(sensors, size) {
  const grid = gridOf(sensors);
  return grid ? { tips: kTile.map(([x, y]) => [kTilePart * x * grid[0], kTilePart * y * grid[1], 0]), faces: [0, 1, 2, 0, 2, 3] }
    : { tips: kTips.map((tip) => tip.map((t) => size * t)), faces: kFaces };
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
  const { tips, faces } = markOf(sensors, size);
  const start = shape.vertices.length / 3;
  const each = (make) => sensors.flatMap(make);
  return {
    areas: joined(Float32Array, shape.areas, sensors.map(() => 0)),
    heights: joined(Float32Array, shape.heights, sensors.map((position) => middle[2] + position[2])),
    counts: joined(Uint32Array, shape.counts, sensors.map(() => faces.length / 3)),
    triangles: shape.triangles,
    vertices: joined(Float32Array, shape.vertices, each((position) => tips.flatMap((tip) => tip.map((t, k) => position[k] + t)))),
    corners: joined(Uint32Array, shape.corners, each((_, i) => faces.map((corner) => start + tips.length * i + corner))),
    first: joined(Uint32Array, shape.first, sensors.map((_, i) => start + tips.length * (i + 1))),
  };
}

/** The shape of a scene with its sensors. @param bytes  see readShape  @param json  of the result */
export const shapeOf = (bytes, json) => withSensors(readShape(bytes, json.organs.count - (json.sensors?.length ?? 0)), json);
