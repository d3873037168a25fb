#!/usr/bin/env python3
"""Reads COLLADA that assimp writes: check_dae.py QUASIMC"""

import re
import sys
import tempfile
from pathlib import Path

from program import run_in

OBJ = """mtllib plant.mtl
o blade
v 0 0 1
v 2 0 1
v 2 3 1
v 0 3 1.5
usemtl green
f 1 2 3 4
o stalk
v 0 0 0
v 0.1 0 0
v 0 0 1
usemtl brown
f 5 6 7
"""
MTL = "newmtl green\nKd 0.1 0.5 0.3\nnewmtl brown\nKd 0.4 0.2 0.1\n"


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "plant.obj").write_text(OBJ)
        (folder / "plant.mtl").write_text(MTL)
        run_in(folder, "assimp", "export", "plant.obj", "plant.dae")
        assert "<COLLADA" in (folder / "plant.dae").read_text()
        numbers = {}
        for file in ("plant.obj", "plant.dae"):
            told = run_in(folder, program, "info", file)
            numbers[file] = [
                float(re.search(rf"\n{word}\s+([0-9.e-]+)", told).group(1))
                for word in ("organs", "triangles", "area")
            ]
        ours, theirs = numbers["plant.obj"], numbers["plant.dae"]
        assert ours[:2] == theirs[:2] == [2, 3], numbers
        assert abs(ours[2] - theirs[2]) < 1e-5 * ours[2], numbers
        # The bounds tell whether y, up in the file, has become z.
        told = run_in(folder, program, "info", "plant.dae")
        bounds = re.search(r"\nbounds\s+x (\S+) to (\S+) .*y (\S+) to (\S+) .*z (\S+) to (\S+) ", told)
        assert bounds, told
        low_high = [float(word) for word in bounds.groups()]
        assert max(abs(a - b) for a, b in zip(low_high, [0, 2, -1.5, 0, 0, 3])) < 1e-6, told
        assert "green" in told and "brown" in told, told

        (folder / "broken.dae").write_text(
            (folder / "plant.dae").read_text().replace("</float_array>", " x</float_array>", 1)
        )
        told = run_in(folder, program, "info", "broken.dae", status=1)
        assert re.search(r"broken\.dae:\d+: <float_array>: 'x' is not a finite number", told), told


main()
