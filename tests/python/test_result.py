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
    assert light.values.shape == (20,) and light.values.dtype == np.float64
    assert light.unit == "W" and result["incident_upper"]["NIR"].unit == "W m-2"
    assert np.all((light.ci95_low <= light.values) & (light.values <= light.ci95_high))
    assert np.all(light.standard_error > 0)
    assert result["absorbed_flux"].values.shape == (20, 2)
    assert np.array_equal(result["absorbed_flux"].values[:, 0], light.values)


def test_all_quantities_are_there(result):
    assert set(result) == set(quasimc.quantities()) | {"sunlit_fraction"}
    density = result["absorbed_flux_density"]["NIR"].values
    assert np.allclose(density * result.organs.areas, result["absorbed_flux"]["NIR"].values)
    assert np.all(result["sunlit_fraction"].ci95_low <= 1)


def test_numbers_are_views_that_cannot_be_changed(result):
    light = result["absorbed_flux"]["PAR"].values
    assert np.shares_memory(light, result._core.values)
    with pytest.raises(ValueError):
        light[0] = 1


def test_arrays_outlive_their_result():
    light = canopy().run(**FEW)["absorbed_flux"]["PAR"].values
    again = canopy().run(**FEW)["absorbed_flux"]["PAR"].values
    assert np.array_equal(light, again)


def test_what_is_not_there_is_told(result):
    with pytest.raises(KeyError, match="absorbed_flux_density"):
        result["light"]
    with pytest.raises(KeyError, match="PAR, NIR"):
        result["absorbed_flux"]["FIR"]


def test_energy_closes(result):
    budget = result.budget
    parts = ("absorbed_by_organs", "absorbed_by_ground", "escaped", "cut_off")
    total = sum(budget[key].values for key in parts)
    assert total == pytest.approx(budget["emitted"].values + budget["imbalance"].values, rel=1e-9)
    with pytest.raises(KeyError, match="the part comes first"):
        budget["PAR"]


def test_rounds_tell_how_errors_fell():
    scene = canopy()
    assert scene.run(**FEW).run.rounds == []
    result = scene.run(paths=1024, replicates=4, max_paths=4096)
    rounds = result.run.rounds
    assert len(rounds) >= 2
    paths = [known["paths"] for known in rounds]
    assert paths[0] == 1024 and paths == sorted(paths) and paths[-1] == result.run.paths
    light = result["absorbed_flux"]
    errors = light.relative_error
    assert rounds[-1]["worst_error"] == pytest.approx(errors.max(), rel=1e-12)
    middle = np.sort(errors, axis=None)[errors.size // 2]
    assert rounds[-1]["median_error"] == pytest.approx(middle, rel=1e-12)
    assert rounds[-1]["fraction_at_target"] == 0


def test_groups_sum_their_organs(result):
    everything = result.groups.groups[0]
    assert everything["by"] == "all" and len(everything["organs"]) == 20
    total = result.groups["absorbed_flux"]["PAR"].values[0]
    assert total == pytest.approx(result["absorbed_flux"]["PAR"].values.sum(), rel=1e-12)
    assert [g["by"] for g in result.groups.groups] == ["all", "plant", "layer", "layer"]
    assert len(result.groups.to_pandas()) == 4


def test_ratios_and_audit_are_there(result):
    sides = result["incident_upper"].values + result["incident_lower"].values
    assert np.allclose(result.ratios["PAR:NIR"].values, sides[:, 0] / sides[:, 1])
    assert result.run.audit["agrees"] is True and 0 <= result.run.audit["p_value"] <= 1


def test_a_table_of_pandas_has_the_columns_of_csv(result):
    frame = result.to_pandas()
    assert frame.index.tolist() == result.organs.ids.tolist()
    assert list(frame.columns[:4]) == ["name", "plant", "area", "absorbed_flux_PAR"]
    assert frame.attrs["units"]["absorbed_flux_PAR"] == "W"
    assert "ratio_PAR:NIR_se" in frame and "sunlit_fraction_ci95_high" in frame
    light = result["absorbed_flux"]["NIR"]
    assert np.array_equal(frame["absorbed_flux_NIR_se"], light.standard_error, equal_nan=True)


def test_a_dataset_of_xarray_has_names_and_units(result):
    pytest.importorskip("xarray")
    data = result.to_xarray()
    light = data["absorbed_flux"].sel(band="NIR", statistic="mean")
    assert np.array_equal(light, result["absorbed_flux"]["NIR"].values)
    assert data["absorbed_flux"].attrs["units"] == "W"


def test_a_picture_is_drawn_of_every_organ(result):
    pytest.importorskip("matplotlib")
    import matplotlib.pyplot as pyplot

    axes = result.plot.scene("incident_upper", "NIR", vmin=0)
    assert len(axes.collections) == 1
    faces = axes.collections[0]
    axes.get_figure().canvas.draw()
    assert len(faces.get_paths()) == 20 * 2
    assert axes.figure.axes[1].get_ylabel() == "incident upper, NIR [W m\u207b\u00b2]"
    pyplot.close("all")


def test_a_notebook_shows_numbers_with_errors(result):
    html = result._repr_html_()
    assert html.count("<tr>") == 13 and "&plusmn;" in html and "8 more organs" in html


def test_plotting_is_imported_when_it_is_asked_for():
    import subprocess

    code = "import sys, quasimc; print({'matplotlib', 'pandas', 'xarray'} & set(sys.modules))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "set()"


def test_a_detector_counts_what_escapes():
    scene = canopy()
    scene.add_detector("escaped_by_zenith", rings=3)
    scene.add_detector("escaped_by_zenith", name="up", rings=2)
    result = scene.run(**FEW, method="light_tracing")
    assert list(result.detectors) == ["escaped_by_zenith", "up"]
    seen = result.detectors["escaped_by_zenith"]
    assert seen.values.shape == (3, 2) and len(seen.bins) == 3
    assert (seen.type, seen.quantity) == ("escaped_by_zenith", "zenith angle (deg)")
    assert seen["NIR"].values.shape == (3,) and seen["NIR"].unit == "W"
    assert (seen.ci95_low <= seen.values).all() and (seen.values <= seen.ci95_high).all()
    with pytest.raises(KeyError):
        seen["blue"]


def test_detectors_have_dimensions_of_their_own_in_xarray():
    pytest.importorskip("xarray")
    scene = canopy()
    scene.add_detector("escaped_by_zenith", name="up", rings=2)
    result = scene.run(**FEW, method="light_tracing")
    up = result.detectors["up"]
    assert up.to_xarray().dims == ("bin", "band", "statistic")
    data = result.to_xarray()
    assert data.up.dims == ("up_bin", "band", "statistic")
    assert list(data.up_bin.values) == ["0 to 90", "90 to 180"] and data.up.attrs["units"] == "W"
    mean = data.up.sel(up_bin="0 to 90", band="NIR", statistic="mean")
    assert float(mean) == up["NIR"].values[0]


def test_detectors_take_no_name_of_light_in_xarray():
    pytest.importorskip("xarray")
    names = ("absorbed_flux", "organ", "up", "up_bin", "detector_organ", "plant")
    scene = canopy()
    for name in names:
        scene.add_detector("escaped_by_zenith", name=name, rings=2)
    result = scene.run(**FEW, method="light_tracing")
    data = result.to_xarray()
    light = data["absorbed_flux"].sel(band="NIR", statistic="mean")
    assert np.array_equal(light, result["absorbed_flux"]["NIR"].values)
    assert np.array_equal(data["organ"], result.organs.ids)
    assert data["plant"].dims == ("organ",)
    for name in names:
        variable = name if name in ("up", "detector_organ") else f"detector_{name}"
        variable = "detector_detector_organ" if name == "organ" else variable
        assert data[variable].dims == (f"{variable}_bin", "band", "statistic")
        assert np.array_equal(data[variable].sel(statistic="mean"), result.detectors[name].values)


def test_sunlit_fractions_are_there_where_a_source_is_directional(result):
    sky = canopy().run(quasimc.sky(irradiance_horizontal=100), **FEW, groups=["plant"])
    for light in (sky, sky.groups, sky.at([1])):
        assert "sunlit_fraction" not in list(light)
        with pytest.raises(KeyError) as caught:
            light["sunlit_fraction"]
        assert "sunlit_fraction" not in str(caught.value).split("there are:")[1]
    assert not any("sunlit" in column for column in sky.groups.to_pandas())


def test_the_table_of_groups_has_the_columns_of_csv(result):
    frame = result.groups.to_pandas()
    assert list(frame.columns[:8]) == [
        "by", "value", "organs", "area", "height_min", "height_max", "plant_area_index",
        "cumulative_plant_area_index",
    ]  # fmt: skip
    last = list(frame.columns[-21:])
    shares = [
        f"fraction_{of}_{band}" for band in ("PAR", "NIR") for of in ("incident", "absorbed")
    ]
    assert last == [
        f"{name}{end}"
        for name in ("sunlit_fraction", "sunlit_area", "ratio_PAR:NIR", *shares)
        for end in ("", "_se", "_ci95_high")
    ]
    absorbed = frame["absorbed_flux_PAR"]
    assert np.allclose(frame["fraction_absorbed_PAR"], absorbed / absorbed[0])
    assert np.allclose(frame["sunlit_area"], frame["sunlit_fraction"] * frame["area"])
    layers = frame[frame["by"] == "layer"]
    assert layers["cumulative_plant_area_index"].iloc[0] == pytest.approx(
        layers["plant_area_index"].sum()
    )
    sides = result.groups["incident_upper"].values + result.groups["incident_lower"].values
    ratio = result.groups.ratios["PAR:NIR"].values
    assert np.allclose(ratio[:2], sides[:2, 0] / sides[:2, 1])
    assert np.array_equal(frame["ratio_PAR:NIR"], ratio, equal_nan=True)


def test_labels_take_no_column_of_light():
    names = ("absorbed_flux_PAR", "sunlit_fraction", "name", "label_name", "organ", "absorbed_flux")
    scene = quasimc.Scene("PAR").add_material("leaf", reflectance=0.1)
    scene.add_mesh(
        [[[0, 0, 1], [1, 0, 1], [0, 1, 1]]],
        material="leaf",
        labels={name: f"label {name}" for name in names},
    )
    result = scene.run(quasimc.sun(azimuth_deg=0, elevation_deg=90, irradiance_facing=100), **FEW)
    frame = result.to_pandas()
    assert frame["absorbed_flux_PAR"].iloc[0] == result["absorbed_flux"]["PAR"].values[0]
    assert frame["sunlit_fraction"].iloc[0] == result["sunlit_fraction"].values[0] > 0.9
    assert frame["name"].iloc[0] == "organ 1"
    assert frame["label_absorbed_flux_PAR"].iloc[0] == "label absorbed_flux_PAR"
    assert frame["label_sunlit_fraction"].iloc[0] == "label sunlit_fraction"
    assert frame["label_label_name"].iloc[0] == "label name"
    assert frame["label_name"].iloc[0] == "label label_name"
    pytest.importorskip("xarray")
    data = result.to_xarray()
    assert data["organ"].values.tolist() == [1] and data["label_organ"].values == "label organ"
    assert data["label_absorbed_flux"].values == "label absorbed_flux"


def test_ids_and_areas_cannot_be_changed(result):
    for array in (result.organs.ids, result.organs.areas):
        with pytest.raises(ValueError):
            array[0] = 7


def test_many_organs_are_selected_by_name_in_one_pass():
    class Names(list):
        passes = 0

        def __iter__(self):
            Names.passes += 1
            return super().__iter__()

    organs = canopy().run(**FEW).organs
    names = list(organs.names)
    organs.__dict__["names"] = Names(names)
    assert [organs.index_of(name) for name in names] == list(range(len(names)))
    assert Names.passes == 1


@pytest.mark.filterwarnings("ignore:scene. the scene has a mesh of the name")
def test_a_name_of_several_organs_is_refused():
    scene = quasimc.Scene("PAR").add_material("leaf", reflectance=0.1)
    for height in (1, 2, 3):
        face = [[[0, 0, height], [1, 0, height], [0, 1, height]]]
        scene.add_mesh(face, material="leaf", name="top" if height == 3 else "leaf")
    sun = quasimc.sun(azimuth_deg=0, elevation_deg=90, irradiance_facing=100)
    organs = scene.run(sun, **FEW).organs
    assert organs.index_of("top") == 2
    with pytest.raises(KeyError, match="2 organs have the name 'leaf': use an id"):
        organs.index_of("leaf")
    with pytest.raises(KeyError, match="there is no organ 'tap'; there are: 'top'"):
        organs.index_of("tap")


def test_organs_are_selected_by_whole_ids(result):
    assert result.at(np.array([3, 1]))["absorbed_flux"].index.ids.tolist() == [3, 1]
    for organ in (1.7, "1", 99):
        with pytest.raises(KeyError):
            result.at([organ])


def test_means_lie_in_their_intervals():
    scene = canopy()
    cut = 0
    for seed in range(1, 6):
        result = scene.run(method="light_tracing", paths=64, replicates=4, seed=seed)
        for light in (result, result.groups):
            for quantity in light.keys():
                e = light[quantity]
                assert np.all((e.ci95_low <= e.values) & (e.values <= e.ci95_high)), quantity
        fraction = result["sunlit_fraction"]
        assert np.all((fraction.values >= 0) & (fraction.values <= 1))
        cut += np.count_nonzero(fraction.values == fraction.ci95_high)
        for part in ("absorbed_by_organs", "absorbed_by_ground", "escaped"):
            light = result.budget[part]["PAR"]
            assert light.ci95_low <= light.values <= light.ci95_high
    assert cut > 0, "a control: some are cut at what is possible"


def test_light_by_origin_adds_up_to_the_whole():
    result = canopy().run(**FEW, origins=["sun", "sky"], groups=["plant"])
    assert result.origins == ("sun", "sky")
    for light in (result, result.groups, result.at(result.organs.ids[:3])):
        whole = light["incident_scattered"]
        parts = [whole.origin(name) for name in light.origins]
        assert np.all(parts[0]["PAR"].values[:2] > 0) and parts[0].unit == whole.unit
        assert np.allclose(sum(part.values for part in parts), whole.values)
        assert np.array_equal(parts[1]["NIR"].values, whole["NIR"].origin("sky").values)
    assert "absorbed_flux_PAR_from_sky_se" in result.to_pandas()
    with pytest.raises(KeyError, match="there are: sun, sky"):
        result["absorbed_flux"]["PAR"].origin("lamps")
    with pytest.raises(quasimc.InputError, match="no source is called 'lamp'"):
        canopy().run(**FEW, origins=["lamp"])
