import datetime
import inspect

import numpy as np
import pytest

import quasimc
from canopies import FEW


def flat_leaf(**keys):
    scene = quasimc.Scene("PAR", **keys).add_material("leaf", reflectance=0.1)
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    return scene.add_mesh(square, [[0, 1, 2], [0, 2, 3]], material="leaf")


@pytest.mark.parametrize(
    "source, expected",
    [
        (quasimc.directional(direction=[0, 0, -1], irradiance_facing=100), 100),
        (quasimc.directional(azimuth_deg=10, elevation_deg=30, irradiance_facing=100), 50),
        (quasimc.sun(azimuth_deg=10, elevation_deg=30, irradiance_horizontal=100), 100),
        (quasimc.sun(azimuth_deg=10, elevation_deg=30, disk=True, irradiance_facing=100), 50),
        (quasimc.uniform_sky(irradiance_horizontal=100), 100),
        (quasimc.sky("cie_clear", azimuth_deg=0, elevation_deg=40, irradiance_horizontal=70), 70),
        (quasimc.Source("uniform_sky", irradiance_horizontal={"PAR": 30}), 30),
    ],
)
def test_a_flat_leaf_receives_the_irradiance_on_the_horizontal(source, expected):
    light = flat_leaf().run(source, paths=4096)["incident_upper"]["PAR"]
    error = light.standard_error[0]
    assert error < 0.005 * expected
    assert light.values[0] == pytest.approx(expected, abs=6 * error + 1e-9 * expected)


def test_lamps_of_every_type_shine():
    at = {"position": [0.5, 0.5, 1.0]}
    lamps = [
        quasimc.lamp("point", power=10, **at),
        quasimc.lamp("spot", power=10, cone_deg=20, **at),
        quasimc.lamp("rectangle", power=10, length=0.1, width=0.1, **at),
        quasimc.lamp("disk", power=10, radius=0.1, **at),
        quasimc.lamp("sphere", power=10, radius=0.1, **at),
        quasimc.lamp("line", power=10, from_=[0, 0.5, 1], to=[1, 0.5, 1]),
    ]
    for lamp in lamps:
        light = flat_leaf().run(lamp, **FEW)["absorbed_flux"]["PAR"]
        assert 0.5 < light.values[0] < 9.01, lamp


def test_sources_of_every_type_are_known():
    types = quasimc.source_types()
    for name in ("directional", "sun", "sky", "uniform_sky", *quasimc.sources.LAMPS):
        assert name in types
    assert "perez" in quasimc.sky_models()


def test_a_sun_by_time_needs_a_place():
    noon = datetime.datetime(
        2024, 6, 21, 12, tzinfo=datetime.timezone(datetime.timedelta(hours=1))
    )
    sun = quasimc.sun(time=noon, irradiance_facing=100)
    with pytest.raises(quasimc.InputError, match="site"):
        flat_leaf().run(sun, **FEW)
    site = quasimc.Site(52, 15)
    light = flat_leaf(site=site).run(sun, **FEW)["incident_upper"]["PAR"]
    position = quasimc.sun_position(52, 15, noon)
    assert light.values[0] == pytest.approx(100 * position.vector[2], rel=1e-3)


def test_the_position_of_the_sun_is_that_of_the_published_example():
    # Reda and Andreas (2004), table A5.1.
    sun = quasimc.sun_position(
        39.742476,
        -105.1786,
        "2003-10-17T12:30:30-07:00",
        elevation_m=1830.14,
        pressure_hpa=820,
        temperature_c=11,
        delta_t_s=67,
    )
    assert sun.zenith_deg == pytest.approx(50.11162, abs=1e-4)
    assert sun.azimuth_deg == pytest.approx(194.34024, abs=1e-4)


def test_the_sun_rises_and_sets():
    day = quasimc.sun_day(52, 5, "2024-06-21T12:00+02:00")
    assert day["kind"] == "ordinary"
    assert day["sunrise"] < day["transit"] < day["sunset"]
    assert quasimc.sun_day(80, 5, "2024-06-21T12:00+02:00")["sunset"] is None


def test_a_source_shows_what_it_is():
    sky = quasimc.sky("perez", irradiance_horizontal=3)
    assert "perez" in repr(sky)
    assert sky == quasimc.Source("sky", model="perez", irradiance_horizontal=3)
    assert "irradiance_horizontal" in inspect.signature(quasimc.sky).parameters
