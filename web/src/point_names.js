// The names of the points of a sweep.

import { dateText, readTime, shortDate } from "./format.js";

/** The date of a value; null for other values, and for instants. */
const dateOf = (text) => {
  const time = readTime(text);
  return time && time.hour === null ? time.date : null;
};

/** "elevation 15°" for a key and its value, "15 January 2023" for a date. */
function valueName(key, text) {
  const date = dateOf(text);
  if (date) {
    return dateText(date, true);
  }
  const name = key.slice(key.lastIndexOf(".") + 1);
  return name.endsWith("_deg") ? `${name.slice(0, -4).replaceAll("_", " ")} ${text}°` : `${name.replaceAll("_", " ")} ${text}`;
}

function shortValue(key, text, isOneYear) {
  const date = dateOf(text);
  return date ? shortDate(date, !isOneYear) : key.endsWith("_deg") ? `${text}°` : text;
}

/** The number of a value, of dates that of the day; NaN for other texts. */
const numberOf = (text) => (dateOf(text) ? Date.parse(dateOf(text)) / 864e5 : text.trim() === "" ? NaN : Number(text));

/** The names of points: {name, short, by, value, isDate}: of a single key its name and number. @param points  texts of their values by key */
export function pointNames(points) {
  const years = new Set(points.flatMap((values) => Object.values(values).map(dateOf).filter(Boolean).map((date) => date.slice(0, -6))));
  return points.map((values) => {
    const pairs = Object.entries(values);
    return {
      name: pairs.map((pair) => valueName(...pair)).join(", "), short: pairs.map(([key, text]) => shortValue(key, text, years.size === 1)).join(", "),
      by: pairs.length === 1 ? pairs[0][0].split(".").at(-1).replace(/_deg$/, "").replaceAll("_", " ") : "",
      value: pairs.length === 1 ? numberOf(pairs[0][1]) : NaN, isDate: pairs.length === 1 && dateOf(pairs[0][1]) !== null,
    };
  });
}
