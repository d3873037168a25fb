#!/usr/bin/env python3
"""A plant whose buds live or die by the light on their leaves.

A small plant process that speaks the protocol of cpfg to QuasiMC over pipes: in each step it sends
all its leaves, and reads how much light each absorbed.  Every shoot grows by one leaf a step; the
bud at the base of a leaf makes a new shoot if its leaf has enough light, and a leaf in deep shade
falls.

    examples/03-coupled/plant.py [--steps N] [--program PATH] [--view]
"""

import argparse
import math
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent

GOLDEN_ANGLE = math.radians(137.5)
INTERNODE = 0.12
LEAF_LENGTH, LEAF_HALF_WIDTH = 0.3, 0.07
GROWTH = 0.35  # of a leaf's final size, each step
LIGHT_TO_BRANCH = 0.4  # light absorbed by a leaf that lets its bud grow out
LIGHT_TO_LIVE = 0.22
MOST_SHOOTS = 24


def add(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def cross(a, b):
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def unit(a):
    size = math.sqrt(sum(x * x for x in a))
    return tuple(x / size for x in a)


def turned(v, axis, angle):
    """v turned about a unit axis."""
    c, s = math.cos(angle), math.sin(angle)
    along = sum(x * y for x, y in zip(axis, v)) * (1 - c)
    return tuple(c * x + s * y + along * z for x, y, z in zip(v, cross(axis, v), axis))


@dataclass
class Leaf:
    position: tuple
    heading: tuple
    left: tuple
    up: tuple
    size: float = 0.2  # of its final size
    light: float = 1.0  # absorbed per area, from the last answer
    has_bud: bool = True


@dataclass
class Shoot:
    tip: tuple
    direction: tuple
    side: tuple
    leaves: list = field(default_factory=list)

    def grow(self):
        """Adds an internode, and a leaf at an angle of 60 degrees."""
        self.tip = add(self.tip, self.direction, INTERNODE)
        self.side = turned(self.side, self.direction, GOLDEN_ANGLE)
        left = cross(self.side, self.direction)
        heading = turned(self.direction, left, math.radians(60))
        self.leaves.append(Leaf(self.tip, unit(heading), unit(left), unit(cross(left, heading))))

    def branch(self, leaf):
        """Returns the shoot of a leaf's bud, half way between leaf and shoot."""
        leaf.has_bud = False
        direction = unit(add(self.direction, leaf.heading, 0.8))
        return Shoot(leaf.position, direction, unit(cross(direction, leaf.left)))


class Light:
    """The light program, in another process."""

    def __init__(self, program, words=()):
        self.process = subprocess.Popen(
            [program, "-e", "comm.e", *words, "light.qmc"],
            cwd=HERE,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        self.expect_sign()

    def expect_sign(self):
        if self.process.stdout.read(1) != b"\x01":
            sys.exit("plant.py: the light program does not answer")

    def send(self, text):
        self.process.stdin.write(text.encode())
        self.process.stdin.flush()

    def replies(self):
        """The answers up to the last chunk, as (id, light)."""
        while True:
            line = self.process.stdout.readline().decode()
            if not line:
                sys.exit("plant.py: the light program has ended")
            if line.startswith("Control"):
                if int(line.split()[1]) & 4:
                    return
                continue
            name, values = line.split(" E(")
            yield int(name), float(values.split(")")[0].split(",")[0])

    def ask(self, leaves, step):
        """Sends the leaves in chunks of 100 and takes the light on each."""
        chunks = [leaves[i : i + 100] for i in range(0, len(leaves), 100)]
        for number, chunk in enumerate(chunks):
            text = ""
            for i, leaf in enumerate(chunk, 100 * number):
                text += "%d E(%g)P(%g,%g)\n" % (
                    i,
                    leaf.light,
                    leaf.size * LEAF_HALF_WIDTH,
                    leaf.size * LEAF_LENGTH,
                )
                for vector in (leaf.position, leaf.heading, leaf.left, leaf.up):
                    text += " %g %g %g\n" % vector
            is_last = number + 1 == len(chunks)
            flags = (1 if number == 0 else 0) + (4 if is_last else 0)
            self.send(text + "Control: %d %d\n" % (flags, step if is_last else 0))
            if not is_last:
                self.process.stdout.readline()  # Control: 5, go on
        for i, light in self.replies():
            leaves[i].light = light

    def end(self):
        self.send("Control: 8 0\n")
        self.process.stdout.readline()
        self.expect_sign()
        return self.process.wait()


def report(step, shoots, leaves, fallen):
    lights = sorted(leaf.light for leaf in leaves)
    mean = sum(lights) / len(lights)
    print(
        f"step {step:2}: {len(shoots):2} shoots, {len(leaves):3} leaves, {fallen:3} fallen; "
        f"light on a leaf: mean {mean:.3f}, from {lights[0]:.3f} to {lights[-1]:.3f}"
    )


def grow(light, steps, pause=0.0):
    shoots = [Shoot((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))]
    fallen = 0
    for step in range(steps):
        for shoot in shoots:
            shoot.grow()
            for leaf in shoot.leaves:
                leaf.size = min(1.0, leaf.size + GROWTH)
        leaves = [leaf for shoot in shoots for leaf in shoot.leaves]
        light.ask(leaves, step)
        report(step, shoots, leaves, fallen)
        time.sleep(pause)
        for shoot in list(shoots):
            kept = [leaf for leaf in shoot.leaves if leaf.size < 1 or leaf.light > LIGHT_TO_LIVE]
            fallen += len(shoot.leaves) - len(kept)
            shoot.leaves = kept
            for leaf in kept:
                is_ready = leaf.has_bud and leaf.size >= 1 and leaf.light > LIGHT_TO_BRANCH
                if is_ready and len(shoots) < MOST_SHOOTS:
                    shoots.append(shoot.branch(leaf))


def wait_for_enter(text):
    """Waits for the Enter key, unless there is no terminal or the input has ended."""
    try:
        input(text + "\n")
    except EOFError:
        print("There is no terminal to press Enter on: continuing.")


def program_path(given):
    """The given program, or that beside the one under test, or the one that was built."""
    beside = os.path.join(os.path.dirname(os.environ.get("QUASIMC_PROGRAM", "")), "QuasiMC")
    for path in (given, beside, HERE.parents[1] / "build/release/bin/QuasiMC"):
        if path and Path(path).is_file():
            return str(Path(path).resolve())
    found = shutil.which("QuasiMC")
    return found or sys.exit("plant.py: QuasiMC is not built (./dev build)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=16)
    parser.add_argument("--program", help="the light program (default: the one built here)")
    parser.add_argument(
        "--view",
        action="store_true",
        help="show the steps in a browser, one a second; Enter begins and ends",
    )
    arguments = parser.parse_args()
    light = Light(program_path(arguments.program), ["--view"] if arguments.view else [])
    if arguments.view:
        wait_for_enter("Open the address above in a browser of this machine, then press Enter.")
    grow(light, arguments.steps, 1.0 if arguments.view else 0.0)
    if arguments.view:
        wait_for_enter("All steps are computed; the slider shows earlier ones. Enter ends.")
    return light.end()


if __name__ == "__main__":
    sys.exit(main())
