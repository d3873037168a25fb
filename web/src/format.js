// Numbers, units and times as text.

import { isKnown, kSure, lowerMedian } from "./numbers.js";

export const kUnknownText = "–";
const kSigns = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
const raised = (number) => [...String(number)].map((sign) => kSigns[sign]).join("");

/** With a comma between thousands, from five digits on. */
function grouped(text) {
  const [whole, rest] = text.split(".");
  const digits = whole.replace("-", "").length;
  const parted = digits > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, ",") : whole;
  return (rest === undefined ? parted : `${parted}.${rest}`).replace(/^-/, "−");
}

/** A number rounded to a power of ten. */
function rounded(value, digit) {
  const text = grouped(digit >= 0 ? String(Math.round(value / 10 ** digit) * 10 ** digit) : value.toFixed(Math.min(100, -digit)));
  return /[1-9]/.test(text) ? text : text.replace("−", "");
}

/** Whether a number is written with a power of ten. */
const isFar = (size) => size !== 0 && (size < 1e-3 || size >= 1e7);

/** The power of ten by which a number is divided where it is written; 0 for those that are written as they are. */
export const powerOf = (size) => (isFar(size) ? Math.floor(Math.log10(size)) : 0);

/** A number with at most `digits` significant digits. */
export function plain(value, digits = 3) {
  if (!Number.isFinite(value)) {
    return kUnknownText;
  }
  const size = Math.abs(value);
  if (isFar(size)) {
    const [front, power] = value.toExponential(digits - 1).split("e");
    return `${String(Number(front)).replace("-", "−")} × 10${raised(Number(power))}`;
  }
  return grouped(String(Number(value.toPrecision(digits))));
}

/** A number with the digits that a list of numbers of a size has: `digits` of that size. */
export function evenly(value, size, digits = 3) {
  if (!(size > 0) || !Number.isFinite(value)) {
    return plain(value, digits);
  }
  const digit = Math.floor(Math.log10(size)) + 1 - digits;
  const text = rounded(value, digit);
  return value > 0 && Number(text) === 0 ? `<${rounded(10 ** digit, digit)}` : text;
}

/** A whole number, with commas. */
export const counted = (count) => String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, ",");

/** "1 organ", "12 organs" */
export const many = (count, noun) => `${counted(count)} ${noun}${count === 1 ? "" : "s"}`;

/** The power of ten of the last digit that an error supports: two digits if it begins with 1 or 2. */
function lastDigit(error) {
  const power = Math.floor(Math.log10(error));
  return error / 10 ** power < 2.95 ? power - 1 : power;
}

const kExact = 1e-7; // relative error below which a number is exact: the page's have 24 bits

/** For the end of the interval of a number that may be negative, as differences are. */
export const kSigned = null;

/**
 * The bound of a positive number that is known to no better than 50 %, or is 0 because no light was found: the end
 * of its interval; undefined for others, which have a value
 * @param high  that end; undefined: it follows from the error
 */
function boundOf(mean, error, high) {
  const end = Number.isFinite(high) ? high : mean + kSure * error;
  const isUnknown = error > 0.5 * mean || (mean === 0 && Number.isNaN(error));
  return high !== kSigned && mean >= 0 && isUnknown && end > 0 ? end : undefined;
}

/** A number rounded up, so that it remains a bound. */
const upTo = (digit, value) => Math.ceil(value / 10 ** digit - 1e-6) * 10 ** digit;

/** The power of ten by which a number is divided, and the power of its last digit. */
function styleOf(mean, error, bound) {
  const size = Math.max(Math.abs(mean), error || 0, bound ?? 0);
  return { power: powerOf(size), digit: bound === undefined ? lastDigit(error) : Math.floor(Math.log10(bound)) - 1 };
}

const powerText = (power) => `10${raised(power)}`;

/**
 * How a column of estimates is written: all with the last digit of the usual error, and with one power of ten, which
 * belongs into its head.
 * @param indices  of rows in mean and error  @param isSigned  whether they may be negative, as differences are
 * @returns {power, digit}
 */
export function columnStyle({ mean, error }, indices = [...mean.keys()], isSigned = false) {
  const rows = indices.filter((i) => (isSigned ? Number.isFinite(mean[i]) : isKnown(mean[i], error[i])) && mean[i] !== 0);
  const size = rows.reduce((most, i) => Math.max(most, Math.abs(mean[i])), 0);
  const usual = lowerMedian(rows.map((i) => (error[i] > kExact * Math.abs(mean[i]) ? error[i] : NaN)));
  const digit = usual > 0 ? lastDigit(usual) : size > 0 ? Math.floor(Math.log10(size)) - 2 : 0;
  return { power: powerOf(size), digit };
}

/** "10⁻⁵ mol" */
export const unitOfColumn = (unit, { power }) => (power === 0 ? unit : `${powerText(power)}${unit && `\u00a0${unit}`}`);

/** A positive number that is not 0 but would be written so is below the last digit. */
function errorText(error, { power, digit }) {
  const text = rounded(error / 10 ** power, digit - power);
  return Number(text) === 0 ? `<${rounded(10 ** (digit - power), digit - power)}` : text;
}

/**
 * A value with as many digits as its error supports.
 * @param high  end of its interval, which replaces a value that is known to no better than 50 %; kSigned: none does
 * @param column  see columnStyle; undefined: the number is alone
 * @returns {value, error}: texts; error is empty if it is unknown or 0
 */
export function estimate(mean, error, high, column) {
  if (!Number.isFinite(mean)) {
    return { value: kUnknownText, error: "" };
  }
  const isSmall = column && mean > 0 && mean < 0.5 * 10 ** column.digit && error > 0;
  const bound = boundOf(mean, isSmall ? Math.max(error, mean) : error, high);
  if (bound === undefined && !(error > kExact * Math.abs(mean))) {
    const isDark = mean === 0 && Number.isNaN(error);
    const text = column ? rounded(mean / 10 ** column.power, column.digit - column.power) : plain(mean, error >= 0 ? 4 : 3);
    return { value: isDark ? "0 (no light found)" : text, error: "" };
  }
  const style = column ?? styleOf(mean, error, bound);
  const { power, digit } = style;
  const write = (number) => rounded(number / 10 ** power, digit - power);
  const isRaised = power !== 0 && !column;
  if (bound !== undefined) {
    return { value: `below ${write(upTo(digit, bound))}${isRaised ? ` × ${powerText(power)}` : ""}`, error: "" };
  }
  const own = errorText(error, style);
  return isRaised ? { value: `(${write(mean)}`, error: `${own}) × ${powerText(power)}` } : { value: write(mean), error: own };
}

/** The ends of an interval with the digits of its estimate. @param isSigned  see kSigned  @param column  see estimate */
export function interval({ mean, error, low, high, isSigned }, column) {
  if (!Number.isFinite(low)) {
    return "";
  }
  const bound = boundOf(mean, error, isSigned ? kSigned : high);
  if (bound === undefined && !(error > 0)) {
    return [low, high].map((end) => plain(end, 3)).join(" – ");
  }
  const { power, digit } = column ?? styleOf(mean, error, bound);
  const ends = [low, bound === undefined ? high : upTo(digit, high)].map((end) => rounded(end / 10 ** power, digit - power)).join(" – ");
  return power !== 0 && !column ? `(${ends}) × ${powerText(power)}` : ends;
}

/** "32.75 ± 0.02" */
export function withError(mean, error, high, column) {
  const { value, error: own } = estimate(mean, error, high, column);
  return own ? `${value} ± ${own}` : value;
}

/** A number as text with its unit, if it has one: plants of simulators have none. */
export const withUnit = (text, unit) => (unit && text !== kUnknownText ? `${text}\u00a0${unit}` : text);

/** "0.6 %" */
export const percent = (part, digits = 2) => (Number.isFinite(part) ? `${plain(100 * part, digits)} %` : kUnknownText);

/** "87.1 ± 0.6 %", three digits where the error is not known. */
export const percentWithError = (part, error) => (error > 0 ? `${withError(100 * part, 100 * error)} %` : percent(part, 3));

/** "µmol m⁻² s⁻¹" of "umol m-2 s-1" */
export function unitText(unit) {
  return unit === "1" ? "" : unit.split(" ")
    .map((word) => word.replace(/^umol/, "µmol").replace(/^deg$/, "°").replace(/(?<=[A-Za-z])-?\d+$/, (power) => raised(power)))
    .join("\u00a0");
}

/** A unit that mixes lengths, "W m-2 cm2", as one that does not, and MJ for sums of days: {unit, factor}. */
export function plainUnit(unit) {
  if (unit === "J m-2") {
    return { unit: "MJ m-2", factor: 1e-6 };
  }
  const power = /^1e(-?\d+) (.*)$/.exec(unit);
  if (power) {
    return { unit: power[2], factor: 10 ** Number(power[1]) };
  }
  const kLengths = { mm: 1e-3, cm: 1e-2, dm: 0.1, km: 1e3 };
  const found = /^(.*?) ?m-2(.*) (mm|cm|dm|km|m)2$/.exec(unit);
  return found ? { unit: `${found[1]}${found[2]}`, factor: (kLengths[found[3]] ?? 1) ** 2 } : { unit, factor: 1 };
}

/** An area with its unit; small ones in square centimetres. */
export function areaText(area, unit) {
  return unit === "m" && area < 0.1 ? `${plain(1e4 * area, 3)}\u00a0cm²` : withUnit(plain(area, 3), unit && `${unitText(unit)}²`);
}

const kMonths = ["January", "February", "March", "April", "May", "June", "July", "August", "September", "October",
  "November", "December"];

/** {date, hour} of "2024-06-21T13:00+02:00" or "2024-06-21"; null for other labels. */
export function readTime(label) {
  const found = /^(-?\d{4,}-\d\d-\d\d)(?:T(\d\d):(\d\d)(?::(\d\d))?)?/.exec(label);
  return found && { date: found[1], hour: found[2] === undefined ? null : Number(found[2]) + Number(found[3]) / 60 + Number(found[4] ?? 0) / 3600 };
}

/** "21 June" or "21 June 2024" */
export function dateText(date, hasYear = false) {
  const [year, month, day] = date.split("-").map(Number);
  return `${day} ${kMonths[month - 1]}${hasYear ? ` ${year}` : ""}`;
}

/** "15 Jan" or "15 Jan 2024" */
export function shortDate(date, hasYear = false) {
  const [day, month, ...year] = dateText(date, hasYear).split(" ");
  return [day, month.slice(0, 3), ...year].join(" ");
}

/** "1 April to 30 September 2023" of "2023-04-01/2023-09-30", "21 June" of a single day. */
export function periodText(label) {
  const [first, last] = label.split("/");
  if (last === undefined || last === first) {
    return dateText(first);
  }
  const isOneYear = first.split("-").at(-3) === last.split("-").at(-3);
  return `${dateText(first, !isOneYear)} to ${dateText(last, true)}`;
}

/** "13:00" */
export function clockText(hour) {
  const minutes = Math.round(hour * 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
}
