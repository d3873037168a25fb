"""Sweeps over values of a scene."""

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy

SKY = quasimc.sky(irradiance_horizontal=[100, 50])


def test_points_are_runs_of_edited_scenes():
    scene = canopy()
    swept = scene.sweep(
        {"materials.leaf.reflectance": [0.1, 0.4], "paths": [256, 512]}, SKY, replicates=4
    )
    assert len(swept) == 4 and isinstance(swept[0], quasimc.Result)
    assert swept.points[1] == {"materials.leaf.reflectance": 0.1, "paths": 512}
    other = canopy()
    other.materials["leaf"].reflectance = 0.4
    alone = other.run(SKY, paths=256, replicates=4)
    assert np.array_equal(swept[2]["absorbed_flux"].values, alone["absorbed_flux"].values)
    assert scene == canopy(), "the scene is as it was"
    assert swept.to_pandas()["paths"].tolist()[0] == 256


def test_sums_over_points_pair_replicates():
    twice_as_bright = quasimc.sky(irradiance_horizontal=[200, 100])
    swept = canopy().sweep({"sources": [SKY, twice_as_bright]}, **FEW)
    once, twice = (result["absorbed_flux"]["PAR"].sum() for result in swept)
    both = swept.sum("absorbed_flux", [30, 31])["PAR"].sum()
    assert float(both) == pytest.approx(30 * float(once) + 31 * float(twice), rel=1e-12)
    # Both have the same random numbers: errors add up, and not their squares.
    error = 30 * float(once.standard_error) + 31 * float(twice.standard_error)
    assert float(both.standard_error) == pytest.approx(error, rel=0.01)
    assert both.unit == once.unit


def test_values_go_side_by_side():
    values = {"ground.height": [-1, -2], "seed": [1, 2]}
    swept = canopy().sweep(values, SKY, combine="zip", **FEW)
    assert [point["ground.height"] for point in swept.points] == [-1, -2]
    assert repr(swept) == "<Sweep: 2 points of ground.height, seed>"


@pytest.mark.parametrize(
    ("values", "keys", "error", "text"),
    [
        ({}, {}, quasimc.InputError, "nothing to sweep"),
        ({"paths": []}, {}, quasimc.InputError, "a list is empty"),
        ({"paths": [1, 2], "seed": [1]}, {"combine": "zip"}, quasimc.InputError, "different lengths"),
        ({"paths": [1]}, {"combine": "both"}, ValueError, "product"),
        ({"materials.lef.reflectance": [1]}, {}, KeyError, "did you mean 'leaf'"),
        ({"pathes": [1]}, {}, quasimc.KeywordError, "did you mean 'paths'"),
        ({"cell.x": [[0, 1]]}, {}, quasimc.InputError, "no cell"),
        ({"materials.leaf.reflectance": [2]}, {}, quasimc.InputError, "reflectance"),
    ],
)
def test_mistakes_are_refused_before_a_run(values, keys, error, text):
    with pytest.raises(error, match=text):
        canopy().sweep(values, SKY, **keys)


def test_a_quantity_of_a_sweep_is_asked_of_a_point_and_a_sum_has_a_weight_for_each():
    swept = canopy().sweep({"seed": [1, 2]}, SKY, **FEW)
    with pytest.raises(TypeError, match=r"sweep\[0\]\['absorbed_flux'\]"):
        swept["absorbed_flux"]
    with pytest.raises(ValueError, match="3 weights for 2 points"):
        swept.sum("absorbed_flux", [1, 2, 3])
