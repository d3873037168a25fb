"""Growth: organs of a scene that are added, changed and removed between its runs."""

import numpy as np
import pytest

import quasimc
from canopies import FEW

SKY = quasimc.sky(irradiance_horizontal=100)


def soil():
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1, transmittance=0.05)
    scene.add_material("soil", reflectance=0.2)
    scene.ground = quasimc.Ground("soil", x=[-2, 2], y=[-2, 2])
    return scene


def leaf(organ, step):
    size = 0.1 + 0.02 * step
    low = 0.07 * organ
    corners = np.array([[0, 0, 0], [size, 0, 0], [size, size, 0], [0, size, 0]])
    return corners + [low, 0, 0.2 + 0.1 * low], np.array([[0, 1, 2], [0, 2, 3]])


def light_of(scene):
    return scene.run(SKY, **FEW)["absorbed_flux"]["PAR"].values


def test_steps_give_the_bits_of_single_runs():
    scene = soil()
    alive = {}
    for step in range(12):
        alive[step + 1] = leaf(step, step)
        scene.add_mesh(*alive[step + 1], material="leaf", organ=step + 1)
        if step % 4 == 3:
            scene.organs.remove(step - 1)
            del alive[step - 1]
        first = next(iter(alive))
        alive[first] = leaf(first + 0.3, step)
        scene.organs.replace(first, *alive[first])
        result = scene.run(SKY, **FEW)

        alone = soil()
        for organ, (vertices, faces) in alive.items():
            alone.add_mesh(vertices, faces, material="leaf", organ=organ)
        expected = alone.run(SKY, **FEW)
        assert np.array_equal(result._core.values, expected._core.values, equal_nan=True)
        assert result.organs.ids.tolist() == expected.organs.ids.tolist()
    assert len(scene.organs) == len(alive) and 1 in scene.organs and 2 not in scene.organs


def test_overlaps_come_and_go_with_their_organs():
    """They are searched near changed triangles only."""
    scene, twin = soil(), leaf(3, 0)
    scene.add_mesh(*leaf(3, 0), material="leaf", organ=1)
    scene.add_mesh(*leaf(5, 0), material="leaf", organ=2)
    apart = light_of(scene)
    with pytest.warns(quasimc.QuasimcWarning, match="same corners"):
        scene.organs.replace(2, *twin)
        both = light_of(scene)
    assert both[0] > 0.8 * apart[0] and both[1] == 0
    scene.organs.replace(2, *leaf(5, 0))
    assert np.array_equal(light_of(scene), apart)


def test_faulty_organs_are_not_taken():
    scene = soil()
    scene.add_mesh(*leaf(1, 0), material="leaf", organ=1)
    before = light_of(scene)
    vertices, faces = leaf(1, 5)
    for change in (
        lambda: scene.organs.replace(1, vertices * np.nan, faces),
        lambda: scene.organs.replace(1, vertices, faces, material="nope"),
        lambda: scene.add_mesh(vertices, faces, material="nope", organ=2),
        lambda: scene.add_mesh(vertices, faces, material="leaf", organ=1),
    ):
        with pytest.raises(quasimc.InputError):
            change()
    assert 2 not in scene.organs and len(scene.organs) == 1
    assert np.array_equal(light_of(scene), before)


def test_organs_that_are_not_there_are_refused():
    scene = soil()
    scene.add_mesh(*leaf(1, 0), material="leaf", organ=1)
    for action in (
        lambda: scene.organs.replace(2, *leaf(2, 0)),
        lambda: scene.organs.remove(2),
        lambda: scene.organs.remove([1, 2]),
    ):
        with pytest.raises(KeyError, match="2"):
            action()
    assert 1 in scene.organs


def test_results_come_in_the_order_asked():
    scene = soil()
    for organ in (4, 2, 9):
        scene.add_mesh(*leaf(organ, 0), material="leaf", organ=organ)
    result = scene.run(SKY, **FEW)
    light = result["absorbed_flux"]["PAR"].values
    assert np.array_equal(result.at([9, 4])["absorbed_flux"]["PAR"].values, light[[2, 0]])
    with pytest.raises(KeyError):
        result.at([5])


def test_only_what_changed_is_built():
    scene = soil()
    scene.add_mesh(*leaf(1, 0), material="leaf")
    for paths in (256, 512):
        scene.run(SKY, paths=paths)
    assert scene._simulator.builds == 1
    scene.materials["leaf"].reflectance = 0.5
    scene.run(SKY, paths=256)
    assert scene._simulator.builds == 1
    scene.organs.transform(1, translate=[0, 0, 0.1])
    scene.run(SKY, paths=256)
    assert scene._simulator.builds == 2


def test_changes_of_many_organs_take_no_longer_each():
    """An edit does not pass all meshes: a loop over all leaves is linear."""
    scene = soil()
    for organ in range(300):
        scene.add_mesh(*leaf(organ, 0), material="leaf", organ=organ + 1)
    meshes = scene._meshes
    touched = []

    class Watched(dict):
        def values(self):
            touched.append("values")
            return super().values()

        def __iter__(self):
            touched.append("iter")
            return super().__iter__()

    scene._meshes = Watched(meshes)
    scene.organs.replace(7, *leaf(7, 3))
    scene.organs.remove(8)
    assert touched == [] and len(scene._meshes) == 299


def test_members_are_ids_and_names():
    scene = soil()
    scene.add_mesh(*leaf(1, 0), material="leaf", organ=5, name="flag leaf")
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1)
    assert 5 in scene.organs and np.int32(5) in scene.organs and 6 in scene.organs
    assert "flag leaf" in scene.organs and "leaf" not in scene.organs
    assert 5.9 not in scene.organs and "5" not in scene.organs and 2**70 not in scene.organs


def test_the_session_of_earlier_versions_names_what_replaces_it():
    with pytest.raises(AttributeError, match="edit the organs of a scene between its runs"):
        quasimc.GrowthSession
