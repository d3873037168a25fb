"""Energy budgets and fractions of the canopy, replicate by replicate."""

import pickle

import numpy as np
import pytest

import quasimc
from canopies import canopy

METHODS = ("light_tracing", "from_organs", "ray_bundles", "first_hits")


def scenes():
    """An open scene over soil, a periodic cell over soil, and one without."""
    cell = quasimc.Cell(x=(0, 1), y=(0, 1))
    open_scene, closed, floating = canopy(), canopy(), canopy()
    closed.ground, closed.cell = quasimc.Ground("soil"), cell
    floating.ground, floating.cell = None, cell
    return {"open": open_scene, "cell": closed, "floating": floating}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", ["open", "cell", "floating"])
def test_replicates_have_the_errors_that_are_reported(kind, method):
    result = scenes()[kind].run(method=method, paths=256, replicates=8)
    seen = 0
    # Contributions to fractions are over the emitted flux, which is exact, or over its estimate.
    for parts, tolerance in ((result.budget, 1e-9), (result.canopy, 1e-4)):
        for name, part in parts.items():
            assert part.has_replicates == (name not in ("closure_error", "incident"))
            if not part.has_replicates:
                continue
            made = part._source.estimates()
            known = np.isfinite(part.standard_error) & (part.values > 0)
            np.testing.assert_allclose(made[known, 0], part.values[known], rtol=1e-9, err_msg=name)
            errors = made[known, 1], part.standard_error[known]
            rounding = 1e-12 * part.values[known].max(initial=0)
            np.testing.assert_allclose(*errors, rtol=tolerance, atol=rounding, err_msg=name)
            assert np.all(np.isnan(made[:, 0]) == np.isnan(part.values)), name
            seen += known.sum()
    assert seen >= 6


def test_parts_close_in_every_replicate():
    result = scenes()["cell"].run(method="light_tracing", paths=512, replicates=8)
    budget, parts = result.budget, result.canopy
    into = budget["emitted"] + budget["imbalance"] - budget["cut_off"]
    out = budget["absorbed_by_organs"] + budget["absorbed_by_ground"] + budget["escaped"]
    fractions = parts["reflectance"] + parts["absorptance"] + parts["ground_absorptance"]
    for rest in (into - out, into / budget["emitted"] - fractions):
        assert np.abs(rest.values).max() < 1e-9 * budget["emitted"].values.max()
        assert np.abs(rest._source.spread().deviations).max() < 1e-9 * budget["emitted"].values.max()
    assert parts["absorptance"]._source.spread().deviations.std() > 1e-4, "a control"
    organs = result["absorbed_flux"].sum()
    apart = (budget["absorbed_by_organs"] - organs)._source.spread().deviations
    assert np.abs(apart).max() < 1e-9 * organs.values.max()


def fapar(seed, reflectance, paths=512):
    scene = scenes()["cell"]
    scene.materials["leaf"].reflectance = [reflectance, 0.45]
    result = scene.run(method="light_tracing", paths=paths, replicates=8, seed=seed)
    return result.canopy["absorptance"]["PAR"]


def test_differences_pair_replicates_and_hold_the_truth():
    low, high = 0.08, 0.12
    exact = fapar(99, low, 2**18) - fapar(99, high, 2**18)
    runs, hits, narrow, wide, values = 150, 0, [], [], []
    for seed in range(1, runs + 1):
        a, b = fapar(seed, low), fapar(seed, high)
        difference = a - b
        hits += difference.ci95_low <= exact.values <= difference.ci95_high
        values.append(float(difference))
        narrow.append(float(difference.standard_error))
        wide.append(float(np.hypot(a.standard_error, b.standard_error)))
    least = runs * (0.95 - 5 * np.sqrt(0.95 * 0.05 / runs))
    assert hits >= least
    assert np.mean(narrow) < 0.5 * np.mean(wide), "common random numbers"
    assert 0.8 < np.mean(narrow) / np.std(values) < 1.6
    other = fapar(1, low) - fapar(2, high)
    assert other.standard_error > 0.5 * np.mean(wide), "a control: other random numbers"


def test_sweeps_and_pickles_keep_them():
    scene = scenes()["cell"]
    sweep = scene.sweep({"materials.leaf.reflectance": [0.1, 0.2]}, paths=256, method="light_tracing")
    light = sweep.canopy["absorptance"]
    one = sweep[1].canopy["absorptance"] - sweep[0].canopy["absorptance"]
    np.testing.assert_allclose((light[1] - light[0])._values, one._values, rtol=1e-9)
    np.testing.assert_allclose(
        (light[1] - light[0])["NIR"]._values, (light["NIR"][1] - light["NIR"][0])._values, rtol=1e-9
    )
    back = pickle.loads(pickle.dumps(sweep[0])).canopy["absorptance"] - sweep[1].canopy["absorptance"]
    np.testing.assert_allclose(back.standard_error, one.standard_error, rtol=1e-9)


def test_origins_and_runs_without_replicates():
    whole = scenes()["open"].run(paths=256, method="light_tracing", origins=["sun", "sky"])
    plain = scenes()["open"].run(paths=256, method="light_tracing", keep="estimates")
    for part in ("absorbed_by_organs", "escaped"):
        made = whole.budget[part]
        np.testing.assert_allclose(made._source.estimates()[:, 1], made.standard_error, rtol=1e-9)
        assert not plain.budget[part].has_replicates
    with pytest.warns(quasimc.QuasimcWarning, match='keep="replicates"'):
        plain.canopy["absorptance"] - whole.canopy["absorptance"]
