"""Messages about scenes speak of keywords, methods and classes, not of the tables of run files."""

import re
import warnings

import pytest

import quasimc
from canopies import FEW

LEAF = [[[0, 0, 1], [1, 0, 1], [0, 1, 1]]]
SITE = quasimc.Site(51, 10)
DAY = quasimc.day("2024-06-21", utc_offset_hours=1)
LAMP = quasimc.lamp("point", position=[0.2, 0.2, 3], power=10, name="led")
TABLE = re.compile(r"\[+[a-z_]+\]|run file")


def scene(**keys):
    made = quasimc.Scene("PAR", **keys)
    made.add_material("leaf", reflectance=0.1)
    made.add_mesh(LEAF, material="leaf")
    made.sources = [quasimc.sky("uniform", irradiance_horizontal=100)]
    return made


def run(*sources, **options):
    scene().run(list(sources) or None, **{**FEW, **options})


def controlled(time=DAY, sources=(LAMP,), sensors=True, **rule):
    made = scene(site=SITE)
    made.sources = list(sources)
    if sensors:
        made.add_sensors([[0.1, 0.1, 2]], name="top")
    made.add_control("led", sensors="top", **(rule or {"set_point": 10}))
    made.series(time, **FEW)


def weather(folder, text, **keys):
    path = folder / "weather.csv"
    path.write_text(text)
    scene(site=SITE).series(quasimc.weather(str(path), **keys))


def leaf_of_file(folder, *names, **keys):
    path = folder / "leaf.obj"
    path.write_text("mtllib leaf.mtl\nv 0 0 1\nv 1 0 1\nv 0 1 1\nusemtl green\nf 1 2 3\n")
    if names:
        (folder / "leaf.mtl").write_text("newmtl green\nKd 0.1 0.2 0.1\n")
    made = quasimc.Scene("PAR")
    for name in names or ("leaf",):
        made.add_material(name, reflectance=0.1)
    made.add_file(str(path), **keys)
    made.build()


def without_sources(_):
    made = scene()
    made.sources = []
    made.run(**FEW)


def sensors_below_a_repeated_lamp(_):
    made = scene()
    made.cell = quasimc.Cell(x=(0, 1), y=(0, 1))
    made.add_sensors([[0.1, 0.1, 2]], name="top")
    made.run([LAMP], **FEW)


def bands_without_wavelengths(_):
    made = quasimc.Scene({"own": "W m-2"}, site=SITE)
    made.add_material("leaf", reflectance=0.1)
    made.add_mesh(LEAF, material="leaf")
    made.series(DAY, **FEW)


HOURS = "day_of_year,hour,global\n"
CASES = {
    "no source": (without_sources, "add a source or Scene.time"),
    "no site": (lambda _: scene().series(DAY), "Scene.site is missing"),
    "value of a site": (lambda _: scene(site=quasimc.Site(99, 0)).run(**FEW), "Site: latitude_deg"),
    "value of a time": (
        lambda _: scene(site=SITE).series(quasimc.day("2024-06-21", utc_offset_hours=1, linke_turbidity=99)),
        "Scene.time: linke_turbidity",
    ),
    "measured at night": (
        lambda _: scene(site=SITE).series(
            quasimc.times(["2024-06-21T00:00:00"], utc_offset_hours=1, **{"global": [500]})
        ),
        "check utc_offset_hours, Scene.site",
    ),
    "time of a sun": (
        lambda _: run(quasimc.sun(time="2024-06-21T12:00:00+02:00", irradiance_horizontal=10)),
        "time without Scene.site",
    ),
    "no position of a sun": (
        lambda _: run({"type": "sun", "irradiance_horizontal": 10}),
        "give time (with Scene.site)",
    ),
    "no sun of a sky": (
        lambda _: run(quasimc.sky("preetham", turbidity=3, irradiance_horizontal=10)),
        "add a source of type \"sun\"",
    ),
    "hours of a lamp": (lambda _: run(LAMP.replace(on_hours=[6, 22])), "on_hours needs Scene.time"),
    "value of an option": (lambda _: run(paths=0), "run options: paths"),
    "value of groups": (lambda _: run(groups=[{"name": "a"}]), "run options: groups"),
    "target of sensors": (lambda _: run(target="sensors"), "add sensors"),
    "no sensors of a control": (lambda _: controlled(sensors=False), "there are no sensors"),
    "no lamp of a control": (
        lambda _: controlled(sources=[quasimc.sky("uniform", irradiance_horizontal=1)]),
        "add a source that is a lamp",
    ),
    "control of a cumulative sky": (
        lambda _: controlled(quasimc.day("2024-06-21", utc_offset_hours=1, cumulative_sky="day")),
        "Scene.time has cumulative_sky",
    ),
    "control of a part of a day": (
        lambda _: controlled(
            quasimc.day("2024-06-21", utc_offset_hours=1, hours=[10, 14]), daily_target=10
        ),
        "Scene.time has 4 h",
    ),
    "lamp that repeats": (sensors_below_a_repeated_lamp, "as organs of a material"),
    "no wavelengths": (bands_without_wavelengths, "give its from_nm and to_nm"),
    "material of a file": (leaf_of_file, "add a material of that name"),
    "material of no name": (
        lambda folder: leaf_of_file(folder, materials={"green": 3}),
        "the name of a material",
    ),
    "materials that are no dict": (
        lambda folder: leaf_of_file(folder, materials=3),
        "\"name of a material\"",
    ),
    "colour of a file": (lambda folder: leaf_of_file(folder, "leaf"), "its diffuse colour"),
    "material of another file": (
        lambda folder: leaf_of_file(folder, "other green"),
        "no file of geometry has the material",
    ),
    "year of weather": (
        lambda folder: weather(folder, HOURS + "1,12,300\n", utc_offset_hours=1),
        "give year",
    ),
    "clock of weather": (
        lambda folder: weather(folder, HOURS + "1,12,300\n", year=2021),
        "give utc_offset_hours",
    ),
    "leap day of weather": (
        lambda folder: weather(folder, HOURS + "366,12,300\n", year=2021, utc_offset_hours=1),
        "check year",
    ),
    "columns of weather": (
        lambda folder: weather(folder, HOURS, year=2021, utc_offset_hours=1, columns={"a": "b"}),
        "Scene.time: columns: unknown key",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_a_message_names_no_table_of_run_files(name, tmp_path):
    provoke, expected = CASES[name]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            provoke(tmp_path)
        except quasimc.InputError as error:
            text = str(error)
        else:
            text = "\n".join(str(each.message) for each in caught)
    assert expected in text
    assert not TABLE.search(text), text


def test_a_message_about_a_loaded_file_names_its_tables(tmp_path):
    path = tmp_path / "leaf.toml"
    path.write_text(
        'bands = ["PAR"]\n[run]\npaths = 0\n[[material]]\nname = "leaf"\nreflectance = 0.1\n[[organ]]\n'
        'material = "leaf"\nshape = "disk"\ncenter = [0, 0, 1]\nnormal = [0, 0, 1]\nradius = 1\n'
        '[[source]]\ntype = "sky"\nmodel = "uniform"\nirradiance_horizontal = 1\n'
    )
    with pytest.raises(quasimc.InputError, match=r"leaf.toml:3: \[run\]: paths"):
        quasimc.load(path).run()
