"""Tables of results that are held in Python are those that the program writes."""

import csv
import os
import subprocess

import pytest

import quasimc

PROGRAM = os.environ.get("QUASIMC_PROGRAM", "")
RUN = """
title = "tables"
bands = ["PAR", "NIR"]
length_unit = "m"
[run]
paths = 256
replicates = 4
groups = ["kind"]
origins = ["sky"]
[site]
latitude_deg = 50
longitude_deg = 8
[[material]]
name = "leaf"
reflectance = 0.1
[[organ]]
material = "leaf"
shape = "disk"
center = [0, 0, 1]
normal = [0, 0, 1]
radius = 0.2
labels = { kind = "upper" }
at = [[0, 0, 0], [0.1, 0, 0.3]]
[[sensors]]
name = "floor"
at = [[0, 0, 0.1], [1, 0, 0.1]]
"""
DAY = """
[time]
day = "2024-06-21"
utc_offset_hours = 2
hours = [9, 12]
"""
SKY = '[[source]]\ntype = "uniform_sky"\nname = "sky"\nirradiance_horizontal = 100\n'
SWEEP = "[sweep]\n\"material.leaf.reflectance\" = [0.1, 0.4]\n"
TABLES = [
    {"rows": "groups"},
    {"rows": "groups", "form": "long", "statistics": ["mean", "se"], "quantities": ["absorbed_flux"]},
    {"rows": "sensors", "bands": ["NIR"]},
    {"where": "height > 1.1", "digits": 5, "origins": []},
]
DAYS = [{**table, "per": per} for per in ("day", "period") for table in TABLES]


def rows_of(path):
    """The rows without comments, which name the file and its time."""
    with open(path, newline="") as file:
        return [row for row in csv.reader(file) if not row[0].startswith("#")]


def by_the_program(folder, text, table):
    values = {k: str(v).replace("'", '"') if isinstance(v, (list, int)) else f'"{v}"' for k, v in table.items()}
    keys = "\n".join(f"{key} = {value}" for key, value in values.items())
    run = folder / "run.toml"
    run.write_text(f'{text}[[table]]\nfile = "table.csv"\n{keys}\n')
    said = subprocess.run([PROGRAM, "run", run, "--quiet", "--json", folder / "run.json"], capture_output=True)
    assert said.returncode == 0, said.stderr
    return rows_of(folder / "table.csv")


@pytest.mark.skipif(not PROGRAM, reason="the program was not built")
@pytest.mark.parametrize(
    "light, tables", [(DAY, DAYS + TABLES[:2]), (SKY, TABLES), (SKY + SWEEP, TABLES)], ids=["day", "sky", "sweep"]
)
def test_a_table_is_that_of_the_program(light, tables, tmp_path):
    for table in tables:
        expected = by_the_program(tmp_path, RUN + light, table)
        held = quasimc.open(tmp_path / "run.json")
        held.save(tmp_path / "again.csv", **table)
        assert rows_of(tmp_path / "again.csv") == expected and len(expected) > 1, table


def test_a_table_of_a_scene_of_python(tmp_path):
    scene = quasimc.Scene("PAR", length_unit="m")
    scene.add_material("leaf", reflectance=0.1)
    scene.add_mesh([[[0, 0, 1], [1, 0, 1], [0, 1, 1]]], material="leaf", labels={"kind": "leaf"})
    result = scene.run(quasimc.sky(irradiance_horizontal=100), paths=256, groups=["kind"])
    rows = rows_of(result.save(tmp_path / "groups.csv", rows="groups", quantities=["absorbed_flux"]))
    flux = rows[0].index("absorbed_flux_PAR")
    sums = result.groups["absorbed_flux"]["PAR"].values
    assert [float(row[flux]) for row in rows[1:]] == pytest.approx(list(sums), rel=1e-12)


def test_days_are_written_without_their_times(tmp_path):
    scene = quasimc.Scene("PAR", length_unit="m", site=quasimc.Site(50, 8))
    scene.add_material("leaf", reflectance=0.1)
    scene.add_mesh([[[0, 0, 1], [1, 0, 1], [0, 1, 1]]], material="leaf")
    days = quasimc.days("2024-06-21", "2024-06-22", utc_offset_hours=2, hours=[11, 13])
    series = scene.series(days, keep="sums", paths=64)
    rows = rows_of(series.save(tmp_path / "days.csv", per="day"))
    assert [row[0] for row in rows] == ["date", "2024-06-21", "2024-06-22"]
    total = sum(float(row[rows[0].index("absorbed_flux_PAR")]) for row in rows[1:])
    assert total == pytest.approx(series.total["absorbed_flux"]["PAR"].values[0])
    with pytest.raises(KeyError, match="not kept"):
        series.save(tmp_path / "times.csv", form="long")
    assert not (tmp_path / "times.csv").exists()


@pytest.mark.parametrize(
    "name, table, expected",
    [
        ("a.csv", {"row": "groups"}, "save.. has no keyword 'row'; did you mean 'rows'"),
        ("a.csv", {"rows": "group"}, "did you mean 'groups'"),
        ("a.csv", {"quantities": ["absorbed"]}, "there is no 'absorbed' in such a table"),
        ("a.csv", {"per": "day"}, "sums over time need"),
        ("a.csv", {"per": "sweep"}, "use sweep.sum"),
        ("a.csv", {"rows": "sensors"}, "sensors"),
        ("a.json", {"rows": "groups"}, "use the ending .csv"),
    ],
)
def test_a_table_that_cannot_be_written_is_refused(name, table, expected, tmp_path):
    scene = quasimc.Scene("PAR", length_unit="m")
    scene.add_material("leaf", reflectance=0.1)
    scene.add_mesh([[[0, 0, 1], [1, 0, 1], [0, 1, 1]]], material="leaf")
    result = scene.run(quasimc.sky(irradiance_horizontal=100), paths=64)
    with pytest.raises(quasimc.InputError, match=expected):
        result.save(tmp_path / name, **table)
    assert not list(tmp_path.iterdir())
