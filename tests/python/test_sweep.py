"""Sweeps over values of a scene."""

import pickle

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
    frame = swept.to_pandas()
    assert frame.index.names == ["materials.leaf.reflectance", "paths", "id"]
    last = frame.loc[(0.4, 256)]
    assert np.array_equal(last["absorbed_flux_PAR"], alone["absorbed_flux"]["PAR"].values)


def test_sums_over_points_pair_replicates():
    twice_as_bright = quasimc.sky(irradiance_horizontal=[200, 100])
    swept = canopy().sweep({"sources": [SKY, twice_as_bright]}, **FEW)
    once, twice = (result["absorbed_flux"]["PAR"] for result in swept)
    both = swept.sum("absorbed_flux", [30, 31])["PAR"]
    assert both.values == pytest.approx(30 * once.values + 31 * twice.values, rel=1e-12)
    # Both have the same random numbers: errors add up, and not their squares, down to single contributions.
    error = 30 * once.standard_error + 31 * twice.standard_error
    assert both.standard_error == pytest.approx(error, rel=1e-9)
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


@pytest.fixture(scope="module")
def swept():
    return canopy().sweep({"materials.leaf.reflectance": [0.1, 0.2, 0.4]}, SKY, **FEW)


def test_light_of_a_sweep_has_an_axis_of_points(swept):
    light = swept["absorbed_flux"]
    assert light.shape == (3, len(swept.organs), 2) and light.index.keys == [0.1, 0.2, 0.4]
    sums = light["PAR"].sum(axis="organ")
    for i, result in enumerate(swept):
        alone = result["absorbed_flux"]["PAR"]
        for ours, theirs in (
            (light[i]["PAR"], alone), (light["PAR"][i], alone), (light["PAR"].at([0.1, 0.2, 0.4][i]), alone),
            (sums[i], alone.sum()), (light["PAR"][i, 2], alone[2]), (light["PAR"][:, 2][i], alone[2]),
            (light["PAR"][:, [4, 2]][i].sum(), alone[[4, 2]].sum()),
        ):  # fmt: skip
            assert np.array_equal(ours._values, theirs._values)
    mask = np.arange(len(swept.organs)) < 5
    assert np.array_equal(
        light.sum(axis="organ", where=mask)[1]._values, swept[1]["absorbed_flux"].sum(where=mask)._values
    )
    assert light["PAR"].mean(axis=1)[0]._values == pytest.approx(swept[0]["absorbed_flux"]["PAR"].mean()._values)
    density = swept["absorbed_flux_density"]["PAR"]
    averages = density.average(axis="organ")
    assert averages[2]._values == pytest.approx(swept[2]["absorbed_flux_density"]["PAR"].average()._values)
    assert averages.index.keys == [0.1, 0.2, 0.4]
    with pytest.raises(ValueError, match="per area"):
        density.sum(axis="organ")
    with pytest.raises(ValueError, match="axis 'plant' can't be summed; give one of 'point', 'organ'"):
        light.sum(axis="plant")
    with pytest.raises(KeyError, match="there is no point 0.3; there are: 0.1, 0.2, 0.4"):
        light.at(0.3)


def test_differences_of_points_have_the_errors_of_pairs(swept):
    light = swept["absorbed_flux"]["PAR"]
    apart = (swept[2]["absorbed_flux"]["PAR"] - swept[0]["absorbed_flux"]["PAR"]).sum()
    for difference in ((light[2] - light[0]).sum(), (light - light[0]).sum(axis="organ")[2]):
        assert difference._values == pytest.approx(apart._values, rel=1e-9)
    whole = light.sum()
    parts = light.sum(axis="organ").sum()
    assert whole._values == pytest.approx(parts._values, rel=1e-9)
    weights = np.array([30.0, 0, -31])
    for each in (light, light.sum(axis="organ")):
        expected = 30 * each[0] - 31 * each[2]
        assert each.sum(axis=0, weights=weights)._values == pytest.approx(expected._values, rel=1e-9)


def test_budgets_and_tables_of_a_sweep(swept):
    escaped = swept.budget["escaped"]["PAR"]
    assert escaped.values.tolist() == [float(result.budget["escaped"]["PAR"]) for result in swept]
    assert swept.canopy["reflectance"].shape == (3, 2)
    absorptance = swept.canopy["absorptance"]
    difference = swept[2].canopy["absorptance"] - swept[0].canopy["absorptance"]
    assert np.all(difference.standard_error > 0)
    assert (absorptance[2] - absorptance[0]).standard_error == pytest.approx(difference.standard_error)
    assert swept.ground["absorbed_flux"]["NIR"].values[1] == float(swept[1].ground["absorbed_flux"]["NIR"])
    frame = swept["absorbed_flux"].sum(axis="organ").to_pandas()
    assert frame.index.name == "materials.leaf.reflectance" and list(frame.index) == [0.1, 0.2, 0.4]
    assert list(frame.columns) == ["PAR", "PAR_se", "NIR", "NIR_se"]
    rows = swept["absorbed_flux"]["PAR"].to_pandas()
    assert rows.index.names == ["materials.leaf.reflectance", "organ"]
    assert rows.loc[(0.2, 3), "value"] == float(swept[1]["absorbed_flux"]["PAR"].at(3))


def test_a_sweep_is_pickled(swept):
    back = pickle.loads(pickle.dumps(swept))
    assert back.points == swept.points
    ours, theirs = (each["absorbed_flux"]["PAR"].sum(axis="organ") for each in (back, swept))
    assert ours._values == pytest.approx(theirs._values, rel=1e-12)
    light = swept["absorbed_flux"]["PAR"]
    ours = pickle.loads(pickle.dumps(light))
    assert (ours + 0.0)._values == pytest.approx((light + 0.0)._values, rel=1e-9)
    ours, theirs = (each.sum(axis=1)._source.spread() for each in (ours, light))
    assert ours.deviations == pytest.approx(theirs.deviations, rel=1e-9)


def test_a_sum_over_points_has_a_weight_for_each(swept):
    with pytest.raises(ValueError, match="2 weights for 3 points"):
        swept.sum("absorbed_flux", [1, 2])


def test_a_name_that_nothing_has_is_refused_with_what_there_is():
    with pytest.raises(quasimc.InputError, match=r"no 'material.leaf.reflectance'.*\"materials.NAME.KEY\""):
        canopy().sweep({"material.leaf.reflectance": [0.1, 0.2]}, **FEW)
