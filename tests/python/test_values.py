"""Values of a scene: ground, cell, site, time."""

import datetime
import pickle

import pytest

import quasimc


def leaf_scene():
    scene = quasimc.Scene("PAR", length_unit="m")
    scene.add_material("leaf", reflectance=0.1)
    scene.add_organ("disk", material="leaf", center=[0.5, 0.5, 1], normal=[0, 0, 1], radius=0.2)
    return scene


def test_values_compare_and_print_as_they_are_written():
    ground = quasimc.Ground("soil", x=(0, 1))
    assert repr(ground) == "Ground(material='soil', x=[0, 1])"
    assert ground == quasimc.Ground("soil", x=[0, 1]) != quasimc.Ground("soil")
    assert ground.replace(x=None, height=1) == quasimc.Ground("soil", height=1)
    assert (ground.height, ground.x) == (None, [0, 1])
    assert pickle.loads(pickle.dumps(ground)) == ground
    with pytest.raises(AttributeError, match="does not change: assign a new one"):
        ground.height = 2
    with pytest.raises(AttributeError, match="Ground has no 'heigth'"):
        ground.heigth
    with pytest.raises(TypeError, match="heigth"):
        quasimc.Ground("soil", heigth=1)


def test_times_take_dates_of_python():
    date = datetime.date(2024, 6, 21)
    day = quasimc.day(date, utc_offset_hours=1)
    assert day == quasimc.Time(day="2024-06-21", utc_offset_hours=1)
    noon = datetime.datetime(2024, 6, 21, 12)
    assert quasimc.times([noon], utc_offset_hours=1).times == ["2024-06-21T12:00:00"]
    weeks = quasimc.days(date, "2024-06-28", utc_offset_hours=1)
    assert weeks.table()["from"] == "2024-06-21"


def test_a_scene_gets_and_loses_values():
    scene = leaf_scene()
    assert scene.ground is scene.cell is scene.site is scene.time is None
    scene.ground = quasimc.Ground("leaf", x=[0, 1], y=[0, 1])
    scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))
    scene.site = quasimc.Site(52, 6)
    assert scene.cell.x == [0, 1] and scene.site.latitude_deg == 52
    sky = quasimc.sky(irradiance_horizontal=100)
    assert scene.run(sky, paths=64).ground is not None
    scene.ground = None
    assert scene.run(sky, paths=64).ground is None


def test_a_refused_value_changes_nothing():
    scene = leaf_scene()
    before = scene.__copy__()
    with pytest.raises(quasimc.InputError, match=r"assign quasimc.Ground\(...\) or None"):
        scene.ground = "leaf"
    with pytest.raises(quasimc.InputError, match=r"give quasimc.Time\(\*\*keys\)"):
        scene.series({"day": "2024-06-21"})
    with pytest.raises(ValueError, match="which time"):
        scene.series()
    with pytest.raises(AttributeError, match=r"assign scene.ground = quasimc.Ground"):
        scene.set_ground("leaf")
    assert scene == before


def test_a_value_of_no_sense_is_refused_when_the_scene_is_built():
    scene = leaf_scene()
    scene.cell = quasimc.Cell(x=(1, 0))
    with pytest.raises(quasimc.InputError, match="the first must be less than the second"):
        scene.build()
    scene.cell = None
    scene.build()


def test_a_series_is_one_whatever_the_scene():
    scene = leaf_scene()
    scene.site = quasimc.Site(52, 6)
    scene.time = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[11, 13])
    assert isinstance(scene.series(paths=64), quasimc.Series)
    other = scene.time.replace(hours=[11, 12])
    assert len(scene.series(other, paths=64)) == 1 and len(scene.series(paths=64)) == 2
