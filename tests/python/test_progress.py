import io
import threading
import time

import numpy as np
import pytest

import quasimc
from canopies import canopy
from quasimc._progress import ProgressBar

LONG = {"paths": 1 << 18, "method": "light_tracing", "max_paths": 1 << 30, "target_error": 1e-9}


def test_a_callback_is_told_how_far_a_run_is():
    seen = []
    canopy(200).run(progress=seen.append, paths=1 << 18, method="light_tracing", replicates=16)
    fractions = [progress.fraction for progress in seen]
    assert fractions and fractions == sorted(fractions)
    assert all(0 <= fraction <= 1 for fraction in fractions)


def test_what_a_callback_raises_ends_the_run():
    class Enough(Exception):
        pass

    def raise_it(progress):
        raise Enough

    start = time.monotonic()
    with pytest.raises(Enough):
        canopy(200).run(progress=raise_it, **LONG)
    assert time.monotonic() - start < 60  # instead of hours


def test_other_threads_go_on_while_light_is_computed():
    scene = canopy(200)
    scene.build()
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.01)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    scene.run(max_seconds=1.0, **LONG)
    end = time.monotonic()
    done.set()
    thread.join()
    assert sum(start < t < end for t in ticks) > 10


def test_the_bar_is_written_over_and_wiped():
    stream = io.StringIO()
    bar = ProgressBar(stream)
    bar(quasimc.Progress(0.5, 1.0, 2.0, 0.0))
    bar(quasimc.Progress(1.0, 2.0, 2.0, 0.0))
    bar.close()
    lines = stream.getvalue().split("\r")
    assert lines[1].startswith("[###############...............]  50 %, 1 s left")
    assert lines[-1] == "" and lines[-2].strip() == ""


def test_a_callback_that_runs_its_own_scene_is_told_so():
    scene = canopy(200)
    told = []

    def run_again(progress):
        with pytest.raises(RuntimeError, match="is being computed"):
            scene.run(paths=64)
        told.append(progress)

    scene.run(progress=run_again, paths=1 << 18, method="light_tracing", replicates=16)
    assert told
    assert scene.run(paths=64).run.stop == "finished"


def changes_of(scene):
    """All that changes a scene."""
    corners = [[0, 0, 3], [1, 0, 3], [0, 1, 3]]
    return [
        lambda: scene.add_mesh([corners], material="leaf"),
        lambda: scene.add_material("leaf", reflectance=0.5),
        lambda: scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=1),
        lambda: scene.add_file("leaf.obj", material="leaf"),
        lambda: scene.add_detector("escaped_by_zenith"),
        lambda: scene.sources.append(quasimc.sky(irradiance_horizontal=[1, 1])),
        lambda: setattr(scene, "ground", quasimc.Ground("leaf")),
        lambda: setattr(scene, "cell", quasimc.Cell(x=[0, 1])),
    ]


def refuse_all(scene):
    for change in changes_of(scene):
        with pytest.raises(RuntimeError, match="is being computed"):
            change()


def long_run(scene, progress=None):
    return scene.run(
        progress=progress, paths=1 << 18, method="light_tracing", replicates=16, seed=3
    )["absorbed_flux"].values


def test_a_callback_can_read_its_scene_but_not_change_it():
    scene = canopy(200)
    seen = []

    def look(progress):
        refuse_all(scene)
        seen.append(len(scene.organs))

    light = long_run(scene, look)
    assert seen and set(seen) == {200}
    assert np.array_equal(light, long_run(canopy(200)))
    assert np.array_equal(light, long_run(scene))


def test_another_thread_cannot_change_a_scene_that_is_computed():
    scene = canopy(200)
    begun, go_on = threading.Event(), threading.Event()
    light = []

    def tell(progress):
        begun.set()
        go_on.wait(60)

    thread = threading.Thread(target=lambda: light.append(long_run(scene, tell)))
    thread.start()
    assert begun.wait(60)
    refuse_all(scene)
    go_on.set()
    thread.join()
    assert np.array_equal(light[0], long_run(canopy(200)))
    scene.add_material("leaf", reflectance=0.5)  # now that it is done
    assert not np.array_equal(light[0], long_run(scene))
