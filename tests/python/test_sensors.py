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


def test_transmittance_is_the_light_from_above_over_that_on_the_horizontal():
    scene = canopy()
    scene.add_sensors([[0.5, 0.5, 0.1], [0.5, 0.5, 50]], name="mast")
    scene.add_sensors([[0.5, 0.5, 50]], name="down", facing="down")
    result = scene.run(**FEW)
    mast = result.sensors["mast"]
    light, fraction = mast["incident_upper"], mast["transmittance"]
    horizontal = np.sin(np.radians(50)) * np.array([400, 380]) + [80, 20]
    assert fraction.values == pytest.approx(light.values / horizontal, rel=1e-12)
    assert fraction.standard_error == pytest.approx(light.standard_error / horizontal, rel=1e-12)
    assert np.all(np.abs(fraction.values[1] - 1) < 5 * fraction.standard_error[1] + 1e-9)
    assert fraction["PAR"].unit == "" and not fraction.origins
    with pytest.raises(KeyError, match="transmittance"):
        result.sensors["down"]["transmittance"]


def test_results_and_their_sensors_are_arrays_of_xarray():
    pytest.importorskip("xarray")
    scene = canopy()
    y, x = np.mgrid[0:2, 0:3] / 4
    scene.add_sensors(np.stack([x, y, x + 0.5], axis=-1), name="floor 1")
    scene.add_sensors([[0.5, 0.5, 0.5], [0.1, 0.5, 0.7]], name="balls", receiver="sphere")
    scene.add_sensors([[0.5, 0.5, 0.5], [0.1, 0.5, 0.7]], name="mean", average=True)
    result = scene.run(**FEW, origins=["sun", "sky"])
    data = result.to_xarray()
    for prefix, sensors, axes in (
        ("floor_1_", result.sensors["floor 1"], ("j", "i")),
        ("balls_", result.sensors["balls"], ("point",)),
        ("mean_", result.sensors["mean"], ()),
    ):
        own = sensors.to_xarray()
        for quantity in sensors:
            light = data[prefix + quantity]
            has_bands = quantity != "sunlit_fraction"
            own_axes = (*axes, *(("band",) if has_bands else ()), "statistic")
            assert own[quantity].dims == own_axes
            assert light.dims == (*(prefix + axis for axis in axes), *own_axes[len(axes) :])
            mean = light.sel(statistic="mean")
            assert np.array_equal(mean, sensors[quantity].values)
            error = own[quantity].sel(statistic="standard_error")
            assert np.array_equal(error, sensors[quantity].standard_error, equal_nan=True)
            if sensors[quantity].origins:
                from_sky = own[f"{quantity}_by_origin"].sel(origin="sky", statistic="mean")
                assert np.array_equal(from_sky, sensors[quantity].origin("sky").values)
        assert np.array_equal(data[f"{prefix}x"], sensors.positions[..., 0])
        assert np.array_equal(own["name"], sensors.names)
    assert data.floor_1_incident_upper.attrs["units"] == "W m-2"


def test_sensors_whose_names_differ_in_other_characters_only_have_a_number():
    pytest.importorskip("xarray")
    scene = plane()
    scene.add_sensors([[0.5, 0.5, 1]], name="a b").add_sensors([[0.5, 0.5, 3]], name="a+b")
    data = scene.run(**FEW).to_xarray()
    assert float(data.a_b_z[0]) == 1 and float(data.a_b_2_z[0]) == 3


def test_results_with_sensors_are_pickled_and_read_from_files(tmp_path):
    scene = canopy()
    y, x = np.mgrid[0:2, 0:3] / 4
    scene.add_sensors(np.stack([x, y, x + 0.5], axis=-1), name="floor")
    scene.add_sensors([[0.5, 0.5, 0.5], [0.1, 0.5, 0.7]], name="balls", receiver="sphere")
    scene.add_sensors([[0.5, 0.5, 0.5], [0.1, 0.5, 0.7]], name="mean", average=True)
    result = scene.run(**FEW, origins=["sun", "sky"])
    copies = [
        pickle.loads(pickle.dumps(result)),
        pickle.loads(pickle.dumps(scene.run(**FEW, origins=["sun", "sky"], keep="estimates"))),
        quasimc.open(result.save(tmp_path / "light.json")),
    ]
    copies.append(pickle.loads(pickle.dumps(copies[-1])))
    for copy in copies:
        assert copy == result
        assert list(copy.sensors) == ["floor", "balls", "mean"]
        for name, sensors in result.sensors.items():
            assert same_light(copy.sensors[name], sensors)
    assert not same_light(result.sensors["balls"], other_seed(scene).sensors["balls"])
    with pytest.raises(ValueError, match="no parts"):
        scene.part(0, 2)


def same_light(one, other):
    """Whether two sets of sensors have the same numbers, bit for bit."""
    assert one.keys() == other.keys() and one.shape == other.shape
    pairs = [(one[quantity], other[quantity]) for quantity in one]
    for quantity in one:
        has_origins = quantity not in ("sunlit_fraction", "transmittance")
        for origin in ("sun", "sky") if has_origins else ():
            pairs.append((one[quantity].origin(origin), other[quantity].origin(origin)))
    return all(
        np.array_equal(getattr(left, part), getattr(right, part), equal_nan=True)
        for left, right in pairs
        for part in ("values", "standard_error", "ci95_low", "ci95_high")
    )


def other_seed(scene):
    return scene.run(**{**FEW, "seed": 4}, origins=["sun", "sky"])


def test_sensors_that_a_stopped_run_did_not_reach_are_absent():
    scene = quasimc.Scene("PAR")
    scene.add_material("white", reflectance=1)
    scene.add_organ("sphere", material="white", center=[0, 0, 0], radius=1)
    scene.add_sensors([0, 0, 0.5], name="inside")
    scene.sources.append(quasimc.Source("uniform_sky", irradiance_horizontal=1))
    result = scene.run(max_seconds=1, method="light_tracing", **FEW)  # no path leaves the sphere
    assert result.run.stop == "time_limit"
    assert dict(result.sensors) == {}
    with pytest.raises(KeyError, match="'inside': the run was stopped before it was computed"):
        result.sensors["inside"]
    assert result["absorbed_flux"].values.shape == (1, 1)
    assert dict(pickle.loads(pickle.dumps(result)).sensors) == {}
