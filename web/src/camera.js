// The position of the camera from which the plants fill what is free of the canvas.

import { Vector3 } from "three";

const kMaxPoints = 4000;
const kFill = 0.94; // of the free rectangle

/** Up to 4,000 points of the organs that are asked for. */
function someOf({ vertices, first }, isAsked) {
  const ranges = [];
  let count = 0;
  for (let organ = 0; organ + 1 < first.length; ++organ) {
    if (isAsked(organ)) {
      ranges.push([first[organ], first[organ + 1]]);
      count += first[organ + 1] - first[organ];
    }
  }
  const step = Math.max(1, Math.ceil(count / kMaxPoints));
  const points = [];
  let next = 0;
  for (const [from, to] of ranges) {
    for (; next < to - from; next += step) {
      points.push(new Vector3().fromArray(vertices, 3 * (from + next)));
    }
    next -= to - from;
  }
  return points;
}

/** {plants, all}: points of the plants, and those to be seen: with the ground, if it is hardly wider than the plants. */
export function pointsOf(shape, isGround) {
  const all = someOf(shape, () => true);
  const plants = someOf(shape, (organ) => !isGround[organ]);
  if (plants.length === 0) {
    return { plants: all.length > 0 ? all : [new Vector3()], all: all.length > 0 ? all : [new Vector3()] };
  }
  const ground = someOf(shape, (organ) => isGround[organ]);
  const size = (points) => boundsOf(points).high.distanceTo(boundsOf(points).low);
  return { plants, all: ground.length > 0 && size(ground) < 1.3 * size(plants) ? [...plants, ...ground] : plants };
}

/** Points around a box: those of an upright elliptic cylinder that touches its sides. */
export function pointsAround(low, high) {
  const kAround = 16;
  const [middle, half] = [low.clone().add(high).multiplyScalar(0.5), high.clone().sub(low).multiplyScalar(0.5)];
  return Array.from({ length: 2 * kAround }, (_, i) => {
    const angle = (2 * Math.PI * i) / kAround;
    return new Vector3(middle.x + half.x * Math.cos(angle), middle.y + half.y * Math.sin(angle), i < kAround ? low.z : high.z);
  });
}

/** The low and high corner of points. */
export function boundsOf(points) {
  const low = points[0].clone();
  const high = points[0].clone();
  points.forEach((point) => {
    low.min(point);
    high.max(point);
  });
  return { low, high };
}

/**
 * @param towards  unit vector from the scene to the camera
 * @param opening  tangents of half the angles that are free, to the side and up
 * @returns {target, distance}
 */
export function fitCamera(points, towards, [openX, openY]) {
  const flat = Math.hypot(towards.x, towards.y);
  const right = flat > 1e-6 ? new Vector3(-towards.y / flat, towards.x / flat, 0) : new Vector3(1, 0, 0);
  const up = towards.clone().cross(right);
  const { low, high } = boundsOf(points);
  const target = low.clone().add(high).multiplyScalar(0.5);
  const size = Math.max(low.distanceTo(high), 1e-30);
  const seen = points.map((point) => [point.dot(right), point.dot(up), point.dot(towards)]);
  let distance = 2 * size;
  for (let i = 0; i < 14; ++i) {
    const [x, y, z] = [target.dot(right), target.dot(up), target.dot(towards)];
    const ends = [Infinity, -Infinity, Infinity, -Infinity];
    for (const [px, py, pz] of seen) {
      const far = Math.max(distance - (pz - z), 1e-3 * size);
      ends[0] = Math.min(ends[0], (px - x) / far);
      ends[1] = Math.max(ends[1], (px - x) / far);
      ends[2] = Math.min(ends[2], (py - y) / far);
      ends[3] = Math.max(ends[3], (py - y) / far);
    }
    target.addScaledVector(right, ((ends[0] + ends[1]) / 2) * distance);
    target.addScaledVector(up, ((ends[2] + ends[3]) / 2) * distance);
    const needed = Math.max((ends[1] - ends[0]) / (2 * kFill * openX), (ends[3] - ends[2]) / (2 * kFill * openY));
    distance = Math.max(0.6 * size, distance * Math.min(2, Math.max(0.5, needed)));
  }
  return { target, distance };
}
