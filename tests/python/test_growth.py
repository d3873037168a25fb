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


def test_steps_give_the_bits_of_single_runs():
    session = quasimc.GrowthSession(soil())
    alive = {}
    for step in range(12):
        vertices, faces = leaf(step, step)
        assert session.add(vertices, faces, material="leaf", organ=step + 1) == [step + 1]
        alive[step + 1] = (vertices, faces)
        if step % 4 == 3:
            session.remove(step - 1)
            del alive[step - 1]
        first = next(iter(alive))
        alive[first] = leaf(first + 0.3, step)
        session.change(*alive[first], material="leaf", organ=first)
        result = session.run(SKY, **FEW)

        alone = soil()
        for organ, (vertices, faces) in alive.items():
            alone.add_mesh(vertices, faces, material="leaf", organ=organ)
        expected = alone.run(SKY, **FEW)
        assert np.array_equal(result._core.values, expected._core.values, equal_nan=True)
        assert result.organs.ids.tolist() == expected.organs.ids.tolist()
    assert len(session) == len(alive) and 1 in session and 2 not in session


def test_faulty_organs_are_not_taken():
    session = quasimc.GrowthSession(soil())
    session.add(*leaf(1, 0), material="leaf", organ=1)
    vertices, faces = leaf(1, 5)
    for change in (
        lambda: session.change(vertices * np.nan, faces, material="leaf", organ=1),
        lambda: session.change(vertices, faces, material="nope", organ=1),
        lambda: session.add(vertices, faces, material="nope", organ=2),
    ):
        with pytest.raises(quasimc.InputError):
            change()
    assert 2 not in session and len(session) == 1
    alone = soil()
    alone.add_mesh(*leaf(1, 0), material="leaf", organ=1)
    values = session.run(SKY, **FEW)._core.values
    assert np.array_equal(values, alone.run(SKY, **FEW)._core.values, equal_nan=True)


def test_results_come_in_the_order_asked():
    session = quasimc.GrowthSession(soil())
    for organ in (4, 2, 9):
        session.add(*leaf(organ, 0), material="leaf", organ=organ)
    result = session.run(SKY, **FEW)
    light = result["absorbed_flux"]["PAR"].values
    assert np.array_equal(result.at([9, 4])["absorbed_flux"]["PAR"].values, light[[2, 0]])
    with pytest.raises(KeyError):
        result.at([5])


def test_only_what_changed_is_built():
    scene = soil()
    session = quasimc.GrowthSession(scene)
    session.add(*leaf(1, 0), material="leaf")
    for paths in (256, 512):
        session.run(SKY, paths=paths)
    assert (session.scene_builds, session.tree_builds) == (1, 1)
    scene.add_material("leaf", reflectance=0.5)
    session.update_scene()
    session.run(SKY, paths=256)
    assert (session.scene_builds, session.tree_builds) == (2, 1)


def test_organs_that_are_not_there_are_refused():
    session = quasimc.GrowthSession(soil())
    session.add(*leaf(1, 0), material="leaf", organ=1)
    for action in (
        lambda: session.add(*leaf(1, 0), material="leaf", organ=1),
        lambda: session.change(*leaf(2, 0), material="leaf", organ=2),
        lambda: session.remove(2),
    ):
        with pytest.raises(quasimc.InputError, match="organ"):
            action()


def light_of(session):
    return session.run(SKY, **FEW)["absorbed_flux"]["PAR"].values


def two_leaves(first, second):
    """Vertices, faces and ids of two leaves, in one mesh."""
    (v, f), (w, g) = leaf(first, 3), leaf(second, 3)
    return np.concatenate([v, w]), np.concatenate([f, g + 4]), [first, first, second, second]


def test_a_call_changes_all_or_nothing():
    session = quasimc.GrowthSession(soil())
    session.add(*leaf(1, 0), material="leaf", organ=1)
    before = light_of(session)
    vertices, faces, organ = two_leaves(1, 999)
    for action in (
        lambda: session.change(vertices, faces, material="leaf", organ=organ),
        lambda: session.remove([1, 999]),
        lambda: session.remove([1, 1]),
        lambda: session.add(vertices, faces, material="leaf", organ=[998, 998, 1, 1]),
        lambda: session.change(*leaf(2, 0), material="leaf", organ=None),
    ):
        with pytest.raises(quasimc.InputError):
            action()
        assert len(session) == 1
        assert np.array_equal(light_of(session), before)
    session.remove([])
    session.remove(np.array([1]))
    assert len(session) == 0


def test_a_step_warns_as_a_single_run():
    twins = np.zeros((3, 3, 3)) + [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
    twins[0, :, 2] = -1
    organ = [1, 2, 3]
    scene = soil()
    session = quasimc.GrowthSession(scene)
    session.add(twins, material="leaf", organ=organ)
    with pytest.warns(quasimc.QuasimcWarning) as told:
        step = session.run(SKY, **FEW)
    scene.add_mesh(twins, material="leaf", organ=organ)
    with pytest.warns(quasimc.QuasimcWarning):
        alone = scene.run(SKY, **FEW)
    assert len(step.warnings) == 2 and step.warnings == alone.warnings
    assert [str(warning.message) for warning in told] == step.warnings
    assert session.run(SKY, **FEW).warnings == step.warnings  # kept, without another warning
    session.remove([1, 3])
    assert session.run(SKY, **FEW).warnings == []


def test_ids_differ_from_those_of_the_scene():
    scene = soil()
    scene.add_mesh(*leaf(5, 0), material="leaf", organ=3)
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1)
    session = quasimc.GrowthSession(scene)
    assert session.add(*leaf(1, 0), material="leaf") == [5]
    for taken in (3, 4):
        with pytest.raises(quasimc.InputError, match="scene of the session has an organ"):
            session.add(*leaf(2, 0), material="leaf", organ=taken)
        with pytest.raises(quasimc.InputError, match="belongs to the scene of the session"):
            session.change(*leaf(2, 0), material="leaf", organ=taken)
    assert len(session) == 1 and 3 not in session and 5 in session
    assert sorted(session.run(SKY, **FEW).organs.ids.tolist()) == [3, 4, 5]
    scene.add_mesh(*leaf(8, 0), material="leaf", organ=5)
    with pytest.raises(quasimc.InputError, match="session has an organ with this id"):
        session.update_scene()


def test_ids_are_integers():
    session = quasimc.GrowthSession(soil())
    session.add(*leaf(1, 0), material="leaf", organ=5)
    assert 5 in session and np.int32(5) in session
    assert 5.9 not in session and "5" not in session and 2**70 not in session
    for ids in (5.0, [5.9], [2**64 - 1], np.ma.masked_equal([5, 6], 6)):
        with pytest.raises(quasimc.InputError, match="remove: "):
            session.remove(ids)
    result = session.run(SKY, **FEW)
    assert result.at(np.array([5]))["absorbed_flux"].index.ids.tolist() == [5]
    with pytest.raises(KeyError):
        result.at([5.9])
