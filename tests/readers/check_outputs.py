#!/usr/bin/env python3
"""Compares outputs of a run with those that convert makes of its JSON: check_outputs.py QUASIMC"""

import sys
import tempfile
from pathlib import Path

from program import run_in

RUN = """
bands = ["PAR", "NIR"]
[run]
paths = 64
ratios = ["PAR:NIR"]
{more}
[output]
json = "out.json"
vtp = "out.vtp"
ply = "out.ply"
glb = "out.glb"
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
[[organ]]
material = "leaf"
shape = "disk"
center = [0, 0, 1]
normal = [0, 0, 1]
radius = 1
[[organ]]
material = "leaf"
shape = "disk"
center = [0.5, 0, 0.5]
normal = [0, 0.2, 1]
radius = 1
"""
ONCE = """
[[source]]
type = "directional"
direction = [0.1, 0, -1]
irradiance_facing = 100
"""
DAY = """
[site]
latitude_deg = 50
longitude_deg = 8
[time]
day = "2024-06-21"
utc_offset_hours = 2
"""


def main():
    for more in (ONCE, DAY):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)

            def run(*command):
                run_in(folder, sys.argv[1], *command)

            (folder / "run.toml").write_text(RUN.format(more=more))
            run("run", "run.toml", "--quiet")
            for ending in ("vtp", "ply", "glb"):
                run("convert", "out.json", f"back.{ending}")
                ours = (folder / f"out.{ending}").read_bytes()
                assert ours == (folder / f"back.{ending}").read_bytes(), (ending, more)
            # Flags override the file.
            run("run", "run.toml", "--quiet", "--glb", "other.glb")
            assert (folder / "other.glb").read_bytes() == (folder / "out.glb").read_bytes()


main()
