// The plant in its own colours, without light.

const kGround = [190, 170, 150];
const kKinds = [[150, 190, 110], [165, 125, 85], [205, 190, 95], [200, 110, 100], [140, 120, 180], [95, 160, 165]];

const packed = ([red, green, blue]) => red | (green << 8) | (blue << 16);

/** Colours of organs by their label "kind", red in the lowest of three bytes; green where there is none. */
export function plantColors(run) {
  const kinds = run.json.organs.labels.kind?.of;
  const kindOf = (organ) => Math.max(0, kinds?.[organ] ?? 0) % kKinds.length;
  return Int32Array.from({ length: run.count },
    (_, organ) => packed(!run.isPlant[organ] ? kGround : kKinds[kindOf(organ)]));
}
