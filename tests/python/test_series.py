import datetime
import pickle

import numpy as np
import pytest

import quasimc
from canopies import FEW, leaves

DAY = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[10, 13], step_minutes=60)


@pytest.fixture(scope="module")
def scene():
    site = quasimc.Site(52, 5.7)
    scene = quasimc.Scene({"PAR": "umol m-2 s-1", "NIR": "W m-2"}, site=site)
    scene.add_material("leaf", reflectance=[0.08, 0.45], transmittance=[0.06, 0.45])
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1)
    return scene


@pytest.fixture(scope="module")
def series(scene):
    return scene.series(DAY, paths=512)


def test_every_time_has_a_result(series):
    assert len(series) == 3 and len(list(series)) == 3
    assert [t["time"][:13] for t in series.times] == [f"2024-06-21T{h}" for h in (10, 11, 12)]
    assert all(t["sun_elevation_deg"] > 40 for t in series.times)
    assert series[0]["absorbed_flux"]["PAR"].values[0] > 0
    assert series.stop == "finished"


def test_days_are_sums_over_times(series):
    day = series.days["2024-06-21"]
    assert day.seconds == 3 * 3600
    assert day["incident_upper"].units == {"PAR": "mol m-2", "NIR": "J m-2"}
    assert day["absorbed_flux"]["NIR"].unit == "J"
    for band, factor in (("PAR", 1e-6), ("NIR", 1)):
        rates = [result["incident_upper"][band].values[0] for result in series]
        assert day["incident_upper"][band].values[0] == pytest.approx(
            3600 * factor * sum(rates), rel=1e-12
        )
    assert np.array_equal(day["absorbed_flux"].values, series.total["absorbed_flux"].values)
    assert len(day.to_pandas()) == 1


def test_light_of_a_series_has_an_axis_of_times(scene, series):
    light = series["absorbed_flux"]
    assert light.shape == (3, 1, 2)
    assert np.array_equal(light[1]._values, series[1]["absorbed_flux"]._values)
    noon = datetime.datetime(2024, 6, 21, 11, tzinfo=datetime.timezone(datetime.timedelta(hours=1)))
    assert np.array_equal(light.at(noon)._values, light[1]._values)
    with pytest.raises(ValueError, match="a rate: use series.total or series.days, give weights"):
        light["PAR"].sum()
    energy = light["NIR"].sum(axis="time", weights=[step["seconds"] for step in series.times])
    assert energy.values == pytest.approx(series.total["absorbed_flux"]["NIR"].values, rel=1e-9)
    assert energy.unit == "" and energy.with_unit("J").unit == "J"
    assert light.sum(axis=0, weights=[1, 2, 3]).units == {"PAR": "", "NIR": ""}
    assert light["PAR"].mean(axis="time").unit == light["PAR"].sum(axis="organ").unit == "umol s-1"
    kept = scene.series(DAY, paths=512, keep="replicates")["absorbed_flux"]["PAR"]
    frame = kept.sum(axis="organ").to_pandas()
    assert frame.index[1].isoformat() == "2024-06-21T11:00:00+01:00"
    assert frame["value"].tolist() == light["PAR"].values[:, 0].tolist()
    with pytest.raises(KeyError, match="not kept"):
        scene.series(DAY, paths=64, keep="sums")["absorbed_flux"]


def test_weighted_sums_over_times_keep_their_origins(scene):
    series = scene.series(DAY, paths=512, keep="replicates", origins=["sun", "sky"])
    seconds = [step["seconds"] for step in series.times]
    energy = series["absorbed_flux"]["NIR"].sum(axis="time", weights=seconds).with_unit("J")
    assert energy.origins == ("sun", "sky")
    for origin in energy.origins:
        day = series.total["absorbed_flux"]["NIR"].origin(origin)
        assert energy.origin(origin).unit == day.unit == "J"
        assert energy.origin(origin).values == pytest.approx(day.values, rel=1e-9)


def test_times_that_share_a_computation_share_its_replicates():
    scene = quasimc.Scene("PAR", site=quasimc.Site(52, 5.7))
    scene.add_material("leaf", reflectance=0.5)
    scene.add_mesh(*leaves(10)[:2], organ=leaves(10)[2], material="leaf")
    lamp = quasimc.uniform_sky(irradiance_horizontal=10)  # at night it shines alone, and is computed once
    night = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[1, 7])
    series = scene.series(night, lamp, keep="replicates", **FEW)
    sums = series["absorbed_flux"]["PAR"].sum(axis="organ")
    is_shared = [not result.has_replicates for result in series]
    assert any(is_shared) and not all(is_shared) and np.all(sums.standard_error > 0)
    first = is_shared.index(True)
    assert sums[first - 1].standard_error == sums[first].standard_error
    both = sums[first - 1 : first + 1].sum(axis="time", weights=[1, 1])
    assert both.standard_error == pytest.approx(2 * sums[first].standard_error)
    assert float((sums[first] - sums[first - 1]).standard_error) == pytest.approx(0, abs=1e-12)


def test_tables_have_a_row_for_each_time_and_organ(series):
    frame = series.to_pandas()
    assert frame.index.names == ["time", "id"] and len(frame) == 3
    course = frame.reset_index().pivot(index="time", columns="id", values="absorbed_flux_PAR")
    assert course[1].tolist() == series["absorbed_flux"]["PAR"].values[:, 0].tolist()


def test_times_need_not_be_kept(scene, series):
    sums = scene.series(DAY, paths=512, keep="sums")
    assert np.array_equal(
        sums.total["absorbed_flux"].values, series.total["absorbed_flux"].values
    )
    assert len(sums) == 3
    for use in (lambda: sums[0], lambda: list(sums), sums.to_pandas):
        with pytest.raises(KeyError, match="sums"):
            use()


def test_sums_have_no_sunlit_fraction(series):
    assert "sunlit_fraction" in list(series[0]) and "sunlit_fraction" not in list(series.total)
    with pytest.raises(KeyError) as caught:
        series.total["sunlit_fraction"]
    assert "sunlit_fraction" not in str(caught.value).split("there are:")[1]


def test_groups_are_summed_over_days():
    scene = quasimc.Scene({"PAR": "umol m-2 s-1", "NIR": "W m-2"},
                          site=quasimc.Site(52, 5.7))
    scene.add_material("leaf", reflectance=[0.08, 0.45], transmittance=[0.06, 0.45])
    for plant in (1, 1, 2):
        x = len(scene._table.get("organ", [])) / 2
        scene.add_organ("disk", material="leaf", center=[x, 0, 1], normal=[0, 0, 1], radius=0.1,
                        labels={"plant": plant})
    series = scene.series(DAY, paths=512, groups=["plant"])
    for sums in (series.total, series.days["2024-06-21"]):
        assert [(g["by"], g["value"]) for g in sums.groups.groups] == [
            ("all", ""), ("plant", "1"), ("plant", "2")
        ]  # fmt: skip
        assert sums.groups["absorbed_flux"].units == {"PAR": "mol", "NIR": "J"}
        of_organs = sums["absorbed_flux"].values
        of_groups = sums.groups["absorbed_flux"].values
        assert np.allclose(of_groups[0], of_organs.sum(axis=0), rtol=1e-12)
        assert np.allclose(of_groups[1], of_organs[:2].sum(axis=0), rtol=1e-12)
        frame = sums.groups.to_pandas()
        assert np.array_equal(frame["absorbed_flux_NIR"], of_groups[:, 1])
        for table in (frame, sums.to_pandas()):
            units = table.attrs["units"]
            assert set(units) <= set(table.columns) and len(units) == 2 * len(quasimc.quantities())
            assert units["absorbed_flux_PAR"] == "mol" and units["absorbed_flux_density_NIR"] == "J m-2"
        assert series[0].groups.to_pandas().attrs["units"]["absorbed_flux_PAR"] == "umol s-1"
        assert sums.to_pandas()["plant"].tolist() == ["1", "1", "2"]


def test_a_callback_is_told_of_all_times(scene):
    seen = []
    scene.series(DAY, paths=1 << 16, progress=lambda p: seen.append(p.fraction))
    assert seen == sorted(seen)


def test_means_of_sums_lie_in_their_intervals():
    scene = quasimc.Scene("PAR", site=quasimc.Site(52, 5.7))
    scene.add_material("leaf", reflectance=0.8, transmittance=0.2)
    scene.add_mesh(*leaves(30)[:2], organ=leaves(30)[2], material="leaf", labels={"plant": 1})
    series = scene.series(DAY, groups=["plant"], **FEW)
    for sums in (series.total, series.days["2024-06-21"]):
        for table in (sums, sums.groups):
            light = table["absorbed_flux"]
            assert np.all((light.ci95_low <= light.values) & (light.values <= light.ci95_high))


def test_times_keep_their_replicates_if_asked():
    scene = quasimc.Scene(["PAR", "NIR"], site=quasimc.Site(52, 5))
    scene.add_material("leaf", reflectance=0.1, transmittance=0.1)
    for i in range(6):
        scene.add_organ("disk", material="leaf", center=[0.1 * i, 0, 1 + 0.1 * i], normal=[0, 0, 1],
                        radius=0.2, labels={"half": i // 3})
    day = quasimc.day("2024-06-21", utc_offset_hours=2, hours=[2, 8])
    options = dict(paths=256, replicates=4, groups=["half"], origins=["sun", "sky"])
    series = scene.series(day, **options, keep="replicates", method="light_tracing")
    assert any(result.has_replicates for result in series)
    for result in series:
        light = result["absorbed_flux"]
        for part in (light, light.origin("sky")):
            mine = part[:3].sum()
            groups = result.groups["absorbed_flux"]
            theirs = (groups if part is light else groups.origin("sky")).at("0")
            np.testing.assert_allclose(mine._values, theirs._values, rtol=1e-12, atol=1e-15)
    plain = scene.series(day, **options)
    assert not any(result.has_replicates for result in plain)


def same_sums(ours, theirs):
    assert ours.seconds == theirs.seconds and list(ours) == list(theirs)
    for quantity in ours:
        assert ours[quantity]._values.tobytes() == theirs[quantity]._values.tobytes()
        assert ours[quantity].units == theirs[quantity].units
    assert ours.groups.to_pandas().equals(theirs.groups.to_pandas())


@pytest.mark.parametrize("keep", ["estimates", "sums"])
def test_series_are_pickled(scene, keep):
    options = {"layer_heights": [0, 2], "origins": ["sun", "sky"], "sun_shade": "apart"}
    series = scene.series(DAY, paths=512, keep=keep, **options)
    back = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(series))))
    assert back.times == series.times and repr(back) == repr(series)
    assert list(back.days) == list(series.days)
    same_sums(back.total, series.total)
    same_sums(back.days["2024-06-21"], series.days["2024-06-21"])
    parts = [s.total.sun_shade["absorbed_flux_density_sunlit"]["PAR"].values for s in (back, series)]
    assert np.array_equal(*parts, equal_nan=True)
    if keep == "sums":
        with pytest.raises(KeyError, match="not kept"):
            back[0]
        return
    assert back.to_pandas().equals(series.to_pandas())
    one = pickle.loads(pickle.dumps(series[1]))
    assert one == series[1] == back[1] and not one.has_replicates
    assert one.run.paths == series[1].run.paths
    assert one.groups.to_pandas().equals(series[1].groups.to_pandas())
    assert one["absorbed_flux"].origin("sky").values.tolist() == (
        series[1]["absorbed_flux"].origin("sky").values.tolist()
    )


def test_replicates_of_series_are_not_lost_silently(scene):
    series = scene.series(DAY, paths=512, keep="replicates", method="light_tracing")
    assert any(result.has_replicates for result in series)
    with pytest.raises(ValueError, match='keep="estimates"'):
        pickle.dumps(series)
    with pytest.raises(ValueError, match="this Result has no run file"):
        series[0].save("light.json")


def test_instants_have_no_sums(scene):
    noon = quasimc.times(["2024-06-21T12:00"], utc_offset_hours=1)
    series = scene.series(noon, paths=64)
    assert series[0]["absorbed_flux"]["PAR"].values[0] > 0
    for name in ("total", "days"):
        with pytest.raises(ValueError, match=r"are instants.* would be 0; .*duration_minutes=60"):
            getattr(series, name)
    assert scene.series(noon.replace(duration_minutes=60), paths=64).total.seconds == 3600


def test_a_wrong_keep_names_all_choices(scene):
    with pytest.raises(ValueError, match="keep is 'x'; give one of auto, replicates, estimates, sums"):
        scene.series(DAY, keep="x")
    with pytest.raises(ValueError, match=r"keep is 'sums'; .*of series\(\)"):
        scene.run(quasimc.sky(irradiance_horizontal=[1, 1]), keep="sums")
