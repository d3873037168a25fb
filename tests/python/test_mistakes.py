"""Mistakes are refused at the line with the mistake, with what to write instead."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

import quasimc
from canopies import FEW
from quasimc import _keys

LEAF = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
REFERENCE = Path(os.environ["QUASIMC_SOURCE_DIR"]) / "docs" / "reference" / "run-file.md"


def scene(unit="umol m-2 s-1", **keys):
    made = quasimc.Scene({"PAR": unit}, **keys)
    made.add_material("leaf", reflectance=0.1)
    made.add_mesh(LEAF, [[0, 1, 2]], material="leaf")
    return made


def run(made, **options):
    return made.run(quasimc.sky(irradiance_horizontal=100), **{**FEW, **options})


@pytest.mark.parametrize("unit", ["umol/m2/s", "µmol m⁻² s⁻¹", "umol.m-2.s-1"])
def test_units_are_written_in_one_spelling(unit):
    light = run(scene(unit))["absorbed_flux_density"]
    assert light.unit == "umol m-2 s-1"


def test_a_misspelled_unit_is_refused():
    with pytest.raises(quasimc.InputError, match="did you mean 'umol m-2 s-1'"):
        scene("umol m-2 s")
    with pytest.raises(quasimc.InputError, match="did you mean 'cm'"):
        scene(length_unit="CM")


@pytest.mark.filterwarnings("ignore")
def test_a_length_of_no_known_unit_is_a_warning():
    assert any("'foo' is only a name" in text for text in scene(length_unit="foo").warnings)
    assert scene(length_unit="metres").warnings == []


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("factor, texts", [(100, 1), (1000, 1), (1, 0)])
def test_a_mesh_of_another_unit_is_a_warning(factor, texts):
    made = quasimc.Scene("PAR", length_unit="m")
    made.add_material("leaf", reflectance=0.1)
    made.add_mesh(factor * np.array(LEAF), [[0, 1, 2]], material="leaf")
    assert sum("is length_unit" in text for text in made.warnings) == texts


@pytest.mark.filterwarnings("ignore")
def test_one_mesh_in_millimetres_is_a_warning():
    made = scene()
    for leaf in (np.add(LEAF, [0, 0, 1]), 1000 * np.array(LEAF)):
        made.add_mesh(leaf, [[0, 1, 2]], material="leaf")
    assert any("the organs are within 999 m of height" in text for text in made.warnings)


def test_an_id_of_a_mesh_without_ids_is_refused_at_the_call():
    made = scene()
    with pytest.raises(quasimc.InputError, match="an earlier mesh has the id 1, the next free one"):
        made.add_mesh(LEAF, [[0, 1, 2]], material="leaf", organ=1)
    made.add_mesh(np.add(LEAF, [0, 0, 1]), [[0, 1, 2]], material="leaf", organ=7)
    made.add_mesh(np.add(LEAF, [0, 0, 2]), [[0, 1, 2]], material="leaf")  # 8
    with pytest.raises(quasimc.InputError, match="has the id 8"):
        made.add_mesh(np.add(LEAF, [0, 0, 3]), [[0, 1, 2]], material="leaf", organ=[8])
    assert made.build().ids.tolist() == [1, 7, 8]


def test_an_id_is_free_again_when_its_mesh_was_removed():
    made = quasimc.Scene("PAR")
    made.add_material("leaf", reflectance=0.1)
    made.add_mesh(LEAF, [[0, 1, 2]], material="leaf", name="first")
    made.remove("first")
    made.add_mesh(LEAF, [[0, 1, 2]], material="leaf", organ=1)
    assert made.build().ids.tolist() == [1]


CALLS = {
    "site": (lambda: quasimc.Site(120, 52), "Site: latitude_deg is 120"),
    "other site": (lambda: quasimc.Site(50, 5).replace(longitude_deg=500), "Site: longitude_deg"),
    "key of a sky": (lambda: quasimc.sky(irradiance=400), "did you mean 'irradiance_horizontal'"),
    "another sky": (
        lambda: quasimc.sky(irradiance_horizontal=4).replace(irradiance=5), "sky.. has no keyword 'irradiance'"
    ),
    "key of a lamp": (lambda: quasimc.lamp("point", position=[0, 0, 1], powr=3), "did you mean 'power'"),
    "type": (lambda: quasimc.Source("pint", power=3), "did you mean 'point'"),
    "clock": (lambda: quasimc.day("2024-06-21", timezone=2), "'timezone'; utc_offset_hours"),
    "key of days": (
        lambda: quasimc.days("2024-06-21", "2024-06-22", utc_offset_hours=1, step_minute=30),
        "days.. has no keyword 'step_minute'; did you mean 'step_minutes'",
    ),
    "key of weather": (lambda: quasimc.weather("a.csv", kolumns={}), "did you mean 'columns'"),
    "swept part": (
        lambda: scene().sweep({"material.leaf.reflectance": [0.1]}, quasimc.sky(irradiance_horizontal=1)),
        "did you mean 'materials'",
    ),
    "swept key": (
        lambda: scene().sweep({"materials.leaf.reflectence": [0.1]}, quasimc.sky(irradiance_horizontal=1)),
        "did you mean 'reflectance'",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CALLS)
def test_a_wrong_call_is_refused_with_what_to_write(name):
    call, expected = CALLS[name]
    with pytest.raises(quasimc.InputError, match=expected):
        call()


def test_what_is_missing_is_named():
    with pytest.raises(TypeError, match="needs utc_offset_hours"):
        quasimc.day("2024-06-21")
    with pytest.raises(TypeError, match="needs irradiance_horizontal"):
        quasimc.sky()


def test_a_misspelled_property_of_a_material_is_refused():
    leaf = scene().materials["leaf"]
    with pytest.raises(AttributeError, match="did you mean 'reflectance'"):
        leaf.reflectence = 0.2
    with pytest.raises(AttributeError, match=r"set\(optics=...\)"):
        leaf.optics = "grass_leaf"


def test_a_missing_day_is_refused_with_those_that_there_are():
    made = scene(site=quasimc.Site(51, 10))
    days = made.series(quasimc.day("2024-06-21", utc_offset_hours=1, hours=[12, 13]), **FEW).days
    assert list(days) == ["2024-06-21"]
    with pytest.raises(KeyError, match="no day '2024-06-22'; there are: 2024-06-21 to 2024-06-21"):
        days["2024-06-22"]


def test_a_missing_folder_is_named_before_anything_is_drawn(tmp_path):
    result = run(scene())
    path = tmp_path / "none" / "x"
    for write in (
        lambda: result.save(path.with_suffix(".json")),
        lambda: result.picture(path.with_suffix(".png")),
        lambda: result.report(path.with_suffix(".html")),
        lambda: scene().picture(path.with_suffix(".png")),
        lambda: quasimc.pictures.Picture(b"\x89PNG" + bytes(20)).save(path.with_suffix(".png")),
    ):
        with pytest.raises(FileNotFoundError, match="the folder .*none' does not exist"):
            write()


def test_an_empty_scene_is_named_once():
    with pytest.raises(quasimc.InputError, match=r"^scene: there are no organs"):
        quasimc.Scene("PAR").build()


def keys_of_tables(begin, end):
    """The keys in the tables of a part of the reference."""
    text = REFERENCE.read_text("utf-8")
    part = text[text.index(begin) : text.index(end)]
    cells = [line.split("|")[1] for line in part.splitlines() if line.startswith("| `")]
    return {key for cell in cells for key in re.findall(r"`([a-z_]+)`", cell)}


def test_the_keys_of_times_are_those_of_the_reference():
    text = REFERENCE.read_text("utf-8")
    part = text[text.index("## `[time]`") :]
    cells = [line.split("|")[1] for line in part.splitlines() if line.startswith("| `")]
    keys = {key for cell in cells for key in re.findall(r"`([a-z_]+)`", cell)}
    assert keys | {"duration_minutes"} == set(_keys.TIME_KEYS)


def test_the_keys_of_tables_are_those_of_the_reference():
    text = (REFERENCE.parent / "csv.md").read_text("utf-8")
    part = text[text.index("## Tables by request") : text.index("## Lamps under control")]
    keys = re.findall(r"^\| `([a-z_]+)` \|", part, flags=re.M)
    assert keys == ["file", *_keys.TABLE_KEYS]


def test_the_keys_of_sources_are_those_of_the_reference():
    known = {key for keys in _keys.SOURCE_KEYS.values() for key in keys}
    assert keys_of_tables("## `[[source]]`", "### Lamps") == known
    common = keys_of_tables("| `aim` | [x, y, z] | down", "Where bands have different units")
    assert common <= {*_keys.LAMP_KEYS, "on_hours"}
