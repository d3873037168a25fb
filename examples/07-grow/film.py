#!/usr/bin/env python3
"""Draws steps of a growing plant side by side, as the eye sees them in sun and sky.

    examples/07-grow/film.py tree -o tree.png
    examples/07-grow/film.py tree --steps 30 --light -o light.png

Runs `quasimc grow --series`, puts the plants of some steps in one scene, in metres, and draws it
by `quasimc run` and `quasimc show`.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass
class Film:
    """What is drawn of a model: steps, and lengths in m."""

    steps: tuple
    spacing: float
    depth: float  # of the soil
    camera: str = "180,8"
    size: str = "1600x600"


FILMS = {
    "tree": Film((6, 12, 18, 24, 30), 1.2, 1.6),
    "competition": Film((20, 35), 1.5, 1.2, size="1600x640"),
    "sward": Film((8, 16, 24), 0.55, 0.6, "180,18", "1600x520"),
    "vine": Film((14, 22, 34), 2.4, 1.0, "176,8", "1600x480"),
}

SCENE = """
title = "Growth"
band = [{ name = "blue", from_nm = 400, to_nm = 500 },
        { name = "green", from_nm = 500, to_nm = 600 },
        { name = "red", from_nm = 600, to_nm = 700 }]
run = { paths = 65536 }
output = { json = "film.json" }
[[source]]
type = "sun"
azimuth_deg = 235
elevation_deg = 48
irradiance_facing = [115, 130, 125]
[[source]]
type = "sky"
model = "cie_clear"
irradiance_horizontal = [42, 34, 26]
"""

# Reflectance in blue, green and red by the colour of the turtle; leaves transmit light too.
REFLECTANCES = {
    "color 1": (0.06, 0.09, 0.13),  # wood
    "color 2": (0.035, 0.12, 0.055),  # leaf
    "color 3": (0.05, 0.18, 0.11),  # light leaf
    "color 4": (0.05, 0.15, 0.08),  # green stem
    "color 5": (0.18, 0.23, 0.28),  # post
    "color 6": (0.06, 0.05, 0.30),  # red
    "color 7": (0.45, 0.48, 0.52),  # white
    "color 8": (0.16, 0.07, 0.14),  # grape
    "soil": (0.25, 0.32, 0.36),
}
LEAVES = ("color 2", "color 3")


def program_path(given):
    """The given program, or that under test, or the one that was built."""
    built = HERE.parents[1] / "build/release/bin/quasimc"
    for path in (given, os.environ.get("QUASIMC_PROGRAM", ""), built):
        if path and Path(path).is_file():
            return str(Path(path).resolve())
    return shutil.which("quasimc") or sys.exit("film.py: quasimc is not built (./dev build)")


def materials():
    for name, reflectance in REFLECTANCES.items():
        transmittance = [0.7 * r if name in LEAVES else 0 for r in reflectance]
        yield (
            f'[[material]]\nname = "{name}"\nreflectance = {list(reflectance)}\n'
            f"transmittance = {transmittance}\n"
        )


def scene(film):
    """The run file of steps side by side. South, +x of the models, is on the left, at the sun."""
    half_width = film.spacing * len(film.steps) / 2
    yield SCENE
    yield f'[ground]\nmaterial = "soil"\nx = [{-half_width}, {half_width}]\n'
    yield f"y = [{-film.depth / 2}, {film.depth / 2}]\n"
    yield from materials()
    for i, step in enumerate(film.steps):
        x = film.spacing * (i + 0.5) - half_width
        yield f'[[geometry]]\nfile = "step_{step:03}.glb"\nname = "step {step}"\n'
        yield f"at = [[{x}, 0, 0, 180, 0.01]]\n"  # from cm


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", choices=FILMS)
    parser.add_argument("-o", "--output", default="film.png")
    parser.add_argument("--steps", type=int, nargs="+", help="the steps to draw")
    parser.add_argument("--size", help="of the picture: 800x900")
    parser.add_argument("--light", action="store_true", help="colour organs by absorbed red light")
    parser.add_argument("--program", help="quasimc (default: the one built here)")
    arguments = parser.parse_args()
    program, output = program_path(arguments.program), Path(arguments.output).resolve()
    film = FILMS[arguments.model]
    film.steps = arguments.steps or film.steps
    with tempfile.TemporaryDirectory() as folder:

        def quasimc(*words):
            subprocess.run([program, *words], cwd=folder, check=True)

        quasimc("grow", str(HERE / f"{arguments.model}.l"), "--series", ".", "--quiet")
        Path(folder, "film.toml").write_text("".join(scene(film)), encoding="utf-8")
        quasimc("run", "film.toml", "--quiet")
        colors = ["--band", "red"] if arguments.light else ["--realistic", "--no-annotations"]
        view = ["--camera", film.camera, "--fov", "20", "--size", arguments.size or film.size]
        quasimc("show", "film.json", "-o", str(output), *colors, *view)


if __name__ == "__main__":
    main()
