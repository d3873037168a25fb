#!/usr/bin/env python3
"""Reads the VTK files of quasimc, and compares them with its JSON: check_vtk.py QUASIMC"""

import json
import math
import sys
import tempfile
from pathlib import Path

from program import run_in
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

RUN = """
bands = ["PAR", "NIR"]
[run]
paths = 64
ratios = ["PAR:NIR"]
[[source]]
type = "directional"
direction = [0.1, 0, -1]
irradiance_facing = 100
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
[[organ]]
id = 17
name = "upper & left"
material = "leaf"
shape = "disk"
center = [0, 0, 1]
normal = [0, 0, 1]
radius = 1
[[organ]]
id = 3
name = "stem"
material = "leaf"
shape = "cylinder"
base = [0, 0, 0]
axis = [0, 0, 0.9]
radius = 0.1
"""


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def areas_of(mesh):
    """The area of each triangle."""
    areas = []
    for i in range(mesh.GetNumberOfCells()):
        cell = mesh.GetCell(i)
        assert cell.GetNumberOfPoints() == 3
        areas.append(cell.ComputeArea())
    return areas


def check_light(mesh, result):
    """Checks that every triangle has the numbers of its organ."""
    organs = {organ["id"]: organ for organ in result["organs"]}
    cells = mesh.GetCellData()
    names = [cells.GetArrayName(i) for i in range(cells.GetNumberOfArrays())]
    ids = [int(cells.GetArray("organ").GetValue(i)) for i in range(mesh.GetNumberOfCells())]
    assert set(ids) == set(organs)
    stored = mesh.GetFieldData().GetAbstractArray("organ_names")
    assert [stored.GetValue(i) for i in range(2)] == [o["name"] for o in result["organs"]]

    def compare(name, estimates):
        mean, error = cells.GetArray(name), cells.GetArray(error_of(name))
        for i, organ in enumerate(ids):
            assert mean.GetValue(i) == estimates[organ]["mean"], name
            expected = estimates[organ]["standard_error"]
            assert error.GetValue(i) == expected if expected is not None else math.isnan(error.GetValue(i))

    def error_of(name):
        word, _, unit = name.partition(" ")
        return f"{word}_standard_error" + (f" {unit}" if unit else "")

    compared = {"organ"}
    for quantity in result["quantities"]:
        for band, unit in quantity["unit"].items():
            name = f"{quantity['name']}_{band} [{unit}]"
            compare(name, {i: organ[quantity["name"]][band] for i, organ in organs.items()})
            compared |= {name, error_of(name)}
    compare("sunlit_fraction", {i: organ["sunlit_fraction"] for i, organ in organs.items()})
    compare("PAR:NIR", {i: organ["ratios"]["PAR:NIR"] for i, organ in organs.items()})
    compared |= {"sunlit_fraction", error_of("sunlit_fraction"), "PAR:NIR", error_of("PAR:NIR")}
    assert compared == set(names), compared ^ set(names)
    for id_, organ in organs.items():
        area = sum(area for area, of in zip(areas_of(mesh), ids) if of == id_)
        assert math.isclose(area, organ["area"], rel_tol=1e-12), (area, organ["area"])


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "run.toml").write_text(RUN)
        run_in(folder, sys.argv[1], "run", "run.toml", "--quiet", "--json", "out.json")
        run_in(folder, sys.argv[1], "convert", "out.json", "out.vtp")
        result = json.loads((folder / "out.json").read_text())
        mesh = read(vtkXMLPolyDataReader(), folder / "out.vtp")
        check_light(mesh, result)
        whole = sum(organ["area"] for organ in result["organs"])
        # Geometry as other VTK programs read it, in single precision.
        for ending, reader in (
            ("ply", vtkPLYReader()),
            ("obj", vtkOBJReader()),
            ("stl", vtkSTLReader()),
        ):
            run_in(folder, sys.argv[1], "convert", "run.toml", f"scene.{ending}")
            seen = read(reader, folder / f"scene.{ending}")
            assert seen.GetNumberOfCells() == mesh.GetNumberOfCells(), ending
            assert math.isclose(sum(areas_of(seen)), whole, rel_tol=1e-5), ending
            for ours, theirs in zip(mesh.GetBounds(), seen.GetBounds()):
                assert math.isclose(ours, theirs, abs_tol=1e-6), ending


main()
