"""Editing the organs of a scene."""

import copy
import pickle

import numpy as np
import pytest

import quasimc
from canopies import FEW, leaves

SKY = quasimc.sky(irradiance_horizontal=100)


def empty():
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1, transmittance=0.05)
    scene.add_material("stem", reflectance=0.3)
    scene.add_material("soil", reflectance=0.2)
    scene.ground = quasimc.Ground("soil", x=[-1, 2], y=[-1, 2])
    return scene


def triangles_of(count, seed=7):
    """(organs, 2, 3, 3)"""
    vertices, faces, _ = leaves(count, seed)
    return vertices[faces].reshape(count, 2, 3, 3)


def scene_of(organs):
    """A new scene from a list of dict with id, triangles, material, labels, name, measured."""
    scene = empty()
    scene.add_organ("cylinder", material="stem", base=[0.5, 0.5, 0], axis=[0, 0, 1], radius=0.02, id=900)
    for one in organs:
        scene.add_mesh(
            one["triangles"], material=one["material"], organ=one["id"], labels=one["labels"],
            name=one["name"], measured=one["measured"],
        )  # fmt: skip
    return scene


def organs_of(count):
    return [
        {"id": i + 1, "triangles": own, "material": "leaf", "labels": {"plant": str(i % 3)},
         "name": f"leaf {i + 1}", "measured": True}
        for i, own in enumerate(triangles_of(count))
    ]  # fmt: skip


def as_one_mesh(organs):
    scene = scene_of([])
    scene.add_mesh(
        np.concatenate([one["triangles"] for one in organs]),
        organ=np.repeat([one["id"] for one in organs], 2),
        material="leaf",
        labels={"plant": [one["labels"]["plant"] for one in organs]},
        name=[one["name"] for one in organs],
    )
    return scene


def same_bits(edited, new):
    ours, theirs = (scene.run(SKY, **FEW, groups=["plant"]) for scene in (edited, new))
    assert ours.organs.ids.tolist() == theirs.organs.ids.tolist()
    assert ours.organs.names == theirs.organs.names
    assert ours.organs.labels == theirs.organs.labels
    assert ours["incident_upper"]._values.tobytes() == theirs["incident_upper"]._values.tobytes()
    assert ours["absorbed_flux"]._values.tobytes() == theirs["absorbed_flux"]._values.tobytes()
    assert ours.ground["absorbed_flux"].values.tolist() == theirs.ground["absorbed_flux"].values.tolist()


def edit_once(draw, scene, organs):
    """One random edit, of the scene and of the list."""
    i = draw.integers(len(organs))
    one, kind = organs[i], draw.integers(5)
    which = one["id"] if draw.integers(2) else one["name"]
    if kind == 0 and len(organs) > 3:
        scene.organs.remove(which)
        del organs[i]
    elif kind == 1:
        one["triangles"] = triangles_of(1, int(draw.integers(1000)))[0]
        scene.organs.replace(which, one["triangles"])
    elif kind == 2:
        shift = draw.normal(0, 0.1, 3)
        one["triangles"] = one["triangles"] * 1.25 + shift
        scene.organs.transform(which, scale=1.25, translate=shift)
    elif kind == 3:
        one["material"] = "stem"
        one["labels"] = {**one["labels"], "plant": "9"}
        scene.organs.set(which, material="stem", labels={"plant": 9})
    else:
        number = max(other["id"] for other in organs) + 1
        own = triangles_of(1, int(draw.integers(1000)))[0]
        organs.append({**organs_of(1)[0], "id": number, "name": f"leaf {number}", "triangles": own})
        scene.add_mesh(own, material="leaf", organ=number, labels=organs[-1]["labels"],
                       name=f"leaf {number}")


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
@pytest.mark.parametrize("seed", range(4))
def test_an_edited_scene_has_the_bits_of_a_new_one(seed):
    draw = np.random.default_rng(seed)
    organs = organs_of(12)
    scene = as_one_mesh(organs) if seed % 2 else scene_of(organs)
    for _ in range(3):
        for _ in range(6):
            edit_once(draw, scene, organs)
        same_bits(scene, scene_of(organs))


def test_several_organs_are_edited_at_once():
    organs = organs_of(9)
    scene = as_one_mesh(organs)
    scene.organs.remove(scene.organs.where(plant=1))
    left = [one for one in organs if one["labels"]["plant"] != "1"]
    same_bits(scene, scene_of(left))
    new = triangles_of(2, seed=3)
    scene.organs.replace([4, 1], new.reshape(-1, 3, 3), organ=[1, 1, 4, 4])
    for one, own in ((1, new[0]), (4, new[1])):
        next(o for o in left if o["id"] == one)["triangles"] = own
    same_bits(scene, scene_of(left))
    scene.organs.set(["leaf 3", 9], measured=False, labels={"plant": None, "kind": "old"})
    assert scene.organs.labels["kind"].count("old") == 2


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
def test_turning_is_that_of_a_run_file():
    turn = {"axis": [1, 2, 3], "angle_deg": 40}
    own = triangles_of(1)[0]
    scene = empty()
    scene.add_mesh(own, material="leaf", organ=7)
    scene.organs.transform(7, scale=2, rotate=turn, translate=[0.1, 0.2, 0.3])
    other = empty()
    other.add_organ("mesh", material="leaf", vertices=own.reshape(-1, 3).tolist(), faces=[[0, 1, 2], [3, 4, 5]],
                    transform={"scale": 2, "rotate": turn, "translate": [0.1, 0.2, 0.3]})
    assert np.allclose(scene.organs.triangles(0), other.organs.triangles(0), rtol=0, atol=1e-14)


def test_materials_of_faces_stay_with_their_faces():
    organs = organs_of(4)
    scene = empty()
    names = ["leaf", "stem", "stem", "stem", "leaf", "leaf", "leaf", "stem"]
    order = [5, 0, 3, 7, 1, 2, 4, 6]
    triangles = np.concatenate([one["triangles"] for one in organs])[order]
    scene.add_mesh(triangles, material=[names[i] for i in order], organ=[1 + i // 2 for i in order])
    new = copy.copy(scene)
    scene.organs.transform(2, translate=[0, 0, 1])
    scene.organs.transform(2, translate=[0, 0, -1])
    ours, theirs = (s.run(SKY, **FEW)["absorbed_flux"].values for s in (scene, new))
    assert np.allclose(ours, theirs, rtol=1e-12)
    with pytest.raises(quasimc.InputError, match="several materials.*material=..."):
        scene.organs.replace(1, organs[0]["triangles"])


@pytest.mark.parametrize("wrong, error, message", [
    (lambda o: o.remove(77), KeyError, "no organ with the id 77"),
    (lambda o: o.remove("leaf 99"), KeyError, "leaf 9"),
    (lambda o: o.set(900, material="lefa"), quasimc.InputError, "lefa"),
    (lambda o: o.replace(["organ 900", 1], triangles_of(1)[0]), quasimc.InputError, "give organ="),
    (lambda o: o.transform(["organ 900", 77], translate=[0, 0, 1]), KeyError, "77"),
    (lambda o: o.remove(np.ones(3, bool)), quasimc.InputError, "mask has the shape"),
    (lambda o: o.replace(1, [[[0, 0, 0], [1, 0, np.nan], [0, 1, 0]]]), quasimc.InputError, ""),
    (lambda o: o.replace([1, 2], triangles_of(1)[0]), quasimc.InputError, "give organ="),
    (lambda o: o.replace(1, triangles_of(1)[0], material="lefa"), quasimc.InputError, "lefa"),
    (lambda o: o.transform(1, scale=0), quasimc.InputError, "scale is 0"),
    (lambda o: o.transform(1, translate=[1, 2]), quasimc.InputError, "translate.*3 numbers"),
    (lambda o: o.transform(1, rotate={"axis": [0, 0, 0], "angle_deg": 9}), quasimc.InputError, "axis is 0"),
    (lambda o: o.transform([1, 2, 77], translate=[0, 0, 1]), KeyError, "77"),
    (lambda o: o.set(1, material="lefa"), quasimc.InputError, "lefa"),
    (lambda o: o.set(1, labels="plant"), quasimc.InputError, "labels is of the type str"),
])  # fmt: skip
def test_a_refused_edit_changes_nothing(wrong, error, message):
    scene = scene_of(organs_of(9))
    before = copy.copy(scene)
    with pytest.raises(error, match=message) as caught:
        wrong(scene.organs)
    assert scene == before and "[[" not in str(caught.value)


def test_results_and_copies_keep_the_organs_of_their_run():
    scene = scene_of(organs_of(5))
    result, other = scene.run(SKY, **FEW), copy.copy(scene)
    scene.organs.remove(2)
    assert len(result.organs) == len(other.organs) == 6 and len(scene.organs) == 5
    again = pickle.loads(pickle.dumps(scene))
    again.organs.remove([3, "leaf 4"])
    assert again.organs.ids.tolist() == [900, 1, 5]
    assert not hasattr(result.organs, "remove")
    scene.remove("leaf 1")
    assert scene.organs.names == ["organ 900", "leaf 3", "leaf 4", "leaf 5"]


@pytest.mark.parametrize("index", [3, 9, -1])
def test_an_index_without_an_organ_is_told(index):
    scene = scene_of(organs_of(1))  # with a stem and a ground
    result = scene.run(SKY, **FEW)
    for organs in (scene.organs, result.organs, pickle.loads(pickle.dumps(result.organs))):
        with pytest.raises(IndexError, match=rf"there is no index {index} \(there are 0 to 2\); index_of\(id\)"):
            organs.triangles(index)
        assert organs.triangles(2).shape == (2, 3, 3)


def test_organs_without_ids_keep_their_order():
    scene = empty()
    for i, own in enumerate(triangles_of(3)):
        scene.add_mesh(own, material="leaf", name=f"leaf {i}")
    scene.organs.replace("leaf 1", triangles_of(1, seed=5)[0])
    scene.organs.transform(3, translate=[0, 0, 0.5])
    assert scene.organs.names == ["leaf 0", "leaf 1", "leaf 2"] and scene.organs.ids.tolist() == [1, 2, 3]


def test_copies_of_shapes_are_numbered_beyond_the_ids_of_meshes():
    scene = empty()
    disk = {"material": "leaf", "normal": [0, 0, 1], "radius": 0.1}
    scene.add_organ("disk", center=[0, 0, 1], at=[[0, 0, 0], [0.5, 0, 0]], **disk)
    scene.add_organ("disk", center=[0, 0, 2], **disk)
    scene.add_mesh(triangles_of(1)[0], material="leaf", organ=50)
    scene.add_mesh(triangles_of(1, seed=1)[0], material="leaf")
    assert scene.organs.ids.tolist() == [51, 52, 53, 50, 54]


TWO_PLANTS = """mtllib leaf.mtl
v 0 0 2
v 1 0 2
v 0 1 2
v 1 1 2.5
g blade
usemtl blade
f 1 2 3
usemtl other
f 2 3 4
g sheath
usemtl leaf
f 1 2 4
"""


@pytest.fixture
def mixed(tmp_path):
    """Shapes, a copied shape, a file with materials of its own, a sensor, and a mesh."""
    (tmp_path / "leaf.mtl").write_text("newmtl blade\nKd 0.2 0.3 0.1\nnewmtl other\nKd 0.5 0.5 0.5\n")
    (tmp_path / "leaf.obj").write_text(TWO_PLANTS)
    scene = empty()
    scene.add_material("glass", transmittance=1, transmission_model="mirror")
    scene.add_organ("cylinder", material="stem", base=[0.5, 0.5, 0], axis=[0, 0, 1], radius=0.02, name="stem",
                    labels={"kind": "stem"})
    scene.add_organ("disk", material="leaf", center=[0.2, 0.2, 1.5], normal=[0, 0, 1], radius=0.1, id=40,
                    measured=False)
    scene.add_organ("disk", material="glass", center=[0.5, 0.2, 1.5], normal=[0, 0, 1], radius=0.1, id=7,
                    field_of_view_deg=30)
    scene.add_file(tmp_path / "leaf.obj", organs="groups", name="plant", labels={"plant": "1"},
                   transform={"scale": 0.5})
    scene.add_mesh(triangles_of(1)[0], material="leaf", name="last", labels={"kind": "leaf"})
    return scene


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
@pytest.mark.parametrize("edit", [
    lambda organs: organs.transform("plant blade", translate=[0, 0, 0]),
    lambda organs: organs.set("stem", labels={"kind": "stem"}),
    lambda organs: organs.transform([40, "last"], scale=1),
    lambda organs: organs.replace("stem", organs.triangles(0)),
])  # fmt: skip
def test_organs_are_taken_out_of_shapes_and_files_as_they_are(mixed, tmp_path, edit):
    new = copy.copy(mixed)
    new.build()
    edit(mixed.organs)
    (tmp_path / "leaf.obj").write_text("not read any more")
    mixed.build()
    (tmp_path / "leaf.obj").write_text(TWO_PLANTS)
    same_bits(mixed, new)
    ours, theirs = (s.run(SKY, **FEW, method="from_organs")["absorbed_flux"]["PAR"] for s in (mixed, new))
    np.testing.assert_array_equal(ours.values, theirs.values)
    assert np.isnan(ours.at(40).values) and mixed.organs.ids.tolist() == [1, 40, 7, 41, 42, 43]
    assert set(mixed.materials) == {"leaf", "stem", "soil", "glass", "blade", "other"}


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
def test_organs_of_shapes_and_files_are_edited(mixed):
    before = mixed.organs.triangles(3)
    mixed.organs.transform("plant blade", translate=[0, 0, 0.25])
    np.testing.assert_allclose(mixed.organs.triangles(3), before + [0, 0, 0.25], atol=1e-15)
    mixed.organs.remove(40)
    mixed.organs.set("plant sheath", material="stem", labels={"plant": 2})
    mixed.organs.replace("stem", triangles_of(1, seed=3)[0])
    assert mixed.organs.names == ["stem", "organ 7", "plant blade", "plant sheath", "last"]
    assert mixed.organs.ids.tolist() == [1, 7, 41, 42, 43]
    assert mixed.organs.labels["plant"] == ["", "", "1", "2", ""]
    assert len(mixed.organs.triangles(0)) == 2
    again = pickle.loads(pickle.dumps(mixed))
    mixed.remove("plant")
    assert mixed.organs.names == ["stem", "organ 7", "last"]
    assert again.organs.names[2:4] == ["plant blade", "plant sheath"]
    again.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1, name="new")
    again.organs.transform("new", translate=[0, 0, 1])
    assert again.organs.names[0] == "new" and len(again.organs) == 6


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
def test_an_organ_under_another_comes_back_whole():
    scene = empty()
    for name in ("above", "below"):
        scene.add_organ("polygon", material="leaf", name=name,
                        corners=[[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    assert scene.run(SKY, **FEW)["incident_upper"]["PAR"].values[1] == 0
    scene.organs.remove("above")
    assert scene.run(SKY, **FEW)["incident_upper"]["PAR"].values[0] > 10


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
def test_copies_become_organs_of_their_own():
    scene = quasimc.Scene("PAR", up="y")
    scene.add_material("leaf", reflectance=0.1)
    scene.add_organ("disk", material="leaf", center=[0, 1, 0], normal=[0, 1, 0], radius=0.1, name="leaf",
                    at=[{"x": 0, "y": 0, "z": 0, "row": "1"}, {"x": 1, "y": 0, "z": 0, "row": "2"}])
    labels, triangles = scene.organs.labels, [scene.organs.triangles(i) for i in range(2)]
    names = scene.organs.names
    scene.organs.transform(names[1], translate=[0, 1, 0])
    assert scene.organs.names == names and scene.organs.labels == labels
    assert labels["row"] == ["1", "2"]
    np.testing.assert_allclose(scene.organs.triangles(0), triangles[0], atol=1e-15)
    np.testing.assert_allclose(scene.organs.triangles(1), triangles[1] + [0, 1, 0], atol=1e-15)
