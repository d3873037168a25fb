import sys

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy


@pytest.fixture(scope="module")
def result():
    return canopy().run(**FEW, ratios=["PAR:NIR"], groups=["plant"], layers=2, audit=0.5)


def test_numbers_come_by_quantity_and_band_with_errors_and_units(result):
    light = result["absorbed_flux"]["PAR"]
    assert light.mean.shape == (21,) and light.mean.dtype == np.float64
    assert light.unit == "W" and result["incident_upper"]["NIR"].unit == "W m-2"
    assert np.all((light.low <= light.mean) & (light.mean <= light.high))
    assert np.all(light.standard_error[:-1] > 0)
    assert np.array_equal(result["absorbed"]["PAR"].mean, light.mean)
    assert result["absorbed_flux"].mean.shape == (21, 2)
    assert np.array_equal(result["absorbed_flux"].mean[:, 0], light.mean)


def test_all_quantities_are_there(result):
    assert set(result) == set(quasimc.quantities()) | {"sunlit_fraction"}
    density = result["absorbed_flux_density"]["NIR"].mean
    assert np.allclose(density * result.organs.areas, result["absorbed_flux"]["NIR"].mean)
    assert np.all(result["sunlit_fraction"].low <= 1)


def test_numbers_are_views_that_cannot_be_changed(result):
    light = result["absorbed_flux"]["PAR"].mean
    assert np.shares_memory(light, result._core.values)
    with pytest.raises(ValueError):
        light[0] = 1


def test_arrays_outlive_their_result():
    light = canopy().run(**FEW)["absorbed_flux"]["PAR"].mean
    again = canopy().run(**FEW)["absorbed_flux"]["PAR"].mean
    assert np.array_equal(light, again)


def test_what_is_not_there_is_told(result):
    with pytest.raises(KeyError, match="absorbed_flux_density"):
        result["light"]
    with pytest.raises(KeyError, match="PAR, NIR"):
        result["absorbed_flux"]["FIR"]


def test_energy_closes(result):
    for budget in result.budget.values():
        parts = ("absorbed_by_organs", "absorbed_by_ground", "escaped", "cut_off")
        total = sum(budget[key].mean for key in parts)
        assert total == pytest.approx(budget["emitted"].mean + budget["roulette"].mean, rel=1e-9)


def test_groups_sum_their_organs(result):
    everything = result.groups.groups[0]
    assert everything["by"] == "all" and len(everything["organs"]) == 20
    total = result.groups["absorbed_flux"]["PAR"].mean[0]
    assert total == pytest.approx(result["absorbed_flux"]["PAR"].mean[:-1].sum(), rel=1e-12)
    assert [g["by"] for g in result.groups.groups] == ["all", "plant", "layer", "layer"]
    assert len(result.groups.to_pandas()) == 4


def test_ratios_and_audit_are_there(result):
    sides = result["incident_upper"].mean + result["incident_lower"].mean
    assert np.allclose(result.ratios["PAR:NIR"].mean, sides[:, 0] / sides[:, 1])
    assert result.audit["agrees"] is True and 0 <= result.audit["chance"] <= 1


def test_a_table_of_pandas_has_the_columns_of_csv(result):
    frame = result.to_pandas()
    assert frame.index.tolist() == result.organs.ids.tolist()
    assert list(frame.columns[:4]) == ["name", "plant", "area", "absorbed_flux_PAR"]
    assert frame.attrs["units"]["absorbed_flux_PAR"] == "W"
    assert "ratio_PAR:NIR_se" in frame and "sunlit_fraction_high" in frame
    light = result["absorbed_flux"]["NIR"]
    assert np.array_equal(frame["absorbed_flux_NIR_se"], light.standard_error, equal_nan=True)


def test_a_dataset_of_xarray_has_names_and_units(result):
    pytest.importorskip("xarray")
    data = result.to_xarray()
    light = data["absorbed_flux"].sel(band="NIR", statistic="mean")
    assert np.array_equal(light, result["absorbed_flux"]["NIR"].mean)
    assert data["absorbed_flux"].attrs["units"] == "W"


def test_a_picture_is_drawn_of_every_organ(result):
    pytest.importorskip("matplotlib")
    import matplotlib.pyplot as pyplot

    axes = result.plot("incident_upper", "NIR", vmin=0)
    assert len(axes.collections) == 1
    faces = axes.collections[0]
    assert len(faces._vec.T) == 20 * 2 * 3
    assert axes.figure.axes[1].get_ylabel() == "incident_upper [W m-2]"
    pyplot.close("all")


def test_a_notebook_shows_numbers_with_errors(result):
    html = result._repr_html_()
    assert html.count("<tr>") == 13 and "&plusmn;" in html and "9 more organs" in html


def test_plotting_is_imported_when_it_is_asked_for():
    import subprocess

    code = "import sys, quasimc; print({'matplotlib', 'pandas', 'xarray'} & set(sys.modules))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "set()"


def test_a_detector_counts_what_escapes():
    scene = canopy()
    scene.add_detector("escaped_by_zenith", rings=3)
    seen = scene.run(**FEW, method="light_tracing").detectors[0]
    assert seen["values"].shape == (3, 2, 4) and len(seen["bins"]) == 3
