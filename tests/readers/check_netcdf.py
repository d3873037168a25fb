#!/usr/bin/env python3
"""Compares the NetCDF that quasimc writes with its JSON: check_netcdf.py QUASIMC"""

import csv
import json
import sys
import tempfile
from pathlib import Path

import numpy as np
import xarray
from program import run_in

HEAD = """
title = "Two leaves"
length_unit = "cm"
{bands}
[run]
paths = 256
ratios = ["PAR:NIR"]
[site]
latitude_deg = 50
longitude_deg = 8
"""
SUN = """
[[source]]
type = "directional"
direction = [0.1, 0, -1]
irradiance_facing = 100
"""
TIME = """
[time]
from = "2024-06-21"
to = "2024-06-22"
utc_offset_hours = 2
"""
SCENE = """
[[material]]
name = "leaf"
reflectance = 0.1
transmittance = 0.1
[[organ]]
id = 17
name = "upper"
labels = {{ plant = 1, "my kind" = "leaf" }}
material = "leaf"
shape = "disk"
center = [0, 0, 30]
normal = [0, 0, 1]
radius = 5
[[organ]]
id = 3
name = "lower, \\"left\\""
material = "leaf"
shape = "disk"
center = [2, 0, 10]
normal = [0.2, 0, 1]
radius = 5
"""
DETECTORS = """
[[detector]]
type = "escaped_by_zenith"
name = "up"
rings = 3
"""
SENSORS = """
[[sensors]]
name = "bench"
at = { start = [0, 0, 1], along = [12, 0, 0], across = [0, 4, 0], counts = [3, 2] }
[[sensors]]
name = "two balls"
receiver = "sphere"
at = [[0, 0, 20], [1, 2, 3]]
[[sensors]]
name = "mean"
average = true
at = [[0, 0, 2], [20, 4, 2]]
"""
GROUND = '[ground]\nmaterial = "leaf"\n'
ONE_UNIT = 'bands = ["PAR", "NIR"]'
TWO_UNITS = """
[[band]]
name = "PAR"
unit = "umol m-2 s-1"
[[band]]
name = "NIR"
"""
PARTS = {
    "": "mean",
    "_standard_error": "standard_error",
    "_ci95_low": "ci95_low",
    "_ci95_high": "ci95_high",
}


def number(value):
    return np.nan if value is None else value


def estimate(value):
    """The four numbers of an estimate in the JSON."""
    return {part: number(value.get(part)) for part in PARTS.values()}


def compare(variables, where, organs, bands, suffixed, extra=""):
    """Compares the variables with the organs of the JSON, quantity by quantity."""
    compared = 0
    for i, organ in enumerate(organs):
        for quantity, by_band in organ.items():
            if quantity in ("id", "name", "labels", "area", "sunlit_fraction", "ratios"):
                continue
            for b, band in enumerate(bands):
                for suffix, part in PARTS.items():
                    name = quantity + (f"_{band}" if suffixed else "") + extra + suffix
                    index = where + ((i,) if suffixed else (b, i))
                    ours = variables[name].values[index]
                    theirs = estimate(by_band[band])[part]
                    assert np.array_equal(ours, theirs, equal_nan=True), (name, index, ours, theirs)
                    compared += 1
    return compared


class Case:
    def __init__(self, program, folder, text):
        (folder / "run.toml").write_text(text)
        run_in(folder, program, "run", "run.toml", "--quiet", "--netcdf", "out.nc", "--json", "out.json")
        self.json = json.loads((folder / "out.json").read_text())
        self.data = xarray.load_dataset(folder / "out.nc")
        self.dump = run_in(folder, "ncdump", "-h", "out.nc")
        # convert makes the same file from the JSON: every variable, bit for bit, and every attribute.
        run_in(folder, program, "convert", "out.json", "back.nc")
        back = xarray.load_dataset(folder / "back.nc")
        assert back.identical(self.data), xarray.testing.assert_identical(back, self.data)


def check_organs(case):
    data = case.data
    assert list(data.organ.values) == [17, 3]
    assert list(data.organ_name.values) == ["upper", 'lower, "left"']
    assert list(data.label_my_kind.values) == ["leaf", ""]
    assert data.area.attrs["units"] == "cm2"
    assert data.attrs["Conventions"] == "CF-1.8" and data.attrs["title"] == "Two leaves"
    assert "run.toml (sha256 " in data.attrs["inputs"] and "paths = 256" in data.attrs["options"]


def check_single(program, folder):
    case = Case(program, folder, HEAD.format(bands=ONE_UNIT) + SUN + SCENE.format())
    check_organs(case)
    data = case.data
    assert data.absorbed_flux.dims == ("band", "organ")
    assert list(data.band.values) == ["PAR", "NIR"]
    assert data.absorbed_flux.attrs["units"] == "1e-4 W", data.absorbed_flux.attrs
    assert data.absorbed_flux.attrs["ancillary_variables"].split()[0] == "absorbed_flux_standard_error"
    assert compare(data, (), case.json["organs"], ["PAR", "NIR"], False) == 2 * 6 * 2 * 4
    assert data.light_ratio.dims == ("ratio", "organ") and list(data.ratio.values) == ["PAR:NIR"]
    assert data.sunlit_fraction.values[0] == case.json["organs"][0]["sunlit_fraction"]["mean"]
    assert "double absorbed_flux(band, organ)" in case.dump


def check_series(program, folder):
    case = Case(program, folder, HEAD.format(bands=TWO_UNITS) + TIME + SCENE.format())
    check_organs(case)
    data = case.data
    assert data.absorbed_flux_PAR.dims == ("time", "organ")
    assert data.absorbed_flux_density_PAR.attrs["units"] == "umol m-2 s-1"
    assert data.absorbed_flux_density_PAR_day_sum.attrs["units"] == "mol m-2"
    assert data.absorbed_flux_density_NIR_day_sum.attrs["units"] == "J m-2"
    time_steps = case.json["time_steps"]
    assert len(time_steps) == data.sizes["time"] > 10
    for row, time_step in enumerate(time_steps):
        assert str(data.time_text.values[row]) == time_step["time"]
        clock = np.datetime64(time_step["time"][:16])
        assert data.time.values[row] + np.timedelta64(2, "h") == clock
        begin, end = data.time_bounds.values[row]
        assert end - begin == np.timedelta64(int(time_step["seconds"]), "s")
        assert compare(data, (row,), time_step["organs"], ["PAR", "NIR"], True) == 2 * 6 * 2 * 4
    assert list(data.day.values) == ["2024-06-21", "2024-06-22"]
    for row, day in enumerate(case.json["days"]):
        assert compare(data, (row,), day["organs"], ["PAR", "NIR"], True, "_day_sum") > 0
    # Selection by labels with xarray.
    at_noon = data.absorbed_flux_PAR.sel(time="2024-06-21T10:00", organ=17)
    assert float(at_noon) > 0


def check_parts_and_origins(program, folder):
    options = '[run]\nsun_shade = "apart"\norigins = ["sun", "sky"]\n'
    text = HEAD.format(bands=TWO_UNITS).replace("[run]\n", options) + TIME + SCENE.format() + SENSORS
    case = Case(program, folder, text)
    data = case.data
    assert data.incident_upper_sunlit_PAR.dims == ("time", "organ")
    assert data.sunlit_fraction_upper.attrs["units"] == "1"
    assert data.incident_upper_direct_PAR_day_sum.attrs["units"] == "mol m-2"
    assert data.incident_upper_sunlit_PAR_day_mean.attrs["units"] == "umol m-2 s-1"
    assert data.sunlit_hours.dims == ("day", "organ") and data.sunlit_hours.attrs["units"] == "h"
    for row, time_step in enumerate(case.json["time_steps"]):
        for i, organ in enumerate(time_step["organs"]):
            fraction = organ["sunlit_fraction_upper"]["mean"]
            assert data.sunlit_fraction_upper.values[row, i] == fraction
            shaded = organ["absorbed_flux_density_shaded"]["PAR"]["standard_error"]
            ours = data.absorbed_flux_density_shaded_PAR_standard_error.values[row, i]
            assert np.array_equal(ours, number(shaded), equal_nan=True)
            for o, origin in enumerate(["sun", "sky"]):
                flux = organ["origins"][origin]["absorbed_flux"]["NIR"]["mean"]
                assert data.absorbed_flux_NIR_by_origin.values[row, o, i] == flux
    for row, day in enumerate(case.json["days"]):
        hours = [organ["sunlit_hours"]["mean"] for organ in day["organs"]]
        assert list(data.sunlit_hours.values[row]) == hours and 10 < hours[0] < 17
        upper = [organ["sunlit_hours_upper"]["mean"] for organ in day["organs"]]
        assert list(data.sunlit_hours_upper.values[row]) == upper
        hours = [sensor["sunlit_hours"]["mean"] for sensor in day["sensors"]]
        assert list(data.two_balls_sunlit_hours.values[row]) == hours[6:8] and 10 < min(hours) < 17


def check_detector(data, where, detector, suffixed):
    """Compares the variables with a detector of the JSON."""
    for b, band in enumerate(["PAR", "NIR"]):
        for i, seen in enumerate(detector["bins"]):
            for suffix, part in PARTS.items():
                name = detector["name"] + (f"_{band}" if suffixed else "") + suffix
                index = where + ((i,) if suffixed else (b, i))
                theirs = estimate(seen["flux"][band])[part]
                assert np.array_equal(data[name].values[index], theirs, equal_nan=True), (name, index)


SENSOR_AXES = {"bench": ("bench_j", "bench_i"), "two_balls": ("two_balls_point",), "mean": ()}


def compare_sensors(data, where, rows, bands, suffixed, extra="", origin=None):
    """Compares the variables of sensors with those of the JSON. Returns the number of numbers."""
    shapes = {"bench": [(j, i) for j in range(2) for i in range(3)], "two_balls": [(0,), (1,)], "mean": [()]}
    positions = [(name, index) for name, indices in shapes.items() for index in indices]
    assert len(positions) == len(rows)
    compared = 0
    for (name, index), row in zip(positions, rows):
        light = row["origins"][origin[1]] if origin else row
        for quantity in (key for key in light if key.startswith(("incident", "fluence", "transmittance"))):
            of_quantity = "_day_mean" if extra == "_day_sum" and quantity == "transmittance" else extra
            for b, band in enumerate(bands):
                for suffix, part in PARTS.items():
                    variable = f"{name}_{quantity}" + (f"_{band}" if suffixed else "") + of_quantity + suffix
                    at = where + ((origin[0],) if origin else ()) + (() if suffixed else (b,)) + index
                    theirs = estimate(light[quantity][band])[part]
                    ours = data[variable].values[at]
                    assert np.array_equal(ours, theirs, equal_nan=True), (variable, at, ours, theirs)
                    compared += np.isfinite(theirs)
    return compared


def check_sensor_coordinates(data, rows):
    assert list(data.bench_name.values.ravel()) == [row["name"] for row in rows[:6]]
    assert data.bench_name.values[1, 2] == "bench 6"
    assert list(data.two_balls_name.values) == ["two balls 1", "two balls 2"]
    assert data.mean_name.values == "mean" and data.mean_x.values == 10 and data.mean_y.values == 2
    for axis, name in enumerate("xyz"):
        positions = data[f"bench_{name}"]
        assert list(positions.values.ravel()) == [row["position"][axis] for row in rows[:6]]
        assert positions.attrs["units"] == "cm" and positions.dims == ("bench_j", "bench_i")


def check_sensors(program, folder):
    """All kinds of sensors, with origins, in a sweep."""
    options = '[run]\norigins = ["sun", "sky"]\n'
    sky = '[[source]]\ntype = "uniform_sky"\nname = "sky"\nirradiance_horizontal = 30\n'
    sweep = '[sweep]\n"material.leaf.reflectance" = [0.1, 0.4]\n'
    head = HEAD.format(bands=ONE_UNIT).replace("[run]\n", options)
    sun = SUN.replace("type", 'name = "sun"\ntype', 1)
    case = Case(program, folder, head + sweep + sun + sky + SCENE.format() + GROUND + SENSORS)
    data = case.data
    check_sensor_coordinates(data, case.json["points"][0]["sensors"])
    for name, axes in SENSOR_AXES.items():
        light = data[f"{name}_incident_direct"]
        assert light.dims == ("material_leaf_reflectance", "band") + axes
        assert f"{name}_name" in light.coords and light.attrs["units"] == "W m-2"
        by_origin = data[f"{name}_incident_direct_by_origin"]
        assert by_origin.dims == ("material_leaf_reflectance", "origin", "band") + axes
    assert "two_balls_incident_upper" not in data and "bench_absorbed_flux" not in data
    fraction = data.bench_transmittance
    assert fraction.attrs["units"] == "1" and fraction.dims == data.bench_incident_upper.dims
    assert np.all(fraction > 0) and "two_balls_transmittance" not in data
    for row, point in enumerate(case.json["points"]):
        sensors = point["sensors"]
        assert compare_sensors(data, (row,), sensors, ["PAR", "NIR"], False) > 200
        for origin in enumerate(["sun", "sky"]):
            extra = "_by_origin"
            assert compare_sensors(data, (row,), sensors, ["PAR", "NIR"], False, extra, origin) > 50
        sunlit = [sensor["sunlit_fraction"]["mean"] for sensor in sensors]
        assert list(data.bench_sunlit_fraction.values[row].ravel()) == sunlit[:6] and max(sunlit) > 0
        ratio = [number(sensor["ratios"]["PAR:NIR"]["mean"]) for sensor in sensors]
        assert np.array_equal(data.two_balls_light_ratio.values[row, 0], ratio[6:8])


def check_sensors_in_time(program, folder):
    text = HEAD.format(bands=TWO_UNITS) + TIME + SCENE.format() + GROUND + SENSORS
    case = Case(program, folder, text)
    data = case.data
    assert data.bench_incident_upper_PAR.dims == ("time", "bench_j", "bench_i")
    assert data.mean_incident_upper_NIR_day_sum.dims == ("day",)
    assert data.bench_incident_upper_PAR_day_sum.attrs["units"] == "mol m-2"
    assert data.mean_transmittance_NIR_day_mean.dims == ("day",)
    assert np.all(data.bench_transmittance_PAR_day_mean > 0)
    for row, step in enumerate(case.json["time_steps"]):
        assert compare_sensors(data, (row,), step["sensors"], ["PAR", "NIR"], True) > 50
    for row, day in enumerate(case.json["days"]):
        assert compare_sensors(data, (row,), day["sensors"], ["PAR", "NIR"], True, "_day_sum") > 200


def check_one_sensor(program, folder):
    """A mean in bands with units of their own has variables without axes."""
    one = SENSORS[SENSORS.index('[[sensors]]\nname = "mean"') :]
    case = Case(program, folder, HEAD.format(bands=TWO_UNITS) + SUN + SCENE.format() + one)
    light = case.json["sensors"][0]["incident_upper"]["NIR"]
    assert case.data.mean_incident_upper_NIR.values == light["mean"]
    error = case.data.mean_incident_upper_NIR_standard_error.values
    assert error == light["standard_error"] and 0 < error < light["mean"]
    assert case.data.mean_incident_upper_NIR_ci95_low.dims == ()


GAPS = """
[[gap_fraction]]
name = "below"
at = [[0, 0, 1], [4, 2, 1]]
rays = 1024
[[gap_fraction]]
name = "two rings"
at = [[8, 0, 1]]
rings_deg = [0, 30, 60]
azimuths = 4
"""
#: Names in the table of gaps of indices of rings, and of the whole view.
OF_RINGS = {"gap_fraction": "of_ring", "clumping_index": "clumping_of_ring"}
OF_VIEWS = {
    "sky_transmittance", "effective_plant_area_index", "plant_area_index", "clumping_index", "lai_2000_index"
}


def bin_of(data, axis, row, begin, end):
    """The index of the bin with the bounds of a row."""
    bounds = data[f"{axis}_bounds"].values.tolist()
    return bounds.index([float(row[begin]), float(row[end])])


def gap_variable(data, row):
    """The variable, and the index in it, of a row of the table of gaps."""
    name = row["name"].replace(" ", "_")
    is_all = row["position"] == "all"
    index = () if is_all else (int(row["position"]) - 1,)
    end = "_all" if is_all else ""
    if not row["zenith_from_deg"]:
        assert row["quantity"] in OF_VIEWS
        return f"{name}_{row['quantity']}{end}", index
    index += (bin_of(data, f"{name}_ring", row, "zenith_from_deg", "zenith_to_deg"),)
    if (row["azimuth_from_deg"], row["azimuth_to_deg"]) == ("0", "360"):
        return f"{name}_{OF_RINGS[row['quantity']]}{end}", index
    return name, (*index, bin_of(data, f"{name}_sector", row, "azimuth_from_deg", "azimuth_to_deg"))


def compare_gaps(data, rows, where=()):
    """Compares the variables of gaps with the table. Returns the number of numbers that are known."""
    compared = 0
    for row in rows:
        variable, index = gap_variable(data, row)
        for suffix, part in PARTS.items():
            theirs = float(row[part]) if row[part] else np.nan
            ours = data[variable + suffix].values[where + index]
            assert np.isclose(ours, theirs, rtol=1e-12, equal_nan=True), (variable, index, ours, theirs)
            compared += np.isfinite(theirs)
    return compared


def table_rows(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def check_gaps(program, folder):
    """Gaps in a sweep of geometry, and in one of materials, whose points have the same gaps."""
    text = HEAD.format(bands=ONE_UNIT) + SUN + SCENE.format() + GAPS
    case = Case(program, folder, text + '[sweep]\n"organ.upper.radius" = [2, 25]\n')
    data, axis = case.data, "organ_upper_radius"
    assert data.below.dims == (axis, "below_position", "below_ring", "below_sector")
    assert data.below.shape == (2, 2, 5, 8) and data.two_rings.shape == (2, 1, 2, 4)
    assert list(data.two_rings_ring.values) == [15, 45] and data.below_ring.attrs["units"] == "degree"
    assert list(data.below_x.values) == [0, 4] and data.below_x.attrs["units"] == "cm"
    assert data.below_lai_2000_index_all.dims == (axis,)
    run_in(folder, program, "run", "run.toml", "--quiet", "--gaps-csv", "gaps.csv")
    rows = table_rows(folder / "gaps.csv")
    for i, radius in enumerate(["2", "25"]):
        of_point = [row for row in rows if row["organ.upper.radius"] == radius]
        assert len(of_point) == len(rows) // 2 > 100
        assert compare_gaps(data, of_point, (i,)) > 400
    small, large = data.below_sky_transmittance_all.values
    assert small > large > 0
    assert np.all(np.isnan(data.two_rings_lai_2000_index.values))
    case = Case(program, folder, text + '[sweep]\n"material.leaf.reflectance" = [0.1, 0.4]\n')
    assert np.array_equal(case.data.below.values[0], case.data.below.values[1])


CONTROL = """
[[source]]
type = "point"
name = "{name}"
position = [0, 0, 60]
power = 1500
[[control]]
sources = "{name}"
sensors = "mean"
band = "{band}"
set_point = 150
electrical_power_w = 400
"""


def compare_controls(data, where, control, suffixes):
    """Compares the variables of controls with those of the JSON, in the times of the file."""
    times = list(data.time_text.values)
    compared = 0
    for k, own in enumerate(control):
        numbers = {"factor": "factor", "on": "on", "kwh": "kwh", "is_near_threshold": "is_near_threshold"}
        for step in (step for step in own["time_steps"] if step["time"] in times):
            index = where + (times.index(step["time"]), k)
            for name, key in numbers.items():
                assert data[f"control_{name}"].values[index] == float(step[key])
            for key in ("daylight", "lamps", "light"):
                for suffix, part in PARTS.items():
                    ours = data[f"control_{key}{suffixes[k]}{suffix}"].values[index]
                    assert np.array_equal(ours, estimate(step[key])[part], equal_nan=True), (key, index)
                    compared += 1
        numbers = {"hours_on": "hours_on", "kwh_day_sum": "kwh", "hours_near_threshold": "hours_near_threshold"}
        for row, day in enumerate(own["days"]):
            assert data.day.values[row] == day["date"]
            for name, key in numbers.items():
                assert data[f"control_{name}"].values[where + (row, k)] == day[key]
            for key in ("lamps", "light"):
                for suffix, part in PARTS.items():
                    ours = data[f"control_{key}{suffixes[k]}_day_sum{suffix}"].values[where + (row, k)]
                    assert np.array_equal(ours, estimate(day[key])[part], equal_nan=True), (key, row)
    return compared


def check_controls(program, folder):
    """A sweep over a rule, of two controls in bands of one unit."""
    sweep = '[sweep]\n"control.1.set_point" = [50, 100]\n'
    lamps = CONTROL.format(name="hps 1", band="PAR") + CONTROL.format(name="far", band="NIR")
    text = HEAD.format(bands=ONE_UNIT) + sweep + TIME + SCENE.format() + SENSORS + lamps
    case = Case(program, folder, text)
    data = case.data
    axis = "control_1_set_point"
    assert list(data.control.values) == ["hps 1", "far"] and list(data.control_band.values) == ["PAR", "NIR"]
    assert data.control_light.dims == (axis, "time", "control")
    assert data.control_light_day_sum.dims == (axis, "day", "control")
    assert data.control_kwh.attrs["units"] == "kW h" and data.control_light.attrs["units"] == "W m-2"
    assert data.control_lamps_day_sum.attrs["units"] == "J m-2"
    for row, point in enumerate(case.json["points"]):
        assert compare_controls(data, (row,), point["control"], ["", ""]) == 2 * 48 * 12
    factors = data.control_factor.values
    assert 0 < factors[0, :, 0].max() < factors[1, :, 0].max() <= 1
    bands = text.replace('"control.1.set_point" = [50, 100]', '"control.1.band" = ["PAR", "NIR"]')
    (folder / "run.toml").write_text(bands)
    output = run_in(folder, program, "run", "run.toml", "--quiet", "--netcdf", "no.nc", status=1)
    assert "NetCDF: the points of the sweep have different controls" in output, output
    assert not (folder / "no.nc").exists()


def check_controls_by_unit(program, folder):
    """Controls in bands of different units."""
    photons = CONTROL.format(name="hps 1", band="PAR").replace("power = 1500", "photon_flux = [1500, 0]", 1)
    watts = CONTROL.format(name="far", band="NIR").replace("power = 1500", "power = [0, 1500]", 1)
    text = HEAD.format(bands=TWO_UNITS) + TIME + SCENE.format() + SENSORS + photons + watts
    case = Case(program, folder, text)
    data = case.data
    assert compare_controls(data, (), case.json["control"], ["_PAR", "_NIR"]) == 2 * 48 * 12
    assert data.control_light_PAR.attrs["units"] == "umol m-2 s-1"
    assert data.control_light_PAR_day_sum.attrs["units"] == "mol m-2"
    assert np.all(np.isnan(data.control_light_PAR.values[:, 1]))


def check_detectors(program, folder):
    sweep = '[sweep]\n"material.leaf.reflectance" = [0.1, 0.4]\n'
    text = HEAD.format(bands=ONE_UNIT) + sweep + SUN + SCENE.format() + DETECTORS
    case = Case(program, folder, text)
    assert case.data.up.dims == ("material_leaf_reflectance", "band", "up_bin")
    assert list(case.data.up_bin.values) == ["0 to 60", "60 to 120", "120 to 180"]
    assert case.data.up_bin.attrs["long_name"] == "zenith angle (deg)"
    assert case.data.up.attrs["units"] == "1e-4 W"
    for row, point in enumerate(case.json["points"]):
        check_detector(case.data, (row,), point["detectors"][0], False)
    case = Case(program, folder, HEAD.format(bands=TWO_UNITS) + TIME + SCENE.format() + DETECTORS)
    assert case.data.up_PAR.dims == ("time", "up_bin")
    assert case.data.up_PAR.attrs["units"] == "1e-4 umol s-1"
    for row, time_step in enumerate(case.json["time_steps"]):
        check_detector(case.data, (row,), time_step["detectors"][0], True)


def check_sweep(program, folder):
    sweep = '[sweep]\n"material.leaf.reflectance" = [0.1, 0.4]\n'
    case = Case(program, folder, HEAD.format(bands=ONE_UNIT) + sweep + SUN + SCENE.format())
    data = case.data
    assert data.absorbed_flux.dims == ("material_leaf_reflectance", "band", "organ")
    assert list(data.material_leaf_reflectance.values) == [0.1, 0.4]
    for row, point in enumerate(case.json["points"]):
        assert compare(data, (row,), point["organs"], ["PAR", "NIR"], False) == 2 * 6 * 2 * 4
    light = data.absorbed_flux.sel(material_leaf_reflectance=0.4, organ=17, band="PAR")
    assert float(light) == case.json["points"][1]["organs"][0]["absorbed_flux"]["PAR"]["mean"]


def check_product(program, folder):
    """Two keys over the times of two days: the second varies fastest."""
    sweep = """
[sweep]
"material.leaf.reflectance" = [0.4, 0.1]
"site.latitude_deg" = [10, 50, 80]
"""
    case = Case(program, folder, HEAD.format(bands=ONE_UNIT) + sweep + TIME + SCENE.format())
    data = case.data
    axes = ("material_leaf_reflectance", "site_latitude_deg")
    assert data.absorbed_flux.dims == axes + ("time", "band", "organ")
    assert data.absorbed_flux_day_sum.dims == axes + ("day", "band", "organ")
    assert list(data.site_latitude_deg.values) == [10, 50, 80]
    assert data.sizes["time"] == 48, "near the pole there is light at all times"
    times = [str(text) for text in data.time_text.values]
    for number, point in enumerate(case.json["points"]):
        index = (number // 3, number % 3)
        assert point["point"]["site.latitude_deg"] == data.site_latitude_deg.values[index[1]]
        lit = set()
        for time_step in point["time_steps"]:
            row = times.index(time_step["time"])
            lit.add(row)
            assert compare(data, index + (row,), time_step["organs"], ["PAR", "NIR"], False) == 96
        dark = [row for row in range(48) if row not in lit]
        assert np.all(np.isnan(data.absorbed_flux.values[index][dark]))
        assert (len(dark) == 0) == (index[1] == 2)
        for row, day in enumerate(point["days"]):
            assert compare(data, index + (row,), day["organs"], ["PAR", "NIR"], False, "_day_sum")


def check_together(program, folder):
    sweep = """
[sweep]
combine = "zip"
"run.seed" = [3, 4]
"run.method" = ["light_tracing", "from_organs"]
"""
    case = Case(program, folder, HEAD.format(bands=ONE_UNIT) + sweep + SUN + SCENE.format())
    data = case.data
    assert data.absorbed_flux.dims == ("point", "band", "organ")
    assert data.run_method.dims == ("point",) and "run_method" in data.absorbed_flux.coords
    assert list(data.run_method.values) == ["light_tracing", "from_organs"]
    for row, point in enumerate(case.json["points"]):
        assert compare(data, (row,), point["organs"], ["PAR", "NIR"], False) == 2 * 6 * 2 * 4


def check_swept_geometry(program, folder):
    """Organs whose size is swept have an area for each point."""
    sweep = '[sweep]\n"organ.upper.radius" = [1, 3]\n'
    case = Case(program, folder, HEAD.format(bands=ONE_UNIT) + sweep + SUN + SCENE.format())
    data = case.data
    assert data.area.dims == ("organ_upper_radius", "organ")
    for row, point in enumerate(case.json["points"]):
        assert list(data.area.values[row]) == [organ["area"] for organ in point["organs"]]
        assert compare(data, (row,), point["organs"], ["PAR", "NIR"], False) == 2 * 6 * 2 * 4


def check_refused(program, folder):
    """An output that NetCDF can't hold does not affect the others."""
    sweep = '[sweep]\n"time.from" = ["2024-06-21", "2024-06-22"]\n'
    text = HEAD.format(bands=ONE_UNIT) + sweep + TIME + SCENE.format()
    (folder / "run.toml").write_text(text)
    output = run_in(
        folder, program, "run", "run.toml", "--quiet", "--netcdf", "no.nc", "--json", "out.json", status=1
    )
    assert "NetCDF: the points of the sweep have different time steps" in output, output
    assert not (folder / "no.nc").exists()
    assert len(json.loads((folder / "out.json").read_text())["points"]) == 2
    output = run_in(folder, program, "convert", "out.json", "no.nc", status=1)
    assert "NetCDF: the points of the sweep have different time steps" in output, output
    assert not (folder / "no.nc").exists()
    output = run_in(
        folder, program, "convert", "out.json", "no.nc", "--sweep-point", "2", "--time", "x", status=2
    )
    assert "--sweep-point: a NetCDF file has all points of a sweep" in output and "--time: " in output, output


def main():
    with tempfile.TemporaryDirectory() as name:
        for check in (
            check_single,
            check_series,
            check_parts_and_origins,
            check_sweep,
            check_detectors,
            check_sensors,
            check_sensors_in_time,
            check_one_sensor,
            check_gaps,
            check_controls,
            check_controls_by_unit,
            check_product,
            check_together,
            check_swept_geometry,
            check_refused,
        ):
            check(sys.argv[1], Path(name))


main()
