// What a result says of its sources, times and method, in the words and units of the page. Texts that are not known here
// only get the signs of units.

import { unitText } from "./format.js";

const kSkies = { perez: "Perez", preetham: "Preetham", cie_overcast: "overcast (CIE)", cie_clear: "clear (CIE)", uniform: "uniform" };
const kMethods = { first_hits: "first hits", light_tracing: "light tracing", ray_bundles: "ray bundles", from_organs: "paths from organs" };

const kUnits = /\b(?:umol|mol|[kM]?W|[kM]?J|lm|lx)(?: (?:s|h|d)-1| (?:m|cm|mm|km)-2)+|\bumol\b/g;

/** "1700 µmol s⁻¹", "52°" */
export const withSigns = (text) => text.replace(kUnits, (unit) => unitText(unit)).replace(/(\d) deg\b/g, "$1°");

const methodName = (name) => kMethods[name] ?? name;

/** "paths from organs; pilot runs: for equal work first hits would have 1.9 times the error" */
export function methodWords({ used, reason }) {
  const times = /^pilot runs: the error for equal work would be (.*)$/.exec(reason ?? "");
  const others = times && [...times[1].matchAll(/([\d.e+]+) times by (\w+)/g)].map(([, factor, name]) => `${methodName(name)} would have ${factor} times the error`);
  const why = others?.length > 0 ? `pilot runs: for equal work ${others.join(", ")}` : reason;
  return `${methodName(used)}${why ? `; ${why}` : ""}`;
}

/** "51.97° N, 5.67° E, 0 m above the sea" of a site, "Perez sky, overcast (CIE) where there is no sun" of a sky. */
export function timeWords(text) {
  const site = /^site: latitude (-?[\d.]+) deg, longitude (-?[\d.]+) deg \(east positive\), elevation (-?[\d.]+) m$/.exec(text);
  if (site) {
    const side = (value, [plus, minus]) => `${Math.abs(Number(value))}° ${Number(value) < 0 ? minus : plus}`;
    return `site: ${side(site[1], "NS")}, ${side(site[2], "EW")}, ${site[3]}\u00a0m above the sea`;
  }
  const sky = /^sky: (\w+); without direct light (\w+); (.*)$/.exec(text);
  return sky ? `sky: ${kSkies[sky[1]] ?? sky[1]} sky, ${kSkies[sky[2]] ?? sky[2]} where there is no sun; ${sky[3]}` : withSigns(text);
}

/** A source without its number and position, by which it is alike to others: {name, number, rest}; null without a number. */
function partsOf(source) {
  const found = /^(.*?) ?(\d+): (.*)$/.exec(source);
  return found && { name: found[1], number: found[2], rest: found[3].replace(/ at \([^)]*\),?/, "") };
}

/** Sources as sentences; those that are alike but for their positions are one: "hps 1 to 12: spot lamps, …" */
export function sourceWords(sources) {
  const groups = [];
  for (const source of sources) {
    const parts = partsOf(source);
    const last = groups.at(-1);
    if (parts && last?.parts && last.parts.name === parts.name && last.parts.rest === parts.rest) {
      last.all.push(parts.number);
    } else {
      groups.push({ source, parts, all: [parts?.number] });
    }
  }
  return groups.map(({ source, parts, all }) => withSigns(all.length > 1 ? `${parts.name} ${all[0]} to ${all.at(-1)}: ${all.length} alike, each a ${parts.rest}` : source));
}
