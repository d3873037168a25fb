import math

import numpy as np
import pytest

import quasimc

DAY = quasimc.day("2024-12-15", utc_offset_hours=1)
LAMP = 100 * 16 * math.pi  # 100 W m-2 on the sensor, 2 m below


def room(**rules):
    scene = quasimc.Scene("PAR", site=quasimc.Site(52, 6), length_unit="m")
    scene.add_material("leaf", reflectance=0)
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=1)
    scene.add_sensors([5, 5, 0], name="bench")
    lamp = quasimc.lamp("point", name="hps", position=[5, 5, 2], power=LAMP, on_hours=[2, 8])
    scene.sources.append(lamp)
    return scene.add_control("hps", "bench", **rules) if rules else scene


def test_lamps_end_within_a_time_at_the_daily_target():
    series = room(daily_target=1e6, electrical_power_w=500).series(DAY, paths=256)
    control = series.control["hps"]
    part = 1e6 / 360000 - 2
    factor = np.zeros(24)
    factor[2:5] = 1, 1, part
    assert control.factor == pytest.approx(factor, abs=1e-6)
    assert control.on == pytest.approx(factor, abs=1e-6)
    assert control.kwh == pytest.approx(0.5 * factor, abs=1e-6)
    assert control.lamps.values == pytest.approx(100 * factor, abs=1e-4)
    assert control.light.values[12] == pytest.approx(control.daylight.values[12])
    assert control.lamp_count == 1 and control.band == "PAR" and control.sensors == "bench"
    day = control.days["2024-12-15"]
    assert day.hours_on == pytest.approx(2 + part, abs=1e-6)
    assert day.kwh == pytest.approx(0.5 * (2 + part), abs=1e-6)
    assert day.lamps.values == pytest.approx(1e6, rel=1e-6)
    assert day.lamps.unit == "J m-2"
    assert day.light.values > day.lamps.values
    # The results are those with control.
    light = [float(result.sensors["bench"]["incident_upper"]["PAR"].values[0]) for result in series]
    assert light[:8] == pytest.approx(100 * factor[:8], abs=1e-4)
    assert len(control.to_pandas()) == 24


def test_without_control_there_is_none():
    scene = room()
    assert scene.series(DAY, paths=64).control == {}


def test_a_run_of_an_instant_has_no_control():
    scene = room(on_below=50)
    lamp = quasimc.lamp("point", position=[5, 5, 2], power=LAMP, name="hps")
    light = scene.run(lamp, paths=64).sensors["bench"]["incident_upper"]["PAR"]
    assert float(light.values[0]) == pytest.approx(100, rel=1e-4)


def test_mistakes_are_reported():
    scene = room(on_below=50).add_control("hps", "bech", set_point=100)
    with pytest.raises(quasimc.InputError, match="no sensors are called 'bech'; there is bench") as error:
        scene.series(DAY, paths=64)
    assert "belongs to control 'hps' too" in str(error.value)
