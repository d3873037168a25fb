"""Sensors: Scene.add_sensors and Result.sensors."""

import pickle

import numpy as np
import pytest

import quasimc
from canopies import canopy

FEW = {"paths": 1024, "replicates": 4, "seed": 3}


def plane(reflectance=0.5):
    """An infinite plane that reflects a part of the light."""
    scene = quasimc.Scene(["PAR", "NIR"], length_unit="m")
    scene.add_material("soil", reflectance=reflectance)
    scene.cell = quasimc.Cell(x=(0, 1), y=(0, 2))
    scene.ground = quasimc.Ground("soil")
    scene.sources.append(quasimc.Source("uniform_sky", irradiance_horizontal=[100, 50]))
    return scene


def test_an_array_of_points_has_its_shape():
    scene = plane()
    y, x = np.mgrid[0:3, 0:4] / 4
    scene.add_sensors(np.stack([x, y, np.ones_like(x)], axis=-1), name="grid")
    scene.add_sensors([[0.5, 0.5, 2], [0.5, 1, 3]], name="two", facing="down")
    scene.add_sensors([0.5, 0.5, 2], name="one", receiver="sphere")
    result = scene.run(**FEW)
    assert list(result.sensors) == ["grid", "two", "one"]
    grid = result.sensors["grid"]
    assert grid.shape == (3, 4) and grid["incident_upper"]["PAR"].values.shape == (3, 4)
    assert np.array_equal(grid.positions[..., 0], x) and np.array_equal(grid.positions[..., 1], y)
    assert grid["incident_upper"].values.shape == (3, 4, 2)
    assert grid["incident_upper"]["PAR"].values == pytest.approx(np.full((3, 4), 100), rel=0.02)
    assert grid["incident_lower"]["NIR"].values == pytest.approx(np.full((3, 4), 25), rel=0.05)
    assert grid["incident_upper"]["PAR"].unit == "W m-2"
    light = grid["incident_upper"]["PAR"]
    assert float(light[2, 3].values) == light.values[2, 3]
    assert grid["incident_upper"][2, 3, "PAR"].values == light.values[2, 3]
    assert float(light.mean().values) == pytest.approx(light.values.mean())
    assert light.mean(axis=0).shape == (4,)
    two = result.sensors["two"]
    assert two.shape == (2,) and list(two.names) == ["two 1", "two 2"]
    assert two["incident_lower"]["PAR"].values == pytest.approx([100, 100], rel=0.02)
    ball = result.sensors["one"]
    assert ball.keys() == ["fluence_rate", "incident_direct", "incident_scattered"]
    assert ball["fluence_rate"]["PAR"].values == pytest.approx([300], rel=0.02)
    assert len(result.organs) == 0, "sensors are no organs"


def test_a_regular_array_and_an_average():
    at = {"start": [0, 0, 1], "along": [1, 0, 0], "across": [0, 2, 0], "counts": [4, 3]}
    scene = plane(0)
    scene.add_sensors(at=at, name="grid")
    scene.add_sensors(at=at, name="mean", average=True)
    result = scene.run(**FEW)
    assert result.sensors["grid"].shape == (3, 4)
    assert result.sensors["grid"].positions[0, 1] == pytest.approx([0.375, 1 / 3, 1])
    mean = result.sensors["mean"]["incident_upper"]["PAR"]
    assert mean.values.shape == () and float(mean.values) == pytest.approx(100, rel=0.01)
    assert float(mean.standard_error) < 1


def test_sensors_change_no_number_of_the_organs():
    without = plane().run(**FEW)
    scene = plane()
    scene.add_sensors([[0.5, 0.5, 1]])
    result = scene.run(**FEW)
    assert np.array_equal(
        without["absorbed_flux"]["PAR"].values, result["absorbed_flux"]["PAR"].values
    )
    assert without.sensors == {} and list(result.sensors) == ["sensors"]


def test_days_and_origins():
    site = quasimc.Site(50, 8)
    scene = quasimc.Scene({"PAR": "umol m-2 s-1"}, length_unit="m", site=site)
    scene.add_material("soil", reflectance=0.2)
    scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))
    scene.ground = quasimc.Ground("soil")
    scene.add_sensors([[0.5, 0.5, 1], [0.2, 0.5, 1]], name="points")
    series = scene.series(
        quasimc.day("2024-06-21", utc_offset_hours=1, hours=[11, 13]),
        origins=["sun", "sky"],
        **FEW,
    )
    light = series.total.sensors["points"]["incident_upper"]["PAR"]
    hours = [step.sensors["points"]["incident_upper"]["PAR"].values for step in series]
    assert light.values == pytest.approx(sum(hours) * 3600 / 1e6, rel=1e-9)
    assert light.unit == "mol m-2"
    parts = [light.origin(name).values for name in ("sun", "sky")]
    assert sum(parts) == pytest.approx(light.values, rel=1e-9)
    day = series.days["2024-06-21"].sensors["points"]["incident_upper"]["PAR"]
    assert np.array_equal(day.values, light.values)


def test_bad_input_is_told():
    scene = plane()
    with pytest.raises(quasimc.InputError, match="points have the shape"):
        scene.add_sensors([1, 2])
    with pytest.raises(TypeError, match="points or at"):
        scene.add_sensors([[0, 0, 1]], at=[[0, 0, 1]])
    scene.add_sensors([[0, 0, -1]], name="low")
    scene.add_sensors([[0, 0, 1]], name="odd", facing="north")
    with pytest.raises(quasimc.InputError) as caught:
        scene.build()
    assert "z is below the ground at 1 of 1 points" in str(caught.value)
    assert "facing is not a direction" in str(caught.value)
    result = plane().add_sensors([[0, 0, 1]]).run(**FEW)
    with pytest.raises(KeyError, match="incident_upper"):
        result.sensors["sensors"]["absorbed_flux"]


def test_results_with_sensors_are_pickled_but_not_read_from_files(tmp_path):
    scene = canopy()
    scene.add_sensors([[0.5, 0.5, 0.5]], name="floor")
    result = scene.run(**FEW)
    back = pickle.loads(pickle.dumps(result))
    assert back == result
    for one in (back, pickle.loads(pickle.dumps(scene.run(**FEW, keep="estimates")))):
        assert np.array_equal(
            one.sensors["floor"]["incident_upper"].values,
            result.sensors["floor"]["incident_upper"].values,
        )
    with pytest.raises(ValueError, match="not read from files"):
        quasimc.open(result.save(tmp_path / "light.json")).sensors
    with pytest.raises(ValueError, match="no parts"):
        scene.part(0, 2)
