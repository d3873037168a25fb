#!/usr/bin/env python3
"""Writes what the statistical tests measured into the table of index.md.

    build/release/bin/quasimc_test_statistical --gtest_output=xml:measured.xml
    docs/validation/update_table.py measured.xml
"""

import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

PAGE = Path(__file__).resolve().parent / "index.md"
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
# Suites whose claims stand in the table of another.
PARTS_OF = {"Well": "FlatSurfaces", "UnderTheOtherSkies": "UnderSkies"}


def claims(xml):
    """(suite, claim, one of METHODS, expected, mean, standard error, resolution) of every test."""
    for case in ElementTree.parse(xml).iter("testcase"):
        suite = case.get("classname").split("/")[-1]
        suite = PARTS_OF.get(suite, suite)
        # What has no method in its name is traced from the organs.
        name = case.get("name")
        method = next((m for m in METHODS if name.endswith(m)), "from_organs")
        for item in case.iter("property"):
            numbers = [float(x) for x in item.get("value").split()]
            yield (suite, item.get("name"), method, *numbers)


def with_error(mean, error):
    """A number with two digits of its standard error."""
    if error < 1e-7 * abs(mean) or error == 0:
        return f"{mean:.6g}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if digits > 6:
        return f"{mean:.4g} ± {error:.1g}"
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def table(rows):
    """Lines of the table of one suite: {claim: {method: numbers}}."""
    yield "| Case | Expected | `light_tracing` | `first_hits` | `from_organs` | Resolution |\n"
    yield "|---|---|---|---|---|---|\n"
    for claim, found in rows.items():
        numbers = list(found.values())
        cells = [with_error(*found[m][1:3]) if m in found else "" for m in METHODS]
        resolution = ", ".join(dict.fromkeys(f"{n[3]:.2g}" for n in numbers))
        yield f"| {claim} | {numbers[0][0]:.6g} | {' | '.join(cells)} | {resolution} |\n"


def main():
    suites = {}
    for suite, claim, method, *numbers in claims(sys.argv[1]):
        suites.setdefault(suite, {}).setdefault(claim, {})[method] = numbers
    text = "".join(
        f"\n### {title}\n\n" + "".join(table(suites[suite])) for suite, title in TITLES.items()
    )
    page = PAGE.read_text(encoding="utf-8")
    pattern = re.compile(re.escape(BEGIN) + ".*?" + re.escape(END), re.S)
    PAGE.write_text(pattern.sub(lambda _: BEGIN + text + "\n" + END, page), encoding="utf-8")


if __name__ == "__main__":
    main()
