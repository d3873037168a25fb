#!/usr/bin/env python3
"""Reads the GLB files of quasimc with assimp: check_glb.py QUASIMC"""

import re
import sys
import tempfile
from pathlib import Path

from program import run_in

RUN = """
bands = ["PAR"]
length_unit = "cm"
[run]
paths = 64
[[source]]
type = "directional"
direction = [0.1, 0, -1]
irradiance_facing = 100
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
[[material]]
name = "stem"
reflectance = 0.2
[[organ]]
name = "blade"
material = "leaf"
shape = "parallelogram"
corner = [0, 0, 50]
edge_a = [30, 0, 10]
edge_b = [0, 20, 0]
[[organ]]
name = "stalk"
material = "stem"
shape = "cylinder"
base = [0, 0, 0]
axis = [0, 0, 50]
radius = 2
"""


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def run(*command):
            return run_in(folder, *command)

        def info(path):
            return run(program, "info", path)

        (folder / "run.toml").write_text(RUN)
        run(program, "convert", "run.toml", "scene.glb")
        output = run("assimp", "info", "scene.glb")
        assert re.search(r"Meshes:\s+2\b", output), output
        assert "blade" in output and "stalk" in output, output
        assert re.search(r"Maximum point\s+\(0\.3\d*\s+0\.6\d*\s", output), output  # metres, y up

        # Writing and reading keeps areas and bounds of the scene, in metres.
        run("assimp", "export", "scene.glb", "back.obj")
        ours = float(re.search(r"\narea\s+(\S+)", info("scene.glb")).group(1))
        theirs = float(re.search(r"\narea\s+(\S+)", info("back.obj")).group(1))
        assert abs(ours - theirs) < 1e-5 * ours, (ours, theirs)

        run(program, "run", "run.toml", "--quiet", "--json", "out.json")
        run(program, "convert", "out.json", "light.glb")
        output = run("assimp", "info", "light.glb")
        assert re.search(r"Meshes:\s+1\b", output), output
        assert "error" not in output.lower(), output
        # assimp drops custom attributes, and keeps colours.
        run("assimp", "export", "light.glb", "light.ply")
        assert "red" in (folder / "light.ply").read_bytes()[:800].decode("ascii", "replace")


main()
