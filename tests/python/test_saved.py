"""Days and sweeps as files, and back."""

import csv
import json
import os
import pickle
import subprocess

import numpy as np
import pytest

import quasimc
from canopies import DAY, FEW, canopy, stand

PROGRAM = os.environ.get("QUASIMC_PROGRAM", "")
needs_program = pytest.mark.skipif(not PROGRAM, reason="the program was not built")


def save_netcdf(light, path):
    """Writes light as NetCDF, and returns the path; skips the test if the program was built without it."""
    try:
        return light.save(path)
    except quasimc.Error as error:
        if "built without" not in str(error):
            raise
        pytest.skip("the program was built without NetCDF")


def same_light(a, b):
    assert list(a) == list(b)
    for quantity in a:
        np.testing.assert_array_equal(a[quantity]._values, b[quantity]._values)
        for name in a[quantity].origins:
            ours, theirs = (light[quantity].origin(name) for light in (a, b))
            np.testing.assert_array_equal(ours._values, theirs._values)


def same_parts(a, b):
    """Emitted light is written without its interval."""
    assert list(a) == list(b)
    for part in a:
        np.testing.assert_array_equal(a[part].values, b[part].values)
        np.testing.assert_array_equal(a[part].standard_error, b[part].standard_error)


def same_result(a, b):
    assert a == b
    for light in (lambda r: r, lambda r: r.groups, lambda r: r.ground):
        same_light(light(a), light(b))
    same_light(a.sensors["bench"], b.sensors["bench"])
    for parts in ("budget", "canopy", "ratios"):
        same_parts(getattr(a, parts), getattr(b, parts))
    light = [r.detectors["up"]._values for r in (a, b)]
    np.testing.assert_array_equal(*light)
    for fact in ("method", "reason", "paths", "replicates", "rays", "stop", "rounds", "audit"):
        assert getattr(a.run, fact) == getattr(b.run, fact), fact


def same_sums(a, b):
    assert a.seconds == b.seconds
    same_light(a, b)
    same_light(a.groups, b.groups)
    same_light(a.sensors["bench"], b.sensors["bench"])
    assert a.to_pandas().equals(b.to_pandas())


def same_series(a, b):
    assert a.times == b.times and list(a.days) == list(b.days)
    assert (a.stop, a.completed, a.computed, a.methods, a.audit_p_value) == (
        b.stop, b.completed, b.computed, b.methods, b.audit_p_value
    )
    assert a.sources == b.sources and a.warnings == b.warnings
    for ours, theirs in zip(a, b):
        same_result(ours, theirs)
    for ours, theirs in zip([*a.days.values(), a.total], [*b.days.values(), b.total]):
        same_sums(ours, theirs)


@pytest.fixture(scope="module")
def series():
    options = {"groups": ["plant"], "layers": 2, "origins": ["sun", "sky"]}
    return stand().series(DAY, audit=0.5, **options, **FEW)


@pytest.fixture(scope="module")
def sweep():
    scene = canopy(6)
    return scene.sweep(
        {"materials.leaf.transmittance": [[0.05, 0.4], [0.1, 0.3]], "paths": [256, 512]},
        groups=["plant"],
        replicates=4,
    )


def test_a_day_is_read_back_whole(series, tmp_path):
    path = series.save(tmp_path / "day.json")
    back = quasimc.open(path)
    assert isinstance(back, quasimc.Series) and len(back) == len(series) == 5
    dark = [result.run.paths == 0 for result in back]
    assert any(dark) and not all(dark), "nights are not in the file"
    same_series(back, series)
    assert not back[-1].has_replicates
    assert back.save(tmp_path / "again.json").read_bytes() == path.read_bytes()
    for ending in ("csv", "json"):
        first = series.save(tmp_path / f"first.{ending}").read_bytes()
        assert back.save(tmp_path / f"second.{ending}").read_bytes() == first


def test_days_are_pickled(series):
    back = pickle.loads(pickle.dumps(series))
    same_series(back, series)
    same_series(pickle.loads(pickle.dumps(back)), series)


def table_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.reader(line for line in file if not line.startswith("#")))


@needs_program
def test_the_program_writes_the_same_day(series, tmp_path):
    path = series.save(tmp_path / "day.json")
    ours = series.save(tmp_path / "ours.csv")
    theirs = tmp_path / "theirs.csv"
    program = tmp_path / "program.json"
    run = [PROGRAM, "run", "--repeat", path, "--json", program, "--csv", theirs]
    subprocess.run(run, check=True, capture_output=True)
    same_series(quasimc.open(program), series)
    assert table_of(ours) == table_of(theirs) and len(table_of(ours)) > 40
    mine, its = (json.loads(file.read_text()) for file in (path, program))
    assert list(mine) == list(its)
    for key in ("time_steps", "days", "total", "organs_sha256", "quantities", "sum_units"):
        assert without_seconds(mine[key]) == without_seconds(its[key]), key


def without_seconds(value):
    """Rounds have the times of the clock."""
    if isinstance(value, dict):
        return {key: without_seconds(item) for key, item in value.items() if key != "rounds"}
    return [without_seconds(item) for item in value] if isinstance(value, list) else value


@needs_program
def test_days_are_converted_by_the_program(series, tmp_path):
    assert series.save(tmp_path / "day.vtp").read_bytes().startswith(b"<?xml")
    path = save_netcdf(series, tmp_path / "day.nc")
    assert path.read_bytes()[1:4] == b"HDF"
    with pytest.raises(quasimc.InputError, match="day.nc: is NetCDF .*; use xarray.open_dataset"):
        quasimc.open(path)


def test_sums_alone_are_saved(tmp_path):
    series = stand().series(DAY, keep="sums", **FEW)
    path = tmp_path / "sums.json"
    back = quasimc.open(series.save(path))
    assert (back.times, back.completed) == (series.times, 5) and len(back) == 5
    for ours, theirs in zip([*back.days.values(), back.total], [*series.days.values(), series.total]):
        same_sums(ours, theirs)
    for light in (back, series):
        with pytest.raises(KeyError, match="not kept"):
            light.save(tmp_path / "times.csv")
    assert not (tmp_path / "times.csv").exists()


def test_sunlit_parts_and_lamps_are_read_back(tmp_path):
    scene = stand("W m-2")
    scene.sources.append(
        quasimc.lamp("point", name="hps", position=[0.5, 0.5, 3], power=[300, 100])
    )
    scene.add_control("hps", "bench", on_below=800, electrical_power_w=400)
    series = scene.series(DAY, sun_shade="apart", ratios=["PAR:NIR"], **FEW)
    back = quasimc.open(series.save(tmp_path / "lamps.json"))
    assert back.control["hps"].to_pandas().equals(series.control["hps"].to_pandas())
    assert back.control["hps"].kwh.sum() > 0
    for date, day in series.control["hps"].days.items():
        same = back.control["hps"].days[date]
        assert (same.kwh, same.hours_on) == (day.kwh, day.hours_on)
        np.testing.assert_array_equal(same.light._values, day.light._values)
    for light in (lambda s: s[3], lambda s: s[3].groups, lambda s: s.total, lambda s: s.total.groups):
        ours, theirs = (light(each).sun_shade.to_pandas() for each in (back, series))
        assert ours.equals(theirs)
    same_parts(back[3].ratios, series[3].ratios)


def test_a_sweep_is_read_back_whole(sweep, tmp_path):
    path = sweep.save(tmp_path / "sweep.json")
    back = quasimc.open(path)
    assert isinstance(back, quasimc.Sweep) and len(back) == len(sweep) == 4
    assert [list(point.values()) for point in back.points] == [list(p.values()) for p in sweep.points]
    assert list(back.points[0]) == ["material.leaf.transmittance", "paths"]
    for ours, theirs in zip(back, sweep):
        assert ours == theirs
        same_light(ours.groups, theirs.groups)
        same_parts(ours.budget, theirs.budget)
    np.testing.assert_array_equal(
        back["absorbed_flux"].values, sweep["absorbed_flux"].values
    )
    assert back.save(tmp_path / "again.json").read_bytes() == path.read_bytes()
    table = sweep.save(tmp_path / "a.csv").read_bytes()
    assert back.save(tmp_path / "b.csv").read_bytes() == table
    assert len(table_of(tmp_path / "a.csv")) == 1 + 4 * 7


def test_a_point_of_a_sweep_is_saved_alone(sweep, tmp_path):
    back = quasimc.open(sweep.save(tmp_path / "sweep.json"))[2]
    alone = quasimc.open(back.save(tmp_path / "point.json"))
    assert isinstance(alone, quasimc.Result) and alone == sweep[2]
    assert pickle.loads(pickle.dumps(back)) == sweep[2]


def test_sweeps_are_pickled(sweep, tmp_path):
    back = pickle.loads(pickle.dumps(sweep))
    assert back.points == sweep.points and list(back) == list(sweep)
    opened = quasimc.open(back.save(tmp_path / "sweep.json"))
    assert list(opened) == list(pickle.loads(pickle.dumps(opened))) == list(sweep)


@needs_program
def test_the_program_writes_the_same_sweep(sweep, tmp_path):
    path = sweep.save(tmp_path / "sweep.json")
    program, theirs = tmp_path / "program.json", tmp_path / "theirs.csv"
    run = [PROGRAM, "run", "--repeat", path, "--json", program, "--csv", theirs]
    subprocess.run(run, check=True, capture_output=True)
    back = quasimc.open(program)
    assert list(back) == list(sweep)
    assert table_of(theirs) == table_of(sweep.save(tmp_path / "ours.csv"))
    assert save_netcdf(sweep, tmp_path / "sweep.nc").read_bytes()[1:4] == b"HDF"


#: A leaf on a day, to which tables are added.
RUN_FILE = """bands = ["PAR", "NIR"]
length_unit = "m"
[site]
latitude_deg = 52
longitude_deg = 5
[time]
day = "2024-06-21"
step_minutes = 360
utc_offset_hours = 1
[run]
paths = 256
[[material]]
name = "leaf"
reflectance = 0.1
[[organ]]
shape = "disk"
material = "leaf"
center = [0, 0, 1]
normal = [0, 0, 1]
radius = 0.1
"""


def run_program(folder, tables, *outputs):
    (folder / "run.toml").write_text(RUN_FILE + tables)
    run = [PROGRAM, "run", "run.toml", *outputs]
    subprocess.run(run, check=True, capture_output=True, cwd=folder)


@needs_program
def test_a_selection_of_output_is_opened_with_a_warning(tmp_path):
    output = '[output]\nquantities = ["absorbed_flux"]\nbands = ["NIR"]\ntime_of_day = [6, 14]\n'
    run_program(tmp_path, output, "--json", "out.json", "--csv", "out.csv")
    with pytest.warns(quasimc.QuasimcWarning, match="out.json: .*quantities absorbed_flux, bands NIR"):
        back = quasimc.open(tmp_path / "out.json")
    assert [step["time"][11:13] for step in back.times] == ["06", "12"] and back.completed == 4
    assert back[1]["absorbed_flux"]["NIR"].values[0] > 0
    assert np.isnan(back[1]["incident_upper"].values).all()
    again = back.save(tmp_path / "again.csv").read_text()
    assert again == (tmp_path / "out.csv").read_text()
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    files = [save_netcdf(back, tmp_path / "again.nc"), tmp_path / "out.nc"]
    run_program(tmp_path, output, "--netcdf", "out.nc")
    ours, theirs = (xarray.load_dataset(path) for path in files)
    assert ours.identical(theirs)


@needs_program
def test_a_sweep_of_days_is_opened(tmp_path):
    sweep = '[sweep]\n"material.leaf.reflectance" = [0.1, 0.5]\n'
    run_program(tmp_path, sweep, "--json", "out.json")
    back = quasimc.open(tmp_path / "out.json")
    assert [type(point) for point in back] == [quasimc.Series] * 2
    absorbed = [point.total["absorbed_flux"]["PAR"].values[0] for point in back]
    assert absorbed[1] == pytest.approx(absorbed[0] * 0.5 / 0.9, rel=1e-6)
    with pytest.raises(ValueError, match="are series"):
        back["absorbed_flux"]
    assert back.save(tmp_path / "again.json").read_bytes() == (tmp_path / "out.json").read_bytes()


def test_what_can_not_be_saved_says_why(series, tmp_path):
    sweep = canopy(3).sweep({"ground": [quasimc.Ground("soil", x=[-1, 2], y=[-1, 2])]}, **FEW)
    with pytest.raises(quasimc.InputError, match="Sweep.save: its point .*; save the result of each"):
        sweep.save(tmp_path / "sweep.json")
    with pytest.raises(quasimc.InputError, match="save: this Result has no run file"):
        series[3].save(tmp_path / "time.json")
    with pytest.raises(quasimc.InputError, match=r"sweep.glb: ends in '.glb' .*; use .json, .csv, .nc"):
        sweep.save(tmp_path / "sweep.glb")
    with pytest.raises(quasimc.InputError, match="day: has no ending"):
        series.save(tmp_path / "day")
    with pytest.raises(FileNotFoundError, match="the folder .*missing' does not exist; make it first"):
        series.save(tmp_path / "missing" / "day.json")
    assert not list(tmp_path.iterdir())
    (tmp_path / "a.json").write_bytes(b"\xff\xfe")
    with pytest.raises(quasimc.InputError, match="a.json: is not a result of QuasiMC"):
        quasimc.open(tmp_path / "a.json")


def test_nights_of_an_opened_series_have_the_origins_of_all_times(tmp_path):
    scene = canopy()
    scene.site = quasimc.Site(51, 10)
    lamp = quasimc.lamp("point", name="led", position=[0, 0, 3], power=10, on_hours=[11, 12])
    day = quasimc.day("2024-06-21", utc_offset_hours=1)
    series = scene.series(day, lamp, origins=["led"], paths=64)
    series.save(tmp_path / "day.json")
    opened = quasimc.open(tmp_path / "day.json")
    assert {result.origins for result in opened} == {("led", "other")}
    light = [each["incident_upper"].origin("other").values for each in (series, opened)]
    assert np.array_equal(*light)
