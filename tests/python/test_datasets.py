"""Results, days and sweeps as datasets of xarray."""

import os

import numpy as np
import pytest

import quasimc
from canopies import DAY, FEW, canopy, stand

xarray = pytest.importorskip("xarray")
needs_program = pytest.mark.skipif(
    not os.environ.get("QUASIMC_PROGRAM"), reason="the program was not built"
)


@pytest.fixture(scope="module")
def series():
    options = {"groups": ["plant"], "origins": ["sun", "sky"], "ratios": ["PAR:NIR"]}
    return stand().series(DAY, sun_shade="apart", **options, **FEW)


@pytest.fixture(scope="module")
def data(series):
    return series.to_xarray()


def values_of(variable):
    """Of a variable whose last dimensions are band and statistic."""
    return variable.transpose(..., "band", "statistic").values


def test_a_series_has_an_axis_of_times(series, data):
    assert dict(data.sizes).items() >= {"time": 5, "organ": 12, "band": 2, "day": 1, "group": 2}.items()
    np.testing.assert_array_equal(values_of(data.absorbed_flux), series["absorbed_flux"]._values)
    assert str(data.time.values[2]).startswith("2024-06-21T05:00") and data.time_text[2] == series.times[2]["time"]
    at_ten = data.sel(time="2024-06-21T09:00", band="PAR", statistic="standard_error", organ=3)
    assert at_ten.incident_upper.item() == series[4]["incident_upper"]["PAR"].at(3).standard_error
    assert data.absorbed_flux.attrs["units"] == "umol s-1, W"
    assert data.absorbed_flux.attrs["long_name"] == quasimc.quantities()["absorbed_flux"]


def test_a_series_has_groups_sensors_origins_ratios_and_parts(series, data):
    light = series[4]
    now = data.isel(time=4)
    same = {
        "group_absorbed_flux": light.groups["absorbed_flux"],
        "bench_incident_upper": light.sensors["bench"]["incident_upper"],
        "up": light.detectors["up"],
        "incident_upper_sunlit": light.sun_shade["incident_upper_sunlit"],
    }
    for name, own in same.items():
        np.testing.assert_array_equal(values_of(now[name]), own._values)
    sky = now.absorbed_flux_by_origin.sel(origin="sky")
    np.testing.assert_array_equal(values_of(sky), light["absorbed_flux"].origin("sky")._values)
    ratio = now.light_ratio.sel(ratio="PAR:NIR", statistic="mean")
    np.testing.assert_array_equal(ratio, light.ratios["PAR:NIR"].values)
    assert data.group_value.values.tolist() == ["", "1"]
    assert np.isnan(data.sunlit_fraction[0]).all() and not np.isnan(data.sunlit_fraction[4]).any()


def test_a_series_has_days(series, data):
    day = series.days["2024-06-21"]
    now = data.sel(day="2024-06-21")
    same = {
        "absorbed_flux_day_sum": day["absorbed_flux"],
        "group_absorbed_flux_day_sum": day.groups["absorbed_flux"],
        "bench_incident_upper_day_sum": day.sensors["bench"]["incident_upper"],
        "bench_transmittance_day_mean": day.sensors["bench"]["transmittance"],
        "incident_upper_sunlit_day_mean": day.sun_shade["incident_upper_sunlit"],
        "incident_upper_direct_day_sum": day.sun_shade["incident_upper_direct"],
    }
    for name, own in same.items():
        np.testing.assert_array_equal(values_of(now[name]), own._values)
    np.testing.assert_array_equal(now.sunlit_hours.values, day.sun_shade["sunlit_hours"]._values)
    hours = day.sensors["bench"]["sunlit_hours"]
    np.testing.assert_array_equal(now.bench_sunlit_hours.values, hours._values)
    fractions = [step.sensors["bench"]["sunlit_fraction"].values for step in series[1:]]
    np.testing.assert_allclose(hours.values, 2 * np.sum(fractions, axis=0), rtol=2e-3)  # fractions end at 1
    assert hours.unit == "h" and now.bench_sunlit_hours.attrs["units"] == "h"
    assert now.absorbed_flux_day_sum.attrs["units"] == "mol, J"


@needs_program
def test_names_and_numbers_are_those_of_netcdf(series, data, tmp_path):
    pytest.importorskip("netCDF4")
    with xarray.open_dataset(series.save(tmp_path / "day.nc")) as file:
        its = file.isel(organ=slice(0, 12))  # the ground is the last
        ours = data.isel(time=slice(1, None)).sel(statistic="mean")  # without the night
        assert ours.time.values.tolist() == its.time.values.tolist()
        assert ours.time_text.values.tolist() == its.time_text.values.tolist()
        assert "bench_transmittance_NIR_day_mean" in its and "bench_sunlit_hours" in its
        compared = 0
        for name, variable in ours.data_vars.items():
            by_band = "band" in variable.dims
            for band in variable.band.values if by_band else [""]:
                own = variable.sel(band=band) if by_band else variable
                called = netcdf_name(name, band)
                if called in its:
                    same = its[called]
                    np.testing.assert_array_equal(own.transpose(*same.dims).values, same.values)
                    compared += 1
        assert compared > 60


def netcdf_name(name, band):
    """The variable of a band, as the bands have different units."""
    ends = [end for end in ("_day_sum", "_day_mean", "_by_origin") if end in name]
    first, end, rest = name.partition(ends[0]) if ends else (name, "", "")
    return f"{first}_{band}{end}{rest}" if band else name


def test_sums_alone_and_instants_have_datasets():
    scene = stand()
    sums = scene.series(DAY, keep="sums", **FEW).to_xarray()
    assert "time" not in sums.dims and sums.sizes["day"] == 1 and "absorbed_flux" not in sums
    noon = quasimc.times(["2024-06-21T12:00+01:00"])
    assert "day" not in scene.series(noon, **FEW).to_xarray().dims


def test_swept_keys_are_dimensions():
    scene = canopy(6)
    sweep = scene.sweep({"ground.material": ["soil", "leaf"], "paths": [256, 512, 1024]}, replicates=4)
    data = sweep.to_xarray()
    assert data.absorbed_flux.dims == ("ground_material", "paths", "organ", "band", "statistic")
    point = data.sel(ground_material="leaf", paths=512).absorbed_flux
    np.testing.assert_array_equal(values_of(point), sweep[4]["absorbed_flux"]._values)
    zipped = scene.sweep({"seed": [1, 2], "paths": [256, 512]}, combine="zip", replicates=4).to_xarray()
    assert zipped.absorbed_flux.dims[0] == "point" and zipped.paths.values.tolist() == [256, 512]


def test_points_with_other_organs_are_refused():
    results = [canopy(count).run(**FEW) for count in (3, 4)]
    sweep = quasimc.Sweep([{"count": 3}, {"count": 4}], results)
    with pytest.raises(ValueError, match="the points differ along 'organ': take each alone"):
        sweep.to_xarray()
