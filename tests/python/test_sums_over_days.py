"""Sums over organs of sums over days have the errors of the engine's groups."""

import pickle

import numpy as np
import pytest

import quasimc
from canopies import leaves

COUNT = 12
ODD = np.arange(COUNT) % 2 == 1
#: Night, morning and noon.
DAY = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[1, 13], step_minutes=180)
RUN = {"paths": 256, "replicates": 8, "method": "light_tracing"}


def stand():
    scene = quasimc.Scene({"PAR": "umol m-2 s-1", "NIR": "W m-2"}, site=quasimc.Site(52, 5.7))
    scene.add_material("leaf", reflectance=[0.08, 0.45], transmittance=[0.06, 0.45])
    vertices, faces, organ = leaves(COUNT)
    labels = {"side": ["odd" if odd else "even" for odd in ODD]}
    scene.add_mesh(vertices, faces, organ=organ, material="leaf", labels=labels)
    return scene


def series_of(seed=1, keep="replicates", scene=None, **options):
    return (scene or stand()).series(DAY, keep=keep, seed=seed, **{**RUN, **options})


def same(a, b):
    np.testing.assert_allclose(a._values, b._values, rtol=1e-12)


@pytest.fixture(scope="module", params=("light_tracing", "from_organs", "ray_bundles"))
def series(request):
    return series_of(method=request.param, groups=["side"], origins=["sun", "sky"])


@pytest.fixture(scope="module")
def day():
    return series_of().days["2024-06-21"]


def test_sums_over_organs_are_the_groups_of_the_run(series):
    for sums in (series.days["2024-06-21"], series.total):
        for quantity in sums:
            light, groups = sums[quantity], sums.groups[quantity]
            for group, mask in (("all", ODD | True), ("odd", ODD), ("even", ~ODD)):
                made = light.sum(where=mask) if light.extensive else light.average(where=mask)
                same(made, groups.at(group))
                for origin in ("sun", "sky"):
                    same(made.origin(origin), groups.at(group).origin(origin))


def test_sums_of_one_organ_are_the_organ(series):
    light = series.days["2024-06-21"]["absorbed_flux"]
    for i in range(COUNT):
        same(light[[i]].sum(), light[i])
        same(light["PAR"].sum(weights=np.arange(COUNT) == i), light["PAR"][i])


def test_groups_of_days_can_be_summed(series):
    light = series.days["2024-06-21"].groups["absorbed_flux"]
    same(light[1:].sum(), light.at("all"))


def test_times_that_are_scaled_from_one_computation_count_once():
    """A lamp alone shines at night: three hours of one computation."""
    lamp = quasimc.uniform_sky(irradiance_horizontal=10)
    night = quasimc.day("2024-12-21", utc_offset_hours=1, hours=[0, 3])
    with pytest.warns(quasimc.QuasimcWarning, match="daylight"):
        series = stand().series(night, lamp, keep="replicates", groups=["side"], **RUN)
    assert series.computed == 1 and len(series) == 3
    for sums in (series.total, *series.days.values()):
        same(sums["absorbed_flux"].sum(), sums.groups["absorbed_flux"].at("all"))
        once = 3 * 3600 * series[0]["absorbed_flux"].sum() * [1e-6, 1]
        np.testing.assert_allclose(
            sums["absorbed_flux"].sum()._values[:, :2], once._values[:, :2], rtol=1e-12
        )


def test_arithmetic_of_days(day):
    light = day["absorbed_flux"]
    same((2 * light).sum(), 2 * light.sum())
    assert np.all((light - light).standard_error == 0)
    assert np.all((light.sum() - light[ODD].sum() - light[~ODD].sum()).standard_error < 1e-9)
    share = light[ODD].sum() / light.sum()
    assert np.all((share.standard_error > 0) & (share.standard_error < 0.5 * share.values))
    other = pickle.loads(pickle.dumps(light))
    same(other.sum(), light.sum())
    assert np.all((other - light).standard_error == 0)


def test_differences_of_days_pair_their_replicates(day):
    scene = stand()
    scene.materials["leaf"].reflectance = [0.081, 0.451]
    change = series_of(scene=scene).total["absorbed_flux"].sum() - day["absorbed_flux"].sum()
    other = series_of(seed=2, scene=scene).total["absorbed_flux"].sum() - day["absorbed_flux"].sum()
    assert np.all(change.standard_error < 0.9 * other.standard_error)


def test_days_without_replicates_have_unknown_errors():
    light = series_of(keep="estimates").total["absorbed_flux"]["PAR"]
    with pytest.warns(quasimc.QuasimcWarning, match='keep="replicates"'):
        assert np.isnan(light.sum().standard_error)


def test_intervals_contain_the_exact_value_as_often_as_they_say():
    runs = 200

    def numbers_of(light):
        return np.stack([
            light.sum()._values, light[ODD].sum()._values,
            light.sum(weights=np.linspace(-1, 1, COUNT))._values,
            (light[:6].sum() / light.sum())._values,
        ])  # fmt: skip

    exact = numbers_of(series_of(99, paths=2**16).total["absorbed_flux"])[..., 0]
    found = np.array([numbers_of(series_of(seed).total["absorbed_flux"]) for seed in range(1, runs + 1)])
    hits = ((found[..., 2] <= exact) & (exact <= found[..., 3])).sum(axis=0)
    # 95 % less five standard errors of a fraction of these runs.
    assert np.all(hits >= runs * (0.95 - 5 * np.sqrt(0.95 * 0.05 / runs))), hits / runs
    ratio = (found[..., 3] - found[..., 2]).mean(axis=0) / found[..., 0].std(axis=0)
    assert np.all(ratio < 7), f"too wide to be a test ({ratio})"
