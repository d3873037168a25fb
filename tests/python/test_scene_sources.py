"""The sources and options of a scene as values."""

import copy
import pickle

import numpy as np
import pytest

import quasimc
from canopies import FEW

SKY = quasimc.uniform_sky(irradiance_horizontal=100, name="sky")
SUN = quasimc.directional(azimuth_deg=0, elevation_deg=90, irradiance_facing=300, name="sun")


def leaf_scene(**keys):
    scene = quasimc.Scene("PAR", **keys)
    scene.add_material("leaf", reflectance=0.1)
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1)
    return scene


def light(scene, *arguments):
    return scene.run(*arguments, **FEW)["incident_upper"]["PAR"].values[0]


def test_a_source_is_a_value():
    lamp = quasimc.lamp("line", power=10, from_=[0, 0, 1], to=[1, 0, 1])
    assert repr(lamp) == "lamp('line', power=10, from_=[0, 0, 1], to=[1, 0, 1])"
    assert eval(repr(SUN), vars(quasimc)) == SUN
    assert (lamp.type, lamp.power) == ("line", 10)
    brighter = lamp.replace(power=20)
    assert brighter.power == 20 and lamp.power == 10 and brighter != lamp
    assert pickle.loads(pickle.dumps(lamp)) == lamp
    with pytest.raises(AttributeError, match=r"a Source does not change: .*replace\(power=5\)"):
        lamp.power = 5
    with pytest.raises(AttributeError, match="this Source has no 'keys'; it has type, power, from, to"):
        lamp.keys


def test_sources_of_a_scene_are_replaced_and_edited():
    scene = leaf_scene()
    assert len(scene.sources) == 0 and scene.sources == []
    scene.sources = [SKY, SUN]
    assert scene.sources == [SKY, SUN] and scene.sources.names == ["sky", "sun"]
    assert light(scene) == pytest.approx(400, rel=0.05)
    scene.sources["sun"] = scene.sources["sun"].replace(irradiance_facing=200)
    assert light(scene) == pytest.approx(300, rel=0.05)
    del scene.sources["sky"]
    assert scene.sources == [SUN.replace(irradiance_facing=200)]
    scene.sources.append(SKY)
    assert light(scene, SUN) == pytest.approx(300, rel=0.05), "those of a run replace the scene's"
    scene.sources = SUN
    assert scene.sources[0] == scene.sources[-1] == SUN and scene.sources[:] == [SUN]
    scene.sources = None
    assert scene.sources == [] and scene == leaf_scene()


def test_sources_of_a_copy_are_its_own():
    scene = leaf_scene()
    scene.sources = [SKY]
    twin = copy.copy(scene)
    twin.sources.append(SUN)
    assert scene.sources == [SKY] and twin.sources == [SKY, SUN]


def test_refused_sources_change_nothing():
    scene = leaf_scene()
    scene.sources = [SKY, SUN]
    for assign in (
        lambda: scene.sources.append("sky"),
        lambda: setattr(scene, "sources", [SKY, 3]),
        lambda: scene.sources.__setitem__("sun", None),
    ):
        with pytest.raises(quasimc.InputError, match=r"is not a source; use quasimc\.sun"):
            assign()
    with pytest.raises(KeyError, match="there is no source 'sum'; there are: 'sky', 'sun'"):
        scene.sources["sum"]
    with pytest.raises(IndexError):
        scene.sources[2]
    with pytest.raises(AttributeError, match=r"use scene\.sources\.append"):
        scene.add_source(SKY)
    assert scene.sources == [SKY, SUN]
    scene.sources.append(SKY.replace(irradiance_horizontal=1, name="sun"))
    with pytest.raises(KeyError, match=r"2 sources have the name 'sun': use positions, \[1, 2\]"):
        scene.sources["sun"]


def test_sources_of_a_loaded_scene_are_read(tmp_path):
    (tmp_path / "leaf.toml").write_text(
        'bands = ["PAR"]\n[[material]]\nname = "leaf"\nreflectance = 0.1\n'
        '[[organ]]\nshape = "disk"\nmaterial = "leaf"\ncenter = [0, 0, 1]\nnormal = [0, 0, 1]\n'
        'radius = 0.1\n[[source]]\ntype = "uniform_sky"\nirradiance_horizontal = 100\n'
        "[run]\npaths = 128\nseed = 5\n"
    )
    scene = quasimc.load(tmp_path / "leaf.toml")
    assert scene.sources == [quasimc.uniform_sky(irradiance_horizontal=100)]
    assert scene.options == quasimc.RunOptions(paths=128, seed=5)


def test_files_of_sources_are_those_of_the_folder_in_which_they_were_assigned(tmp_path, monkeypatch):
    (tmp_path / "sky.csv").write_text("zenith_deg,azimuth_deg,radiance\n0,0,1\n90,0,1\n")
    monkeypatch.chdir(tmp_path)
    scene = leaf_scene()
    scene.sources = quasimc.sky("table", file="sky.csv", irradiance_horizontal=100)
    assert scene.sources[0].file == str(tmp_path / "sky.csv")


def test_options_of_a_scene_hold_for_all_its_runs():
    scene = leaf_scene()
    scene.sources = SKY
    assert scene.options is None
    scene.options = quasimc.RunOptions(paths=128, replicates=4, seed=3)
    result = scene.run(seed=4)
    assert (result.run.paths, result.run.replicates) == (128, 4)
    scene.options = scene.options.replace(seed=4)
    assert np.array_equal(scene.run()["incident_upper"].values, result["incident_upper"].values)
    with pytest.raises(quasimc.KeywordError, match=r"RunOptions\(\) has no keyword 'pathes'; did you"):
        quasimc.RunOptions(pathes=3)
    with pytest.raises(quasimc.InputError, match=r"assign quasimc\.RunOptions\(\.\.\.\) or None"):
        scene.options = {"paths": 3}
    assert scene.options.paths == 128
    with pytest.raises(quasimc.InputError, match="paths"):
        scene.run(paths=0)


def test_keys_of_sources_are_swept():
    scene = leaf_scene()
    scene.sources = [SKY, SUN]
    swept = scene.sweep({"sources.sun.irradiance_facing": [0, 300]}, **FEW)
    values = [result["incident_upper"]["PAR"].values[0] for result in swept]
    assert values == pytest.approx([100, 400], rel=0.05)
    assert scene.sources == [SKY, SUN]
    with pytest.raises(KeyError, match="there is no source 'moon'"):
        scene.sweep({"sources.moon.irradiance_facing": [1]})
    with pytest.raises(ValueError, match="swept and passed"):
        scene.sweep({"sources": [SKY]}, SUN)


def test_daylight_of_a_scene_beside_that_of_a_series_is_warned_of():
    scene = leaf_scene(site=quasimc.Site(52, 5.7), length_unit="m")
    day = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[11, 12])
    scene.sources = [quasimc.sky(irradiance_horizontal=100), quasimc.lamp("point", power=1, position=[0, 0, 2])]
    with pytest.warns(quasimc.QuasimcWarning, match=r"daylight as well: 'sky' .*lamps alone") as caught:
        both = scene.series(day, **FEW)
    assert len(caught) == 1 and caught[0].filename == __file__
    assert both.warnings == [str(caught[0].message)]
    with pytest.warns(quasimc.QuasimcWarning, match="daylight as well: 'upper', 'sun', 'sun' "):
        sun = quasimc.sun(azimuth_deg=0, elevation_deg=60, irradiance_facing=300)
        scene.series(day, [SKY.replace(name="upper"), sun, SUN], **FEW)
    assert scene.series(day, sources=[], **FEW).warnings == []
    assert scene.series(day, [scene.sources[1]], **FEW).warnings == []


@pytest.mark.parametrize(
    "name, hint",
    [
        ("grond", r"; did you mean 'ground'\?"),
        ("source", r"; did you mean 'sources'\?"),
        ("paths", r": it is an option, scene\.options = quasimc\.RunOptions\(paths=\.\.\.\)"),
        ("length_unit", r": it is given once, quasimc\.Scene\(length_unit=\.\.\.\)"),
        ("set_ground", r": assign scene\.ground = "),
        ("weather", "; to be assigned are ground, cell, site, time, options, sources"),
    ],
)
def test_a_scene_refuses_attributes_that_it_does_not_have(name, hint):
    scene = leaf_scene()
    with pytest.raises(AttributeError, match=f"^Scene has no '{name}'{hint}"):
        setattr(scene, name, 5)
    assert not hasattr(scene, name)
    with pytest.raises(AttributeError, match=r"did you mean 'add_mesh'\?"):
        scene.add_meshes


class Plot(quasimc.Scene):
    def __init__(self, owner):
        super().__init__("PAR")
        self.owner = owner


def test_attributes_of_a_scene_are_set_and_derived_classes_have_their_own():
    plot = Plot("Ada")
    plot.owner = "Emmy"
    plot.site = quasimc.Site(52, 5.7)
    assert plot.owner == "Emmy" and plot == copy.copy(plot) and plot == pickle.loads(pickle.dumps(plot))
    scene = leaf_scene()
    scene.ground, scene.cell, scene.options = quasimc.Ground("leaf"), quasimc.Cell(x=[0, 1]), None
    scene._note = "kept"
    assert scene._note == "kept" and pickle.loads(pickle.dumps(scene)) == scene
