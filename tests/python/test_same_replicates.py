"""Estimates of one run share its replicates and contributions, in any process."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from canopies import canopy

METHODS = ("light_tracing", "from_organs", "ray_bundles", "first_hits")
COUNT = 30
THIRD = np.arange(COUNT) % 3 == 0


def pickled(value):
    return pickle.loads(pickle.dumps(value))


def run(method="light_tracing", seed=1, paths=64):
    """Few paths, so that the size of a contribution matters."""
    return canopy(COUNT).run(method=method, paths=paths, replicates=8, seed=seed)


def same(a, b):
    """Whether values and errors agree to rounding."""
    np.testing.assert_allclose(a.values, b.values, rtol=1e-12)
    np.testing.assert_allclose(a.standard_error, b.standard_error, rtol=1e-12)


def same_intervals(a, b):
    np.testing.assert_allclose(a._values, b._values, rtol=1e-12)


@pytest.fixture(scope="module", params=METHODS)
def light(request):
    return run(request.param)["absorbed_flux"]


@pytest.fixture(scope="module")
def result():
    return run()


def test_sums_of_parts_are_the_sum_of_all(light):
    same(light[THIRD].sum() + light[~THIRD].sum(), light.sum())
    parts = [light[first::5].sum() for first in range(5)]
    same(sum(parts[1:], parts[0]), light.sum())
    same(light[0] + light[1] - 2 * light[2], light.sum(weights=[1, 1, -2, *[0] * (COUNT - 3)]))


def test_parts_in_common_count_twice(light):
    weights = 1.0 + THIRD
    same(light.sum() + light[THIRD].sum(), light.sum(weights=weights))
    same(light.sum() - light[THIRD].sum(), light[~THIRD].sum())


def test_a_number_less_itself_is_exactly_0(light):
    for nothing in (light - light, 3 * light - light * 3, light.sum() - light.sum(), light[4] - light[4]):
        assert np.all(nothing.values == 0) and np.all(nothing.standard_error == 0)
    rest = (light - light.mean()).sum()
    assert rest.values == pytest.approx(0, abs=1e-12) and rest.standard_error == pytest.approx(0, abs=1e-12)


def test_a_function_of_one_number_twice_has_its_error(light):
    x = light["NIR"][light["NIR"].values > 0]
    same(x * x, x**2)
    half = x / (x + x)
    assert half.values == pytest.approx(0.5) and half.standard_error == pytest.approx(0, abs=1e-12)


def test_bands_may_have_factors_of_their_own(light):
    factors = np.array([2.0, -3.0])
    made = (light * factors).with_unit("W") + light
    for i, band in enumerate(light.bands):
        same(made.sum()[band], (factors[i] + 1) * light[band].sum())


def test_other_random_numbers_do_not_cancel(result):
    """A control: of another seed, and of another run of the same one."""
    x, other = (each.sum("absorbed_flux")["NIR"] for each in (result, run(seed=2)))
    assert (x - other).standard_error > x.standard_error
    assert 0 < (x - run().sum("absorbed_flux")["NIR"]).standard_error < 2 * x.standard_error


@pytest.mark.parametrize("copied", (pickled, copy.deepcopy))
def test_pickled_light_has_the_errors_of_its_run(light, copied):
    other = copied(light)
    same_intervals(other, light)
    same_intervals(other.sum(), light.sum())
    same_intervals(other[THIRD]["NIR"].sum(), light[THIRD]["NIR"].sum())
    same_intervals(other.sum(weights=np.arange(1.0, COUNT + 1)), light.sum(weights=np.arange(1.0, COUNT + 1)))
    same_intervals(pickled(other).sum(), light.sum())


def test_pickled_light_belongs_to_its_run(light):
    other = pickled(light)
    for nothing in (light - other, other - light, light.sum() - other.sum(), light[3] - pickled(light[3])):
        assert np.all(nothing.values == 0) and np.all(nothing.standard_error == 0)
    same(other[THIRD].sum() + light[~THIRD].sum(), light.sum())
    same(pickled(light[THIRD]).sum() + pickled(light[~THIRD]).sum(), light.sum())


def test_pickled_sums_belong_to_their_run(light):
    parts = [pickled(light[mask].sum()) for mask in (THIRD, ~THIRD)]
    same_intervals(parts[0], light[THIRD].sum())
    same(parts[0] + parts[1], light.sum())
    same(pickled(parts[0]) + parts[1], light.sum())
    nothing = parts[0] - pickled(parts[0])
    assert np.all(nothing.values == 0) and np.all(nothing.standard_error == 0)


def test_pickled_sums_are_small(result):
    assert len(pickle.dumps(result["absorbed_flux"]["PAR"].sum())) < 2000


def test_pickled_differences_keep_the_size_of_contributions(light):
    other = canopy(COUNT)
    other.materials["leaf"].reflectance = [0.3, 0.4]
    change = light - other.run(method="light_tracing", paths=64, replicates=8)["absorbed_flux"]
    same(pickled(change), change)
    same(pickled(change).sum(where=THIRD), change.sum(where=THIRD))


def test_a_pickled_result_is_the_same_run(result):
    other = pickled(result)
    for quantity in ("absorbed_flux", "incident_upper", "sunlit_fraction"):
        nothing = result[quantity] - other[quantity]
        assert np.all(nothing.values == 0) and np.all(nothing.standard_error == 0)
    same(other.sum("absorbed_flux", THIRD) + result.sum("absorbed_flux", ~THIRD), result.sum("absorbed_flux"))


def test_groups_and_sums_of_organs_are_of_one_run(result):
    groups = result.by("plant")["absorbed_flux"]
    nothing = groups.sum() - result.sum("absorbed_flux")
    assert np.all(nothing.standard_error == 0)


def sum_of(seed):
    light = run(seed=seed)["absorbed_flux"]["NIR"]
    return light[THIRD].sum(), light[~THIRD].sum(), light.sum()


def test_sums_of_other_processes_are_paired():
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        for one, other, both in pool.map(sum_of, (1, 2)):
            same(one + other, both)
            nothing = one + other - both
            assert nothing.values == pytest.approx(0, abs=1e-12)
