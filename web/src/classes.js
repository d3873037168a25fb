// Classes of relative errors: the same colour is the same error everywhere.

export const kClasses = [
  { name: "below 1 %", short: "< 1", color: "#3a78a1", below: 0.01 },
  { name: "1 – 2 %", short: "1–2", color: "#59a4c0", below: 0.02 },
  { name: "2 – 5 %", short: "2–5", color: "#96d0d7", below: 0.05 },
  { name: "5 – 10 %", short: "5–10", color: "#f0dc7b", below: 0.1 },
  { name: "10 – 20 %", short: "10–20", color: "#fb9b20", below: 0.2 },
  { name: "20 – 50 %", short: "20–50", color: "#de3f25", below: 0.5 },
  { name: "over 50 %", short: "> 50", color: "#8a085a", below: Infinity },
];
export const kFaint = 7; // 0, or less than a thousandth of the mean: the error does not matter
export const kDark = 8; // no light was found
const kNoClass = 9; // no value, or no error
export const kGreys = [
  { number: kFaint, name: "too faint" }, { number: kDark, name: "no light found" }, { number: kNoClass, name: "not known" },
];
export const kGrey = "#7d8581";

/** The mean over area of the organs with a value. */
export function areaMean(mean, areas, isIn = () => true) {
  let [sum, area] = [0, 0];
  mean.forEach((value, i) => {
    if (Number.isFinite(value) && isIn(i)) {
      sum += value * areas[i];
      area += areas[i];
    }
  });
  return area > 0 ? sum / area : NaN;
}

/** The class of an estimate. @param usual  mean of all */
function classOf(mean, error, usual) {
  if (!Number.isFinite(mean)) {
    return kNoClass;
  }
  if (mean === 0 && error !== 0) {
    return kDark;
  }
  if (mean === 0 || Math.abs(mean) < 1e-3 * Math.abs(usual)) {
    return kFaint;
  }
  return Number.isFinite(error) ? kClasses.findIndex(({ below }) => error < below * Math.abs(mean)) : kNoClass;
}

/** The classes of all organs. @param values  see RunData.values */
export function classesOf({ mean, error }, areas) {
  const usual = areaMean(mean, areas);
  return Uint8Array.from(mean, (value, i) => {
    const found = classOf(value, error[i], usual);
    return found < 0 ? kClasses.length - 1 : found;
  });
}

export const classColor = (number) => kClasses[number]?.color ?? kGrey;
