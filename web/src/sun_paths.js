// Suns, and their paths through days: a few of these stand for all.

const kPause = 2; // usual steps between directions: a longer one is a night
const kMaxSuns = 24; // beside each other; more are a path
const kParts = [0, 0.5, 1]; // of the days, by the height of their noon

/** The angle between unit vectors. */
const angle = (one, other) => Math.acos(Math.min(1, Math.max(-1, one.reduce((sum, x, k) => sum + x * other[k], 0))));

const medianOf = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

/** The mean of unit vectors as a unit vector; null for none. */
export function meanDirection(vectors) {
  const sum = vectors.reduce((all, v) => all.map((x, k) => x + v[k]), [0, 0, 0]);
  const length = Math.hypot(...sum);
  return length > 0 ? sum.map((x) => x / length) : null;
}

/** Directions in the order of time, divided at the nights. */
function daysOf(suns) {
  const steps = suns.slice(1).map((sun, i) => angle(suns[i], sun));
  const usual = medianOf(steps);
  const days = [];
  suns.forEach((sun, i) => {
    if (i === 0 || steps[i - 1] > kPause * usual) {
      days.push([]);
    }
    days.at(-1).push(sun);
  });
  return days;
}

/**
 * The paths of the days with the lowest, the median and the highest noon, of those days that are seen for long.
 * @param suns  unit vectors towards the sun in the order of time
 */
export function sunPaths(suns) {
  const noon = (day) => Math.max(...day.map(([, , z]) => z));
  const all = daysOf(suns);
  const usual = medianOf(all.map((day) => day.length));
  const days = all.filter((day) => day.length > 1 && day.length > usual / 2).sort((one, other) => noon(one) - noon(other));
  return [...new Set(kParts.map((part) => days[Math.round(part * (days.length - 1))]))].filter(Boolean);
}

/** The suns of a time, and the paths if they are such: a time with a clock has one sun, which moves. */
export function sunsOf(suns, { start }) {
  const mean = Number.isFinite(start) && meanDirection(suns);
  const own = mean ? [mean] : [...new Map(suns.map((v) => [v.map((x) => x.toFixed(3)).join(), v])).values()];
  return own.length > kMaxSuns ? { suns: [], paths: sunPaths(own) } : { suns: own, paths: [] };
}
