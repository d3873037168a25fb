"""The same scene through Python and through the program gives the same bits."""

import csv
import json
import os
import subprocess

import numpy as np
import pytest

import quasimc
from canopies import leaves

PROGRAM = os.environ.get("QUASIMC_PROGRAM", "")
QUANTITIES = list(quasimc.quantities())

RUN_FILE = """
bands = ["PAR", "NIR"]
[run]
paths = 2048
method = "{method}"
seed = 5
[[source]]
type = "sun"
azimuth_deg = 135
elevation_deg = 50
irradiance_facing = [400, 380]
[[source]]
type = "sky"
model = "cie_overcast"
irradiance_horizontal = [80, 20]
[[material]]
name = "leaf"
reflectance = [0.08, 0.45]
transmittance = [0.06, 0.45]
[[material]]
name = "soil"
reflectance = [0.1, 0.2]
[ground]
material = "soil"
[cell]
x = [0, 1]
y = [0, 1]
"""


def of_the_program(path, organs):
    said = subprocess.run(
        [PROGRAM, "run", "-q", "--json", "-", str(path)], capture_output=True, text=True
    )
    assert said.returncode == 0, said.stderr
    result = json.loads(said.stdout)["organs"]
    assert len(result) == organs
    return result


def values_of(organs, bands):
    keys = ("mean", "standard_error", "ci95_low", "ci95_high")
    rows = [
        [[[organ[q][b][k] for k in keys] for b in bands] for q in QUANTITIES] for organ in organs
    ]
    return np.array(rows, dtype=float)


@pytest.mark.skipif(not PROGRAM, reason="the program was not built")
@pytest.mark.parametrize("method", ["auto", "light_tracing", "from_organs"])
def test_arrays_and_a_run_file_give_the_same_bits(tmp_path, method):
    vertices, faces, organ = leaves(15)
    text = RUN_FILE.format(method=method)
    for i in range(15):
        own = faces[2 * i : 2 * i + 2]
        text += (
            f'[[organ]]\nid = {organ[2 * i]}\nmaterial = "leaf"\nshape = "mesh"\n'
            f"vertices = {vertices[4 * i : 4 * i + 4].tolist()}\nfaces = {(own - 4 * i).tolist()}\n"
        )
    path = tmp_path / "canopy.toml"
    path.write_text(text)
    expected = values_of(of_the_program(path, 16), ["PAR", "NIR"])

    scene = quasimc.Scene(["PAR", "NIR"])
    scene.add_material("leaf", reflectance=[0.08, 0.45], transmittance=[0.06, 0.45])
    scene.add_material("soil", reflectance=[0.1, 0.2])
    scene.ground = quasimc.Ground("soil")
    scene.cell = quasimc.Cell(x=[0, 1], y=[0, 1])
    scene.add_mesh(vertices, faces, organ=organ, material="leaf")
    sun = quasimc.sun(azimuth_deg=135, elevation_deg=50, irradiance_facing=[400, 380])
    sky = quasimc.sky(irradiance_horizontal=[80, 20])
    result = scene.run([sun, sky], paths=2048, method=method, seed=5)
    assert np.array_equal(result._core.values, expected, equal_nan=True)

    loaded = quasimc.load(path).run()
    assert np.array_equal(loaded._core.values, expected, equal_nan=True)
    other = quasimc.load(path).run(seed=6)
    assert not np.array_equal(other._core.values, expected, equal_nan=True)


@pytest.mark.skipif(not PROGRAM, reason="the program was not built")
def test_the_examples_give_the_same_bits():
    path = os.path.join(os.environ["QUASIMC_SOURCE_DIR"], "examples", "01-leaves", "leaves.toml")
    scene = quasimc.load(path)
    organs = of_the_program(path, len(scene.organs))
    result = scene.run()
    expected = values_of(organs, result.bands)
    assert np.array_equal(result._core.values, expected, equal_nan=True)
    assert result.organs.ids.tolist() == [organ["id"] for organ in organs]
    assert result.organs.names == [organ["name"] for organ in organs]


@pytest.mark.skipif(not PROGRAM, reason="the program was not built")
def test_a_table_of_a_sweep_has_the_sums_of_python(tmp_path):
    vertices, faces, _ = leaves(6)
    options = {"paths": 4096, "replicates": 8, "sampler": "monte_carlo", "method": "light_tracing"}
    scene = quasimc.Scene(["PAR"])
    scene.add_material("leaf", reflectance=0.1, transmittance=0.3)
    text = 'bands = ["PAR"]\n[run]\nseed = 5\n'
    text += "".join(f"{key} = {value!r}\n" for key, value in options.items())
    text += '[[source]]\ntype = "sky"\nmodel = "uniform"\nirradiance_horizontal = 80\n'
    text += '[[material]]\nname = "leaf"\nreflectance = 0.1\ntransmittance = 0.3\n'
    for i in range(6):
        corners, own = vertices[4 * i : 4 * i + 4], faces[2 * i : 2 * i + 2] - 4 * i
        scene.add_mesh(corners, own, material="leaf")
        text += '[[organ]]\nmaterial = "leaf"\nshape = "mesh"\n'
        text += f"vertices = {corners.tolist()}\nfaces = {own.tolist()}\n"
    text += "[sweep]\nmaterial.leaf.reflectance = [0.1, 0.2, 0.6]\nweights = [1, 2, 5]\n"
    text += '[[table]]\nfile = "sum.csv"\nper = "sweep"\n'
    path = tmp_path / "sweep.toml"
    path.write_text(text)
    subprocess.run([PROGRAM, "run", "-q", str(path)], check=True)
    lines = (tmp_path / "sum.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))

    sky = quasimc.sky(model="uniform", irradiance_horizontal=80)
    values = {"materials.leaf.reflectance": [0.1, 0.2, 0.6]}
    swept = scene.sweep(values, sky, seed=5, **options)
    for quantity in QUANTITIES:
        mean = swept.sum(quantity, [1, 2, 5])["PAR"] / 8
        values, errors = (
            [float(row[f"{quantity}_PAR{end}"]) for row in rows] for end in ("", "_se")
        )
        np.testing.assert_allclose(values, mean.values, rtol=1e-12, err_msg=quantity)
        np.testing.assert_allclose(errors, mean.standard_error, rtol=1e-9, err_msg=quantity)
