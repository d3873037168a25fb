"""Estimates as arrays: sums, differences and functions with their errors."""

import copy
import math
import pickle
import warnings

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy
from quasimc._format import pair

METHODS = ("light_tracing", "from_organs", "ray_bundles", "first_hits")


def same(a, b):
    """Whether all fields of two estimates agree to rounding."""
    for field in ("values", "standard_error", "ci95_low", "ci95_high"):
        np.testing.assert_allclose(getattr(a, field), getattr(b, field), rtol=1e-12, atol=1e-15)


@pytest.fixture(scope="module")
def result():
    return canopy().run(**FEW)


@pytest.fixture(scope="module")
def light(result):
    return result["absorbed_flux"]["PAR"]


def split_canopy(masks):
    """A canopy whose labels say for each mask whether an organ belongs to it."""
    scene = canopy(masks.shape[1])
    (mesh,) = scene._meshes.values()
    mesh["labels"] = [(f"mask{i}", [str(int(x)) for x in mask]) for i, mask in enumerate(masks)]
    return scene


@pytest.mark.parametrize("method", METHODS)
def test_sums_over_masks_are_those_of_the_engine(method):
    masks = np.random.default_rng(3).random((25, 30)) < 0.4
    scene = split_canopy(masks)
    options = {"method": method, "paths": 256, "replicates": 4, "origins": ["sun", "sky"]}
    result = scene.run(groups=[f"mask{i}" for i in range(len(masks))], **options)
    for i, mask in enumerate(masks):
        row = [g["by"] == f"mask{i}" and g["value"] == "1" for g in result.groups.groups].index(True)
        for quantity in quasimc.quantities():
            of_group = result.groups[quantity][row]
            same(result.sum(quantity, mask), of_group)
            light = result[quantity]
            same(light[mask].sum() if light.extensive else light[mask].average(), of_group)
            same(result.sum(quantity, mask).origin("sky"), of_group.origin("sky"))
        same(result.sum("sunlit_fraction", mask), result.groups["sunlit_fraction"][row])
    assert i == 24


def test_groups_after_the_run_are_those_of_the_run(result):
    asked = canopy().run(**FEW, groups=["plant", "top: where height > 1.5"], layers=3)
    made = result.by("plant", "top: where height > 1.5", layers=3)
    for quantity in (*quasimc.quantities(), "sunlit_fraction", "fraction_incident"):
        same(made[quantity], asked.groups[quantity][1:])
    top = result.organs.where("height > 1.5")
    same(made["absorbed_flux"].at(made.groups[1]["value"] or "top"), result.sum("absorbed_flux", top))
    by = result.sum("absorbed_flux", by=top)
    same(by.at(True), result.sum("absorbed_flux", top))
    same(by.sum(), result.sum("absorbed_flux"))
    with pytest.raises(quasimc.InputError, match="no organ has a label 'plants'"):
        result.by("plants")


def test_errors_of_sums_are_not_those_of_quadrature(result):
    same_light = canopy(200).run(method="ray_bundles", paths=256, replicates=8)
    light = same_light["absorbed_flux"]["NIR"]
    quadrature = np.sqrt(np.sum(light.standard_error**2))
    assert light.sum().standard_error > 1.3 * quadrature


def test_selections_are_by_position_mask_band_and_name(result):
    light = result["absorbed_flux"]
    assert light.shape == (20, 2) and light.ndim == 2 and light.size == 40 and len(light) == 20
    assert light["PAR"].shape == (20,) and light["PAR"][3].shape == ()
    np.testing.assert_array_equal(light[2:5].values, light.values[2:5])
    np.testing.assert_array_equal(light[[7, 1]]["NIR"].values, light.values[[7, 1], 1])
    np.testing.assert_array_equal(light["PAR"][-1].values, light.values[-1, 0])
    assert light.at(3)["PAR"].values == light["PAR"][2].values
    assert light.at("organ 3")["PAR"].values == light["PAR"][2].values
    np.testing.assert_array_equal(light.at([9, 4]).values, light.values[[8, 3]])
    assert [float(x) for x in light["PAR"]] == light["PAR"].values.tolist()
    assert light[2:5].index.ids.tolist() == [3, 4, 5]
    with pytest.raises(IndexError, match=r"position 1001 of 20; by id: light.at\(1001\)"):
        light[1001]
    with pytest.raises(KeyError, match="did you mean 'PAR'"):
        light["par"]
    with pytest.raises(KeyError, match="no organ with the id 99"):
        light.at(99)
    with pytest.raises(KeyError, match="not among these 3 organs"):
        light[2:5].at(1)
    with pytest.raises(IndexError):
        light[np.ones(19, bool)]


def test_old_names_raise_with_the_new_one(result, light):
    with pytest.raises(TypeError):
        light.mean[0]
    with pytest.raises(AttributeError, match="`method` is now `run.method`"):
        result.method
    with pytest.raises(AttributeError, match="`select` is now `at`"):
        result.select([1])
    with pytest.raises(KeyError, match="did you mean 'absorbed_flux'"):
        result["absorbed"]


def test_weighted_sums_have_the_error_of_their_replicates(result, light):
    weights = np.random.default_rng(1).random(20)
    expected = light._source.spread()
    sums = (expected.deviations + expected.means) @ weights
    total = light.sum(weights=weights)
    assert total.values == pytest.approx(sums.mean())
    assert total.standard_error >= sums.std(ddof=1) / np.sqrt(len(sums)) * (1 - 1e-12)
    same((light * weights).sum(), total)
    same(weights @ light, total)
    mixed = light.sum(weights=weights - 0.5)
    sums = (expected.deviations + expected.means) @ (weights - 0.5)
    assert mixed.values == pytest.approx(sums.mean())
    assert mixed.standard_error >= sums.std(ddof=1) / np.sqrt(len(sums)) * (1 - 1e-12)
    assert mixed.ci95_low < mixed.values < mixed.ci95_high


def test_weights_that_are_missing_are_refused(light):
    weights = np.ones(20)
    weights[3] = np.nan
    for weighted in (
        lambda: light.sum(weights=weights),
        lambda: light.average(weights=weights),
        lambda: weights @ light,
        lambda: light @ weights,
    ):
        with pytest.raises(ValueError, match="1 of 20 weights of absorbed_flux are NaN; give 0, or a mask"):
            weighted()
    others = np.arange(20) != 3
    same(light.sum(weights=weights, where=others), light[others].sum())


def test_means_and_averages(result, light):
    assert light.mean().values == pytest.approx(light.values.mean())
    same(light.mean() * 20, light.sum())
    density = result["absorbed_flux_density"]["PAR"]
    same(density.average() * result.organs.areas.sum(), light.sum())
    mask = result.organs.heights > 1.5
    assert density.mean(where=mask).values == pytest.approx(density.values[mask].mean())
    with pytest.raises(ValueError, match="is per area"):
        density.sum()
    with pytest.raises(ValueError, match="over nothing"):
        density.mean(where=np.zeros(20, bool))


def test_differences_of_results_pair_their_replicates():
    scene = canopy(100)
    options = {"method": "ray_bundles", "paths": 256, "replicates": 8}
    a = scene.run(seed=1, **options)["absorbed_flux"]["NIR"].sum()
    scene.add_material("leaf", reflectance=[0.08, 0.46], transmittance=[0.06, 0.45])
    b = scene.run(seed=1, **options)["absorbed_flux"]["NIR"].sum()
    c = scene.run(seed=2, **options)["absorbed_flux"]["NIR"].sum()
    quadrature = np.hypot(a.standard_error, b.standard_error)
    assert (a - b).standard_error < 0.5 * quadrature, "common random numbers"
    assert (a - c).standard_error > 0.5 * quadrature, "a control: other ones"
    assert (a - b).values == pytest.approx(a.values - b.values)
    assert (a - b).differs(0) and not (a - a).differs(0)
    fewer = scene.run(seed=1, method="ray_bundles", paths=256, replicates=4)
    with pytest.raises(ValueError, match="4 and 8 replicates"):
        a - fewer["absorbed_flux"]["NIR"].sum()


def test_arithmetic_has_the_errors_of_first_order(light):
    x, y = light[0], canopy().run(**{**FEW, "seed": 77})["absorbed_flux"]["PAR"][1]
    sx, sy = (v._source.spread() for v in (x, y))
    for made, slopes in (
        (x + y, (1, 1)),
        (x - y, (1, -1)),
        (x * y, (y.values, x.values)),
        (x / y, (1 / y.values, -x.values / y.values**2)),
        (x**2 - y**2, (2 * x.values, -2 * y.values)),
        (np.log(x) - np.exp(-y), (1 / x.values, np.exp(-y.values))),
        (np.sqrt(x) + np.sqrt(y), (0.5 / np.sqrt(x.values), 0.5 / np.sqrt(y.values))),
        (1 / x - 3 / y, (-1 / x.values**2, 3 / y.values**2)),
        (5 - x + y, (-1, 1)),
    ):
        deviations = slopes[0] * sx.deviations + slopes[1] * sy.deviations
        # A contribution more of what is subtracted makes the difference less.
        sizes = [abs(k) * v.sizes[:: -1 if k < 0 else 1] for k, v in zip(slopes, (sx, sy))]
        size = np.hypot(*sizes).max()
        error = np.hypot(deviations.std(ddof=1) / 2, size)
        assert made.standard_error == pytest.approx(error, rel=1e-9)


def test_units_follow_arithmetic(result, light):
    assert (light / light).unit == "" and (light * light).unit == "W2"
    density = result["absorbed_flux_density"]["PAR"]
    assert (light / density).unit == "m2" and (2 * light).unit == "W"
    assert (density * result.organs.areas).unit == ""
    assert (density * result.organs.areas).with_unit("W").sum().unit == "W"
    with pytest.raises(ValueError, match="the units differ"):
        light + density
    assert result["absorbed_flux"].units == {"PAR": "W", "NIR": "W"}


def test_numpy_keeps_errors_or_refuses(light):
    same(np.sum(light), light.sum())
    same(np.mean(light), light.mean())
    assert np.asarray(light).tolist() == light.values.tolist()
    assert (light > 1).dtype == bool and np.isfinite(light).all()
    assert np.median(np.asarray(light)) == np.median(light.values)
    assert np.argsort(light).tolist() == np.argsort(light.values).tolist()
    with pytest.raises(TypeError, match="quasimc.propagate"):
        np.sin(light)
    with pytest.raises(TypeError, match="biased upwards"):
        np.max(light)
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(light)
    with pytest.raises(TypeError, match="20 estimates are not a single number"):
        float(light)
    assert float(light[0]) == light.values[0]


def test_any_function_is_propagated(light):
    def linear(x):
        return 3 * x[:5].sum() - x[6]

    made = quasimc.propagate(linear, light, unit="W", name="test")
    spread = light._source.spread()
    sums = np.array([linear(x) for x in spread.deviations + spread.means])
    assert made.values == pytest.approx(sums.mean())
    assert made.standard_error == pytest.approx(sums.std(ddof=1) / 2)
    assert made.unit == "W" and made.name == "test"
    curved = quasimc.propagate(lambda x: x / (x + 1), light)
    assert curved.index == light.index and curved.shape == light.shape
    with pytest.warns(quasimc.QuasimcWarning, match="use more paths"):
        quasimc.propagate(lambda x: np.abs(x - x.mean()) ** 0.01 * 0 + (x - light.values) ** 2, light)


def test_organs_must_be_the_same():
    few, many = (canopy(n).run(**FEW)["absorbed_flux"]["PAR"] for n in (15, 20))
    with pytest.raises(ValueError, match="quasimc.align"):
        few - many
    a, b = quasimc.align(many[::-1], few)
    assert a.index.ids.tolist() == b.index.ids.tolist() == list(range(15, 0, -1))
    assert (a - b).shape == (15,)


def test_a_mask_is_no_axis(light):
    with pytest.raises(TypeError, match="a mask is given as where="):
        light.sum(light.values > 0)


def test_errors_are_unknown_without_replicates():
    scene = canopy()
    plain = scene.run(**FEW, keep="estimates")
    light = plain["absorbed_flux"]["PAR"]
    assert not plain.has_replicates and np.all(light.standard_error > 0)
    with pytest.warns(quasimc.QuasimcWarning, match='keep="replicates"'):
        total = light.sum()
    assert total.values == pytest.approx(light.values.sum()) and np.isnan(total.standard_error)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        np.testing.assert_allclose((2 * light).standard_error, 2 * light.standard_error)
        np.testing.assert_allclose((light + 1).ci95_low, light.ci95_low + 1)
        assert np.all((-1 * light).ci95_high == -light.ci95_low)
    with pytest.raises(ValueError, match="were not kept"):
        plain.by("plant")
    with pytest.raises(ValueError, match="keep is 'all'; give one of auto"):
        scene.run(**FEW, keep="all")


def test_numbers_without_an_error_stay_so(light, recwarn):
    dark = quasimc.Estimates(np.zeros((20, 4)), "absorbed_flux", "W", index=light.index)
    total = dark.sum()
    assert total.values == 0 and total.standard_error == 0
    same(light - dark, light + 0 * light)
    assert np.all((dark + dark).standard_error == 0)
    assert not list(recwarn)


def test_the_ground_is_apart(result):
    assert len(result.organs) == 20 and result.organs.has_ground
    ground = result.ground["absorbed_flux"]["PAR"]
    same_flux = result.budget["absorbed_by_ground"]["PAR"]
    assert ground.values == pytest.approx(same_flux.values) and ground.standard_error > 0
    assert canopy().run(**FEW).ground is not None


def test_text_shows_errors(light):
    one = light.sum()
    assert f"{one:.2f}" == f"{float(one):.2f} ± {float(one.standard_error):.2f} W"
    assert repr(light).startswith("<absorbed_flux [W], 20 organs: ") and "; sum 82.1 ± 0.4" in repr(light)
    with pytest.raises(TypeError, match="formatted"):
        f"{light:.2f}"
    html = light._repr_html_()
    assert html.startswith("<table") and "<script" not in html


def test_tables_of_pandas(result, light):
    frame = light.to_pandas()
    assert list(frame.columns) == ["value", "standard_error"] and frame.index.name == "organ"
    both = result["absorbed_flux"].to_pandas()
    assert list(both.columns) == ["PAR", "PAR_se", "NIR", "NIR_se"]
    sums = result.sum("absorbed_flux").to_pandas()
    assert sums.index.tolist() == ["PAR", "NIR"]


@pytest.mark.parametrize("copied", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_estimates_are_pickled_with_their_replicates(light, copied):
    other = copied(light)
    same(other, light)
    assert other.index.ids.tolist() == light.index.ids.tolist() and other.unit == "W"
    np.testing.assert_allclose(
        (other[:4].sum() - light[:4].sum()).values, 0, atol=1e-12
    )


def numbers_of(seed, paths=512):
    """Sums, a difference, a ratio and a function, of small runs."""
    plain, bright = canopy(20), canopy(20)
    bright.add_material("leaf", reflectance=[0.08, 0.47], transmittance=[0.06, 0.45])
    run = {"method": "light_tracing", "paths": paths, "replicates": 8}
    a = plain.run(seed=seed, **run)["absorbed_flux"]["NIR"]
    b = bright.run(seed=seed + 10_000, **run)["absorbed_flux"]["NIR"]
    return {
        "mask": a[::3].sum(),
        "weights of both signs": a.sum(weights=np.linspace(-1, 1, 20)),
        "difference": a.sum() - b.sum(),
        "ratio": a[:5].sum() / a.sum(),
        "function": quasimc.propagate(lambda x: (x / (1 + x)).sum(), a),
    }


def test_intervals_contain_the_exact_value_as_often_as_they_say():
    runs, exact = 150, numbers_of(99, paths=2**18)
    hits = dict.fromkeys(exact, 0)
    all_values = {name: [] for name in exact}
    all_widths = {name: [] for name in exact}
    for seed in range(1, runs + 1):
        for name, light in numbers_of(seed).items():
            all_values[name].append(float(light))
            all_widths[name].append(float(light.ci95_high - light.ci95_low))
            hits[name] += light.ci95_low <= exact[name].values <= light.ci95_high
    # 95 % less five standard errors of a fraction of these runs.
    least = runs * (0.95 - 5 * np.sqrt(0.95 * 0.05 / runs))
    assert {name: count for name, count in hits.items() if count < least} == {}
    for name in exact:  # Student's t of 7 degrees of freedom: 4.7 standard deviations
        assert np.mean(all_widths[name]) < 8 * np.std(all_values[name]), f"{name}: too wide to be a test"
    half = sum(
        abs(float(numbers_of(seed)["mask"]) - float(exact["mask"]))
        < 0.5 * numbers_of(seed)["mask"].standard_error
        for seed in range(1, 31)
    )
    assert half < 30 * 0.75, "a control: half a standard error contains it less often"


def test_masks_are_no_ids_and_labels_exist():
    light = canopy().run(**FEW)["absorbed_flux"]["PAR"]
    with pytest.raises(TypeError, match="a mask selects by"):
        light.at(np.ones(len(light), bool))
    with pytest.raises(TypeError, match="takes Estimates"):
        quasimc.propagate(np.sum, light.values)
    with pytest.raises(TypeError, match="takes light of organs"):
        quasimc.align(light.sum(), light.sum())


def test_groups_are_found_by_numbers_too():
    groups = canopy().run(**FEW).by("plant")["absorbed_flux"]["PAR"]
    assert float(groups.at(1)) == float(groups.at("1"))


KNOWN = [
    (0.0213, "12.346 ± 0.021"), (0.0294, "12.346 ± 0.029"), (0.0296, "12.35 ± 0.03"), (2.9, "12.3 ± 2.9"),
    (3, "12 ± 3"), (math.nan, "12.35 ± ?"),
]


@pytest.mark.parametrize(("error", "text"), KNOWN)
def test_errors_have_two_digits_if_they_begin_with_1_or_2(error, text):
    assert pair(12.3456, error) == text
