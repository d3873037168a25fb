#!/usr/bin/env python3
"""Writes the measurements of the statistical tests into the pages of validation.

    build/release/bin/quasimc_test_statistical --gtest_output=xml:measured.xml
    tools/update_validation.py measured.xml

Every case goes to docs/develop/notebook/validation-measured.md, those of SHOWN to
docs/theory/validation.md, between the lines BEGIN and END of each page.
"""

import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

DOCS = Path(__file__).resolve().parent.parent / "docs"
ALL, SELECTED = DOCS / "develop/notebook/validation-measured.md", DOCS / "theory/validation.md"
BEGIN, END = "<!-- measured: begin -->\n", "<!-- measured: end -->\n"
METHODS = ("light_tracing", "first_hits", "from_organs")
TITLES = {
    "FlatSurfaces": "Flat surfaces",
    "TrianglePair": "Two triangles face to face",
    "Layers": "Layers: nets, infinite sheets, periodic cells",
    "Solids": "Closed bodies",
    "UnderSkies": "Skies and the disk of the sun",
    "Lamps": "Lamps",
    "LampsAtSurfaces": "Lamps in and next to their housing",
    "LampsNearOrgans": "Lamps next to organs",
    "PeriodicLamps": "Lamps over periodic scenes",
    "Day": "Days",
    "Canopies": "Black and white canopies",
    "TurbidMedium": "Leaves that scatter, against the turbid medium",
}
# Suites whose claims are in the table of another suite.
PARTS_OF = {"Well": "FlatSurfaces", "UnderTheOtherSkies": "UnderSkies"}
# The claims that the page of theory shows, in its order.
SHOWN = (
    "1x1 black patch, absorbed",
    "L of two squares, wall absorbs",
    "1x2 rectangles, gap 0.5, lying, lower one",
    "coaxial disks, underside of the small one",
    "pair 0.1/0.2, upper one, absorbed",
    "3 nets tau 0.1",
    "5 nets tau 0.1, carried by a clear band",
    "periodic tile, sun at zenith angle 60, absorbed",
    "shadow domain, periodic along x and y, low plate",
    "2 sheets (0.1, 0.2, 0.3), uniform sky, absorbed by sheet 2",
    "2 sheets (0.3912, 0.4146, 0.2142), sun overhead, R",
    "2 sheets (0.3912, 0.4146, 0.2142), uniform sky, E on the soil",
    "sphere in a beam, mean over its surface",
    "convex organ under a uniform sky, cone",
    "integrating sphere, sun, rho 0.98",
    "hollow sphere with a hole, rho 0.9, E inside",
    "horizontal plate, perez",
    "vertical plate, overcast sky, one side",
    "black canopy LAI 1, overcast sky, absorbed",
    "floor under a roof, disk of the sun, irradiance",
    "disk lamp r 0.2 of exitance 1 over disk r 0.5, gap 0.5",
    "1x2 rectangle lamp of exitance 1 over a rectangle, gap 0.5",
    "sphere lamp in a grey box",
    "a point lamp 1e-06 below a grey disk: light on the disk below",
    "a point lamp 0.0001 above a leaf",
    "lamps that repeat over a floor",
    "clear day on a black plate, J m-2 of PAR",
    "black canopy LAI 1, sun at 36, sunlit fraction",
    "black canopy LAI 1, uniform sky, absorbed",
    "turbid sphere crown, x 3.75, transmitted",
    "white canopy LAI 5, uniform sky, E on upper sides",
    "turbid slab, LAI 3, zenith 0, NIR, A",
    "turbid slab, LAI 3, uniform sky, PAR, T",
    "turbid slab, LAI 3, uniform sky, NIR, R",
)


def claims(xml):
    """(suite, claim, one of METHODS, expected, mean, standard error, resolution) of every test."""
    for case in ElementTree.parse(xml).iter("testcase"):
        suite = case.get("classname").split("/")[-1]
        suite = PARTS_OF.get(suite, suite)
        # A test without a method in its name computes from the organs.
        name = case.get("name")
        method = next((m for m in METHODS if name.endswith(m)), "from_organs")
        for item in case.iter("property"):
            numbers = [float(x) for x in item.get("value").split()]
            claim = re.sub(r"(?<![\w.])\.(?=\d)", "0.", item.get("name"))
            yield (suite, claim, method, *numbers)


def with_error(mean, error):
    """A number with two digits of its standard error."""
    if error < 1e-7 * abs(mean) or error == 0:
        return f"{mean:.6g}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if digits > 6:
        return f"{mean:.4g} ± {error:.1g}"
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def table(rows):
    """The table of some claims, {claim: {method: numbers}}, as text."""
    lines = [f"| Case | Expected | {' | '.join(f'`{m}`' for m in METHODS)} | Resolution |"]
    lines.append("|---|---|---|---|---|---|")
    for claim, by_method in rows.items():
        numbers = list(by_method.values())
        cells = [with_error(*by_method[m][1:3]) if m in by_method else "" for m in METHODS]
        resolution = ", ".join(dict.fromkeys(f"{n[3]:.2g}" for n in numbers))
        lines.append(f"| {claim} | {numbers[0][0]:.6g} | {' | '.join(cells)} | {resolution} |")
    return "\n".join(lines) + "\n"


def replace_measured(page, text):
    """Puts text between the marks of a page."""
    pattern = re.compile(re.escape(BEGIN) + ".*?" + re.escape(END), re.S)
    new, count = pattern.subn(lambda _: f"{BEGIN}\n{text}\n{END}", page.read_text(encoding="utf-8"))
    if count != 1:
        sys.exit(f"{page}: has no lines '{BEGIN.strip()}' and '{END.strip()}'")
    page.write_text(new, encoding="utf-8")


def main():
    suites = {}
    for suite, claim, method, *numbers in claims(sys.argv[1]):
        suites.setdefault(suite, {}).setdefault(claim, {})[method] = numbers
    every = {claim: found for suite in TITLES for claim, found in suites[suite].items()}
    if missing := [claim for claim in SHOWN if claim not in every]:
        sys.exit(f"not measured: {missing}")
    sections = (f"### {title}\n\n{table(suites[suite])}" for suite, title in TITLES.items())
    replace_measured(ALL, "\n".join(sections))
    replace_measured(SELECTED, table({claim: every[claim] for claim in SHOWN}))


if __name__ == "__main__":
    main()
