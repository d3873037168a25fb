"""Plots of numbers by matplotlib."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy
from quasimc.plotting import fit_exponential

pyplot = pytest.importorskip("matplotlib.pyplot")
SOURCE = Path(os.environ["QUASIMC_SOURCE_DIR"])


@pytest.fixture(scope="module")
def result():
    return canopy().run(**FEW)


@pytest.fixture(autouse=True)
def close_plots():
    yield
    pyplot.close("all")


def test_organs_without_an_area_have_no_profile():
    line = quasimc.Scene(bands=["PAR"])
    line.add_material("leaf", reflectance=0.1)
    line.add_mesh([[0, 0, 1], [1, 0, 1], [2, 0, 1]], [[0, 1, 2]], material="leaf")
    line.sources.append(quasimc.uniform_sky(irradiance_horizontal=1))
    with pytest.raises(ValueError, match="no organ with an area"):
        line.run(**FEW).plot.profile()


@pytest.mark.parametrize("amount, rate", [(0.8, 1.5), (3e-4, 0.004), (2, -0.01), (5, 0)])
def test_a_fit_finds_the_curve_that_points_lie_on(amount, rate):
    x = np.arange(1, 501) / (500 if rate > 1 else 1)
    assert fit_exponential(x, amount * np.exp(-rate * x)) == pytest.approx((amount, rate), 1e-7)


def test_a_fit_leaves_the_least_squares():
    x, y = np.arange(4), np.array([4.2, 1.9, 1.1, 0.4])
    amount, rate = fit_exponential(x, y)

    def deviations(amount, rate):
        return np.sum((y - amount * np.exp(-rate * x)) ** 2)

    for by in (-1e-3, 1e-3):
        assert deviations(amount + by, rate) > deviations(amount, rate)
        assert deviations(amount, rate + by) > deviations(amount, rate)


def test_a_fit_refuses_what_has_no_curve():
    for x, y in (([1, 2], [1, 2]), ([1, 1, 1], [1, 2, 3]), ([1, 2, 3], [1, np.nan, 3]), ([], [])):
        assert fit_exponential(x, y) is None


def organs_of(axes):
    """Where the points stand, and the ends of their error bars."""
    container = axes.containers[-1]
    return container[0].get_xydata(), np.array(container[2][0].get_segments())


def test_a_profile_shows_each_organ_at_its_height_with_its_interval(result):
    axes = result.plot.profile("incident_upper", "NIR", layers=5)
    light = result["incident_upper"]["NIR"]
    places, bars = organs_of(axes)
    leaves = len(result.organs)
    top = max(range(leaves), key=lambda i: result.organs.triangles(i)[..., 2].mean())
    assert len(places) == leaves and np.all(np.diff(places[:, 1]) <= 0)
    assert places[0] == pytest.approx(
        (light.values[top], result.organs.triangles(top)[..., 2].mean()), 1e-9
    )
    assert bars[0, :, 0] == pytest.approx((light.ci95_low[top], light.ci95_high[top]), 1e-9)
    assert axes.get_xlabel() == "incident upper, NIR [W m\u207b\u00b2]" and axes.get_ylabel() == "height [m]"
    assert [text.get_text() for text in axes.get_legend().texts][0] == "means of layers"


def test_organs_are_counted_from_the_top_and_results_share_axes(result):
    axes = result.plot.light_by_index(label="one")
    other = canopy().run(**{**FEW, "seed": 5})
    assert other.plot.light_by_index(ax=axes, label="two") is axes
    labels = [text.get_text() for text in axes.get_legend().texts]
    assert sum(label.startswith("one: mean ") for label in labels) == 1
    assert sum(label.startswith("two: mean ") for label in labels) == 1
    places, _ = organs_of(axes)
    assert np.array_equal(places[:, 0], np.arange(1, len(result.organs) + 1))
    assert sorted(places[:, 1]) == sorted(other["absorbed_flux_density"]["PAR"].values)


def test_a_variance_is_that_between_replicates(result):
    axes = result.plot.light_by_index("absorbed_flux", "PAR", variance=True)
    errors = result["absorbed_flux"]["PAR"].standard_error
    heights = sorted(axes.containers[0][0].get_ydata())
    assert heights == pytest.approx(sorted(result.run.replicates * errors**2), 1e-9)
    assert axes.get_ylabel() == "variance of absorbed flux [(W)\u00b2]"


def test_the_figures_of_the_paper_are_drawn(tmp_path):
    script = str(SOURCE / "examples" / "02-paper" / "paper.py")
    options = ["--out", ".", "--replicates", "2", "--paths", "2048", "--target", "0.1"]
    said = subprocess.run(
        [sys.executable, script, *options],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        timeout=300,
    )
    assert said.returncode == 0, said.stderr
    assert "Korobov, 2,048 paths" in said.stdout and "ray bundles" in said.stdout
    for name in ("figure3-irradiance", "figure3-variance"):
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert "<svg" in (tmp_path / f"{name}.svg").read_text()
    rows = (tmp_path / "variance.csv").read_text().splitlines()
    assert rows[2] == "leaf,depth,monte_carlo,korobov,monte_carlo_fitted,korobov_fitted"
    assert len(rows) == 503


def test_a_histogram_shows_shares_of_the_area(result):
    axes = result.plot.histogram("incident_upper", "NIR", bins=[0, 100, 200, 1e6])
    light, areas = result["incident_upper"]["NIR"].values, result.organs.areas
    for bar, low, high in zip(axes.patches, (0, 100, 200), (100, 200, 1e6)):
        share = 100 * areas[(light >= low) & (light < high)].sum() / areas.sum()
        assert bar.get_height() == pytest.approx(share)
    assert axes.get_ylabel() == "area of organs [%]"
    mean = result["incident_upper"]["NIR"].average().values
    assert axes.lines[0].get_xdata()[0] == pytest.approx(mean)
    with pytest.raises(ValueError, match="no organ with an area"):
        result.plot.histogram(where=[False] * 20)


def test_convergence_shows_the_rounds(result):
    with pytest.raises(ValueError, match="one round"):
        result.plot.convergence()
    run = canopy().run(paths=256, replicates=4, max_paths=2048)
    worst, median, _ = run.plot.convergence().lines
    assert median.get_xdata().tolist() == [known["paths"] for known in run.run.rounds]
    assert worst.get_ydata() == pytest.approx([100 * k["worst_error"] for k in run.run.rounds])


def test_the_course_of_a_day_has_hours_and_bands_of_error():
    scene = canopy()
    scene.site = quasimc.Site(52, 5)
    day = quasimc.day("2024-06-21", utc_offset_hours=2, hours=[9, 13])
    series = scene.series(day, paths=256, replicates=4, groups=["plant"])
    axes = series.plot.course("absorbed_flux", "PAR", by="plant")
    expected = [float(r.groups["absorbed_flux"]["PAR"].at("1")) for r in series]
    assert axes.lines[0].get_ydata() == pytest.approx(expected)
    assert axes.lines[0].get_xdata()[0].utcoffset().total_seconds() == 7200
    assert len(axes.collections) == 1 and axes.get_ylabel() == "absorbed flux, PAR [W]"
    with pytest.raises(quasimc.InputError, match="no groups 'leaf'"):
        series.plot.course(by="leaf")


def test_old_plots_name_the_new_ones(result):
    with pytest.raises(TypeError, match="is now `result.plot.scene"):
        result.plot()
    with pytest.raises(AttributeError, match="`plot_profile` is now `plot.profile`"):
        result.plot_profile()
