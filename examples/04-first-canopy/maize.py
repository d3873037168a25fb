#!/usr/bin/env python3
"""Writes maize.obj, a maize plant before flowering: a stem and its leaves, in metres, z up.

    python3 maize.py maize.obj
"""

import sys
from math import cos, exp, pi, radians, sin

LEAVES = 11
ALONG, ACROSS = 20, 6  # quadrilaterals of a blade
STEM_SIDES = 10


class Obj:
    """The lines of an OBJ file: points are numbered from 1."""

    def __init__(self):
        self.lines, self.points = [], 0

    def grid(self, name, material, rows):
        """A group: quadrilaterals between rows of points."""
        self.lines += [f"g {name}", f"usemtl {material}"]
        first, width = self.points + 1, len(rows[0])
        self.lines += [f"v {x:.4f} {y:.4f} {z:.4f}" for row in rows for x, y, z in row]
        self.points += len(rows) * width
        for i in range(len(rows) - 1):
            for j in range(width - 1):
                a = first + i * width + j
                self.lines.append(f"f {a} {a + 1} {a + 1 + width} {a + width}")


def stem_radius(z):
    return 0.014 - 0.008 * z


def stem(height):
    angles = [2 * pi * k / STEM_SIDES for k in range(STEM_SIDES + 1)]
    heights = [height * k / 6 for k in range(7)]
    return [[(stem_radius(z) * cos(a), stem_radius(z) * sin(a), z) for a in angles] for z in heights]


def blade(rank):
    """A leaf: the midrib bends from upright to hanging, the base clasps the stem."""
    age = 1 - rank / (LEAVES - 1)  # 1 at the lowest leaf
    height = 0.06 + 0.95 * (rank / LEAVES) ** 1.15
    length = 0.34 + 0.50 * exp(-(((rank - 6.2) / 3.6) ** 2))
    width = 0.040 + 0.058 * exp(-(((rank - 6.0) / 3.6) ** 2))
    bend = radians(78 + 48 * age + 12 * sin(2.7 * rank))
    turn = radians(9 * sin(1.9 * rank + 0.5)) + pi * (rank % 2)
    radius = stem_radius(height)

    rows, r, z = [], radius, height
    for i in range(ALONG + 1):
        s = i / ALONG
        angle = radians(14) + bend * s**1.4  # of the midrib from the vertical
        half = width / 2 * (0.62 + 0.38 * sin(pi * min(1, s / 0.45) / 2)) * (1 - s**2.4) ** 0.8
        fold = radians(52 * exp(-3.2 * s) + 8)  # of each half, above the plane across the midrib
        clasp = exp(-((s / 0.045) ** 2))
        row = []
        for j in range(ACROSS + 1):
            u = 2 * j / ACROSS - 1
            wave = 0.014 * length * sin(2 * pi * (4.2 * s + 0.13 * rank) + (1.3 if u > 0 else 0)) * u * u * sin(pi * s)
            lift = half * abs(u) * sin(fold) + wave
            side = half * u * cos(fold)
            # The normal of the midrib points up and towards the stem.
            x, y, h = r - lift * cos(angle), side, z + lift * sin(angle)
            round_x, round_y = radius * 1.15 * cos(u * 2.4), radius * 1.15 * sin(u * 2.4)
            x, y = x + (round_x - x) * clasp, y + (round_y - y) * clasp
            row.append((x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn), h))
        rows.append(row)
        r, z = r + length / ALONG * sin(angle), z + length / ALONG * cos(angle)
    return rows


def main():
    plant = Obj()
    plant.lines.append("# A maize plant before flowering, metres, z up: a stem and its leaves. Made by maize.py.")
    plant.grid("stem", "stem", stem(0.93))
    for rank in range(LEAVES):
        plant.grid(f"leaf {rank + 1}", "leaf", blade(rank))
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write("\n".join(plant.lines) + "\n")


if __name__ == "__main__":
    main()
