// Numbers, units and times as text.

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
  return grouped(digit >= 0 ? String(Math.round(value / 10 ** digit) * 10 ** digit) : value.toFixed(-digit));
}

/** Whether a number is written with a power of ten. */
const isFar = (size) => size !== 0 && (size < 1e-3 || size >= 1e7);

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

/** A number with the digits that a list of numbers up to a size has. */
export const evenly = (value, size) => (size > 0 && !isFar(size) ? rounded(value, Math.max(-6, Math.floor(Math.log10(size)) - 2)) : plain(value));

/** A whole number, with commas. */
export const counted = (count) => String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, ",");

/** "1 organ", "12 organs" */
export const many = (count, noun) => `${counted(count)} ${noun}${count === 1 ? "" : "s"}`;

/** The power of ten of the last digit that an error supports: two digits if it begins with 1. */
function lastDigit(error) {
  const power = Math.floor(Math.log10(error));
  return error / 10 ** power < 1.95 ? power - 1 : power;
}

/** Two numbers to the same digit, as texts. */
function alike(mean, error) {
  const size = Math.abs(mean);
  if (!isFar(size)) {
    const digit = Math.max(lastDigit(error), -9);
    return [rounded(mean, digit), rounded(error, digit)];
  }
  const power = Math.floor(Math.log10(size));
  const digit = Math.min(0, lastDigit(error) - power);
  const [one, other] = [mean, error].map((x) => rounded(x / 10 ** power, digit));
  return [`(${one}`, `${other}) × 10${raised(power)}`];
}

/**
 * A value with as many digits as its error supports.
 * @param high  end of its interval, which replaces a value that is known to no better than 50 %
 * @returns {value, error}: texts; error is empty if it is unknown or 0
 */
export function estimate(mean, error, high) {
  if (!Number.isFinite(mean)) {
    return { value: kUnknownText, error: "" };
  }
  if (!Number.isFinite(error) || error === 0) {
    return { value: mean === 0 && Number.isNaN(error) ? "0 (no light found)" : plain(mean, 4), error: "" };
  }
  if (high !== undefined && error > 0.5 * Math.abs(mean)) {
    return { value: `below ${plain(high, 2)}`, error: "" };
  }
  const [value, own] = alike(mean, error);
  return { value, error: own };
}

/** The ends of an interval with the digits of its estimate. */
export function interval(low, high, error) {
  if (!Number.isFinite(low)) {
    return "";
  }
  const digit = error > 0 ? lastDigit(error) : 0;
  const isPlain = error > 0 && digit > -9 && !isFar(Math.abs(low)) && !isFar(Math.abs(high));
  return [low, high].map((end) => (isPlain ? rounded(end, digit) : plain(end, 3))).join(" – ");
}

/** "32.75 ± 0.02" */
export function withError(mean, error, high) {
  const { value, error: own } = estimate(mean, error, high);
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
