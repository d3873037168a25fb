"""Materials that are edited between runs."""

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy


def test_values_of_a_band_are_read_and_set():
    scene = canopy()
    leaf = scene.materials["leaf"]
    assert dict(leaf.reflectance) == {"PAR": 0.08, "NIR": 0.45}
    assert list(scene.materials) == ["leaf", "soil"]
    leaf.reflectance["NIR"] = 0.3
    leaf.transmittance = 0.1
    assert dict(leaf.reflectance) == {"PAR": 0.08, "NIR": 0.3}
    assert dict(leaf.transmittance) == {"PAR": 0.1, "NIR": 0.1}
    assert list(scene.materials) == ["leaf", "soil"], "the order stays"
    assert "NIR 0.3" in repr(leaf)


def test_an_edited_scene_is_a_new_one():
    edited = canopy()
    edited.run(**FEW)
    edited.materials["leaf"].set(reflectance=[0.1, 0.2], transmittance=0)
    new = canopy()
    new.add_material("leaf", reflectance=[0.1, 0.2], transmittance=0)
    assert edited.run(**FEW) == new.run(**FEW)
    assert edited.run(**FEW) != canopy().run(**FEW)


def test_refused_changes_change_nothing():
    scene = canopy()
    before = scene.run(**FEW)
    leaf = scene.materials["leaf"]
    with pytest.raises(quasimc.InputError):
        leaf.reflectance["NIR"] = 0.9  # 0.45 of it is transmitted
    with pytest.raises(quasimc.InputError):
        leaf.transmittance = -1
    with pytest.raises(KeyError, match="PAR, NIR"):
        leaf.reflectance["UV"] = 0.1
    with pytest.raises(ValueError, match="'leaf' is used by 1"):
        del scene.materials["leaf"]
    with pytest.raises(ValueError, match="'soil' is used by 1"):
        del scene.materials["soil"]
    with pytest.raises(KeyError, match="did you mean 'leaf'"):
        scene.materials["leef"]
    assert scene.run(**FEW) == before


def test_materials_are_added_and_removed():
    scene = canopy()
    scene.materials["bark"] = {"reflectance": 0.3}
    scene.materials["wood"] = scene.materials["bark"]
    assert scene.materials["wood"].reflectance["PAR"] == 0.3 and len(scene.materials) == 4
    del scene.materials["wood"]
    assert "wood" not in scene.materials and not scene.materials["bark"].transmittance


def test_results_stay_what_they_were(tmp_path):
    scene = canopy()
    result = scene.run(**FEW)
    scene.materials["leaf"].reflectance = [0.2, 0.2]
    scene.add_organ("disk", material="leaf", center=[0, 0, 3], normal=[0, 0, 1], radius=0.1)
    scene.sources.append(quasimc.sky(irradiance_horizontal=1))
    back = quasimc.open(result.save(tmp_path / "before.json"))
    assert back == result and np.array_equal(back.organs.ids, result.organs.ids)


def test_unknown_keywords_name_the_known_one():
    scene = canopy()
    with pytest.raises(quasimc.KeywordError, match="no keyword 'path'; did you mean 'paths'"):
        scene.run(path=3)
    with pytest.raises(TypeError, match=r"'xyzw'; quasimc.options\(\) lists them"):
        scene.run(xyzw=3)
