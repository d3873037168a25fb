"""Sums of arithmetic have the errors of arithmetic of sums."""

import numpy as np
import pytest

from canopies import canopy

COUNT = 30


def same(a, b):
    """Whether values, errors and intervals agree to rounding."""
    np.testing.assert_allclose(a._values, b._values, rtol=1e-9, atol=1e-12)


def lights(seed=1, paths=64, method="light_tracing"):
    """The light of two canopies, of other random numbers."""
    plain, bright = canopy(COUNT), canopy(COUNT)
    bright.add_material("leaf", reflectance=[0.08, 0.47], transmittance=[0.06, 0.45])
    run = {"method": method, "paths": paths, "replicates": 8}
    a = plain.run(seed=seed, **run)["absorbed_flux"]
    return a, bright.run(seed=seed + 10_000, **run)["absorbed_flux"]


@pytest.fixture(scope="module")
def pair():
    return lights()


@pytest.fixture(scope="module")
def bright_pair():
    """Light on every organ."""
    return lights(paths=1024, method="ray_bundles")


w, v = np.random.default_rng(5).uniform(-1, 1, (2, COUNT, 1))
mask = np.arange(COUNT) % 3 == 0

FORMS = {
    "difference": (lambda a, b: (30 * a - 31 * b).sum(), lambda a, b: 30 * a.sum() - 31 * b.sum()),
    "weights": (
        lambda a, b: (a * w - b * v).sum(),
        lambda a, b: a.sum(weights=w[:, 0]) - b.sum(weights=v[:, 0]),
    ),
    "mask": (
        lambda a, b: (2 * (a - b) + 3 * b)[mask].sum(),
        lambda a, b: 2 * (a[mask].sum() - b[mask].sum()) + 3 * b[mask].sum(),
    ),
    "where": (lambda a, b: (a - b).sum(where=mask), lambda a, b: a[mask].sum() - b[mask].sum()),
    "mean": (lambda a, b: (5 - a + b).mean(), lambda a, b: 5 - a.mean() + b.mean()),
    "from the mean": (lambda a, b: (a - b.mean()).sum(), lambda a, b: a.sum() - COUNT * b.mean()),
    "share": (lambda a, b: (a / b.sum()).sum(), lambda a, b: a.sum() / b.sum()),
    "band": (lambda a, b: (a - 2 * b)["NIR"].sum(), lambda a, b: a["NIR"].sum() - 2 * b["NIR"].sum()),
    "organs": (
        lambda a, b: ((a - b)[:10] + 1.0)[4:].sum(),
        lambda a, b: a[4:10].sum() - b[4:10].sum() + 6.0,
    ),
}


@pytest.mark.parametrize("form", FORMS)
def test_a_sum_of_arithmetic_is_the_arithmetic_of_sums(pair, form):
    of_arithmetic, of_sums = FORMS[form]
    same(of_arithmetic(*pair), of_sums(*pair))


@pytest.mark.parametrize("method", ("from_organs", "ray_bundles", "first_hits"))
def test_it_is_so_in_every_method(method):
    of_arithmetic, of_sums = FORMS["difference"]
    few = lights(paths=16, method=method)
    same(of_arithmetic(*few), of_sums(*few))


def test_organs_alone_would_have_other_errors(pair):
    a, b = pair
    made = (30 * a - 31 * b)["NIR"]
    sizes = made._source.spread().summed(np.ones(COUNT)).estimates()[1]
    assert sizes > 1.05 * made.sum().standard_error, "a control: of the largest contribution of each"


def test_functions_have_it_to_first_order(bright_pair):
    a = bright_pair[0]["NIR"]
    slopes = 1 / a._source.spread().means
    made, of_sums = np.log(a).sum(), a.sum(weights=slopes)
    assert made.standard_error == pytest.approx(float(of_sums.standard_error), rel=1e-9)
    both = np.sqrt(a * bright_pair[1]["NIR"]).sum()
    x, y = (light["NIR"]._source.spread().means for light in bright_pair)
    terms = a.sum(weights=0.5 * np.sqrt(y / x)) + bright_pair[1]["NIR"].sum(weights=0.5 * np.sqrt(x / y))
    assert both.standard_error == pytest.approx(float(terms.standard_error), rel=1e-9)


def test_bands_may_have_weights_of_their_own(bright_pair):
    a, b = bright_pair
    share = a / (a + b)
    for band in a.bands:
        own = a[band] / (a[band] + b[band])
        same(share.sum()[band], own.sum())
        same(share[band].sum(), own.sum())


def test_runs_and_organs_are_summed_in_any_order():
    scene = canopy(COUNT)
    sweep = scene.sweep(
        {"materials.leaf.reflectance": [0.1, 0.2, 0.4]},
        method="light_tracing", paths=64, replicates=8,
    )  # fmt: skip
    light = sweep["absorbed_flux"]
    first, change = light[0], light - light[0]
    same(change.sum(axis="organ"), light.sum(axis="organ") - first.sum())
    same(change[:, 3], light[:, 3] - first[3])
    same(change[:, mask].sum(axis="organ")[2], light[2][mask].sum() - first[mask].sum())
    same((2 * light).sum(axis="point", weights=[1, 2, 3]), 2 * light.sum(axis="point", weights=[1, 2, 3]))
    same((3 * light).sum(), 3 * light.sum())


def test_an_organ_without_a_value_matters_only_where_it_is_used(bright_pair):
    a, b = bright_pair
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = a["PAR"] / (b["PAR"] * (np.arange(COUNT) > 0))
    assert not np.isfinite(ratio.sum().standard_error)
    assert np.isfinite(ratio.sum(where=np.arange(COUNT) > 0).standard_error)
    same(ratio.sum(where=mask & (np.arange(COUNT) > 0)), (a["PAR"] / b["PAR"])[mask][1:].sum())


def test_a_long_sum_forgets_its_parts(pair):
    a = pair[0]["PAR"]
    total = sum([a] * 200, 0.0)
    assert len(total._source.terms) < 100
    assert total.values == pytest.approx(200 * a.values, rel=1e-9)
    scatter = [light._source.spread().deviations.std(axis=0) for light in (total, a)]
    assert scatter[0] == pytest.approx(200 * scatter[1], rel=1e-9)


def test_intervals_of_both_forms_contain_the_exact_value_as_often_as_they_say():
    runs = 200
    exact = {name: of_sums(*lights(99, paths=2**17)) for name, (_, of_sums) in FORMS.items()}
    hits = {name: np.zeros((2, 2)) for name in FORMS}
    widths, values = ({name: [] for name in FORMS} for _ in range(2))
    for seed in range(1, runs + 1):
        pair = lights(seed, paths=256)
        for name, forms in FORMS.items():
            for i, form in enumerate(forms):
                made = form(*pair)
                inside = (made.ci95_low <= exact[name].values) & (exact[name].values <= made.ci95_high)
                hits[name][i] += inside
            widths[name].append(np.ravel(made.ci95_high - made.ci95_low))
            values[name].append(np.ravel(made.values))
    # 95 % less five standard errors of a fraction of these runs.
    least = runs * (0.95 - 5 * np.sqrt(0.95 * 0.05 / runs))
    assert {name: count.tolist() for name, count in hits.items() if np.min(count) < least} == {}
    for name in FORMS:  # Student's t of 7 degrees of freedom: 4.7 standard deviations
        ratio = np.mean(widths[name], axis=0) / np.std(values[name], axis=0)
        assert np.all(ratio < 8), f"{name}: too wide to be a test ({ratio})"
