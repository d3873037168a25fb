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


ORIGINS = ["sun", "sky", "hps"]
RULES = dict(daily_target=1e6, electrical_power_w=500)


def test_control_after_a_run_decides_as_a_run_with_control():
    expected = room(**RULES).series(DAY, paths=256)
    series = room().series(DAY, paths=256, origins=ORIGINS, keep="replicates")
    after, within = series.controlled("hps", "bench", **RULES), expected.control["hps"]
    assert after.factor.tolist() == within.factor.tolist()
    assert after.kwh.tolist() == within.kwh.tolist() and after.on.tolist() == within.on.tolist()
    for name in ("daylight", "lamps", "light"):
        assert np.array_equal(getattr(after, name)._values, getattr(within, name)._values, equal_nan=True)
    assert after.days["2024-12-15"].light.values == within.days["2024-12-15"].light.values
    assert 0 < after.factor[4] < 1 and after.factor[5] == 0 and series.control == {}
    light, whole = after["absorbed_flux"], series["absorbed_flux"]
    assert light.units == {"PAR": "W"} and light.extensive and light.name == "absorbed_flux"
    assert light.values[2:4] == pytest.approx(whole.values[2:4], rel=1e-12), "the lamps at full light"
    assert np.all(light.values[5:7] == 0) and np.all(whole.values[5:7] > 0), "the lamps are off"


@pytest.mark.parametrize("rules", [RULES, {"set_point": 60}, {"on_below": 50}])
def test_hours_with_the_lamps_alone_have_the_errors_of_a_run_with_control(rules):
    expected = room(**rules).series(DAY, paths=256, keep="replicates")["absorbed_flux"]
    series = room().series(DAY, paths=256, origins=ORIGINS, keep="replicates")
    light = series.controlled("hps", "bench", **rules)["absorbed_flux"]
    assert np.array_equal(light._values, expected._values), "the lamps shine by night alone"
    assert np.all(light.standard_error[light.values > 0] > 0)
    for sum_of in (
        lambda each: each.sum(axis="organ"),
        lambda each: each["PAR"].sum(axis="time", weights=np.full(24, 3600)),
    ):
        np.testing.assert_allclose(sum_of(light)._values, sum_of(expected)._values, rtol=1e-12)


def test_hours_of_daylight_and_dimmed_lamps_have_errors_of_their_mixture():
    def lit(**rules):
        scene = room()
        scene.sources = [quasimc.lamp("point", name="hps", position=[5, 5, 2], power=3 * LAMP)]
        return scene.add_control("hps", "bench", **rules) if rules else scene

    rules = {"set_point": 200}
    options = {"keep": "replicates", "paths": 1024}
    runs = [lit(**rules).series(DAY, seed=seed, **options)["absorbed_flux"]["PAR"] for seed in (1, 2)]
    series = lit().series(DAY, origins=ORIGINS, seed=3, **options)
    after = series.controlled("hps", "bench", **rules)
    mixed = (after.factor > 0) & (after.daylight.values > 20)
    light = after["absorbed_flux"]["PAR"]
    assert mixed.sum() > 3 and np.all(after.factor[mixed] < 0.64)
    for own, of_run in ((light, runs[0]), (light, runs[1])):
        error = np.hypot(own.standard_error, of_run.standard_error)[mixed]
        assert np.all(np.abs(own.values - of_run.values)[mixed] < 5 * error)
        assert np.all(error < 0.05 * own.values[mixed])
    parts = series["absorbed_flux"]["PAR"]
    sun_and_sky = parts.origin("sun") + parts.origin("sky")
    row = int(np.argmax(mixed))
    by_hand = sun_and_sky[row] + after.factor[row] * parts.origin("hps")[row]
    assert light.standard_error[row] == pytest.approx(by_hand.standard_error, rel=0.05)


def test_control_of_an_opened_series(tmp_path):
    series = room().series(DAY, paths=256, origins=["hps"])
    series.save(tmp_path / "day.json")
    opened = quasimc.open(tmp_path / "day.json")
    own, again = (each.controlled("hps", "bench", **RULES) for each in (series, opened))
    assert again.factor.tolist() == own.factor.tolist()
    light = again["absorbed_flux"]["PAR"]
    assert np.array_equal(light._values, own["absorbed_flux"]["PAR"]._values)
    whole, factor = opened["absorbed_flux"]["PAR"], own.factor[:, None]
    others = whole.origin("other").values
    assert light.values == pytest.approx(factor * whole.values + (1 - factor) * others)
    assert light.values[12, 0] > 100 and light.values[3, 0] > 0


def test_lamps_that_cannot_be_controlled_after_the_run_are_refused():
    controlled = room(**RULES).series(DAY, paths=64, origins=ORIGINS)
    with pytest.raises(ValueError, match="under control already"):
        controlled.controlled("hps", "bench", **RULES)
    for origins in ([], ["sun"], ["*"]):
        series = room().series(DAY, paths=64, origins=origins)
        with pytest.raises(ValueError, match="no origin is the light of 'hps' alone"):
            series.controlled("hps", "bench", **RULES)
    series = room().series(DAY, paths=64, origins=["lamps"])
    assert series.controlled("hps", "bench", **RULES).lamp_count == 1
    with pytest.raises(quasimc.InputError, match="no sensors are called 'bech'"):
        series.controlled("hps", "bech", **RULES)
    with pytest.raises(quasimc.InputError, match="did you mean 'set_point'"):
        series.controlled("hps", "bench", setpoint=100)
