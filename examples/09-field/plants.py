#!/usr/bin/env python3
"""Makes the plants of the field examples: tree.obj, conifer.obj, bean.obj. Metres, z up.

The names of their parts say what they are: "layer2" over "leaf14", "trunk". Run files turn them
into labels (labels_from).
"""

import math
import random


class Obj:
    """A mesh with named parts."""

    def __init__(self, path, comment):
        self.file = open(path, "w", encoding="utf-8")
        self.file.write(f"# {comment} Made by plants.py.\n")
        self.count = 0

    def part(self, key, name):
        self.file.write(f"{key} {name}\n")

    def surface(self, material, points, faces):
        self.file.write(f"usemtl {material}\n")
        for x, y, z in points:
            self.file.write(f"v {x:.4f} {y:.4f} {z:.4f}\n")
        for face in faces:
            self.file.write("f " + " ".join(str(self.count + i + 1) for i in face) + "\n")
        self.count += len(points)

    def leaf(self, base, azimuth, elevation, length, width):
        """A leaf of two halves that are folded along the midrib."""
        along = (
            math.cos(elevation) * math.cos(azimuth),
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
        )
        across = (-math.sin(azimuth), math.cos(azimuth), 0)
        lift = 0.25 * width

        def at(u, v, up=0.0):
            return tuple(b + u * length * a + v * width * c for b, a, c in zip(base, along, across))[:2] + (
                base[2] + u * length * along[2] + up,
            )

        self.surface("leaf", [base, at(0.5, -0.5, lift), at(1, 0), at(0.5, 0.5, lift)], [(0, 1, 2), (0, 2, 3)])

    def trunk(self, radius, height, sides=8):
        ring = [(math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides)) for i in range(sides)]
        low = [(radius * x, radius * y, 0) for x, y in ring]
        high = [(0.4 * radius * x, 0.4 * radius * y, height) for x, y in ring]
        faces = [(i, (i + 1) % sides, sides + (i + 1) % sides, sides + i) for i in range(sides)]
        self.surface("wood", low + high, faces)


def tree():
    """A tree of a hedgerow, 3.2 m high: a flat crown along y, in four layers of 0.7 m."""
    random.seed(5)
    obj = Obj("tree.obj", "A fruit tree of a hedgerow.")
    obj.part("o", "trunk")
    obj.trunk(0.04, 3.0)
    for layer in range(4):
        obj.part("o", f"layer{layer + 1}")
        for i in range(90):
            obj.part("g", f"leaf{i + 1}")
            base = (
                random.gauss(0, 0.22),
                random.uniform(-0.6, 0.6),
                0.4 + 0.7 * (layer + random.random()),
            )
            obj.leaf(base, random.uniform(0, 2 * math.pi), random.uniform(-0.9, 0.6), 0.16, 0.1)


def conifer():
    """A conifer of a forest, 20 m high: shoots as flat fans in whorls."""
    random.seed(7)
    obj = Obj("conifer.obj", "A conifer of a forest.")
    obj.part("o", "trunk")
    obj.trunk(0.18, 19)
    obj.part("o", "crown")
    for whorl in range(26):
        height = 7 + 12.8 * whorl / 26
        reach = 2.6 * (1 - (height - 7) / 14)
        for i in range(12):
            azimuth = 2 * math.pi * (i + random.random()) / 12
            for part in range(3):
                start = 0.15 + 0.28 * part * reach
                base = (start * math.cos(azimuth), start * math.sin(azimuth), height - 0.12 * start)
                obj.part("g", f"shoot{whorl}_{i}_{part}")
                obj.leaf(base, azimuth + random.gauss(0, 0.5), random.gauss(-0.25, 0.2), 0.3 + 0.3 * reach, 0.45)


def bean():
    """A bean plant, 0.45 m high: leaves of three leaflets."""
    random.seed(3)
    obj = Obj("bean.obj", "A bean plant.")
    for i in range(14):
        azimuth = 2.4 * i
        height = 0.06 + 0.026 * i
        reach = 0.12 - 0.004 * i
        end = (reach * math.cos(azimuth), reach * math.sin(azimuth), height + 0.05)
        obj.part("g", f"leaf{i + 1}")
        for turn in (-1.4, 0, 1.4):
            obj.leaf(end, azimuth + turn, random.uniform(-0.5, 0.2), 0.085, 0.06)


if __name__ == "__main__":
    tree()
    conifer()
    bean()
