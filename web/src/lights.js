// The lights of what is shown: suns, lamps and sky.

import { meanSky, skyCells } from "./dome.js";
import { meanDirection, sunPaths, sunsOf } from "./sun_paths.js";

/** The lights of what is shown: {paths, hours, suns, lamps, cells}; the path of the sun has its directions of each hour. */
export function lightsOf({ run, timeline, entry, time }) {
  const times = run.json.times;
  const own = times[time];
  const isSum = entry === timeline.total || timeline.days.includes(entry);
  const beside = times.length > 1 ? timeline.stepsOf(entry) : [];
  const hasHours = timeline.dates.length === 1 || (timeline.dates.length > 1 && entry !== timeline.total);
  const all = beside.flatMap(({ index }) => times[index].suns);
  const { suns, paths: ownPaths } = sunsOf(timeline.hasPeriods ? [] : own.suns, entry);
  const paths = own.paths?.length > 0 ? sunPaths(own.paths.flat()) : timeline.hasPeriods ? sunPaths(all) : hasHours && all.length > 1 ? [all] : ownPaths;
  const hours = hasHours ? beside.map(({ index }) => meanDirection(times[index].suns)).filter(Boolean) : [];
  const skies = isSum ? beside.map(({ index }) => times[index].sky).filter(Boolean) : own.sky ? [own.sky] : [];
  return { paths, hours, suns, lamps: own.lamps, cells: skies.length === 0 ? null : skies.length === 1 ? skyCells(skies[0]) : meanSky(skies) };
}
