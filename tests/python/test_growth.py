import numpy as np
import pytest

import quasimc
from canopies import FEW

SKY = quasimc.sky(irradiance_horizontal=100)


def soil():
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1, transmittance=0.05)
    scene.add_material("soil", reflectance=0.2)
    return scene.set_ground("soil", x=[-2, 2], y=[-2, 2])


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


def test_results_come_in_the_order_asked():
    session = quasimc.GrowthSession(soil())
    for organ in (4, 2, 9):
        session.add(*leaf(organ, 0), material="leaf", organ=organ)
    result = session.run(SKY, **FEW)
    light = result["absorbed_flux"]["PAR"].mean
    assert np.array_equal(result.select([9, 4])["absorbed_flux"]["PAR"].mean, light[[2, 0]])
    with pytest.raises(KeyError):
        result.select([5])


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
