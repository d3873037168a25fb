import pickle

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy, leaves

TRIANGLE = [[0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2]]


def test_all_faults_of_a_scene_are_told_at_once():
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.3, transmittance=0.6)
    scene.add_organ("disk", material="leef", center=[0, 0, 0], normal=[0, 0, 1], radius=1)
    scene.add_organ("disk", material="leaf", center=[0, 0, 1e31], normal=[0, 0, 1], radius=1)
    with pytest.raises(quasimc.InputError) as caught:
        scene.build()
    assert len(caught.value.faults) == 2
    assert "1e+31" in str(caught.value) and "leef" in str(caught.value)
    assert set(caught.value.faults[0]) == {"where", "problem", "why", "suggestion"}


def test_errors_are_value_errors_where_that_fits():
    assert issubclass(quasimc.InputError, ValueError)
    assert issubclass(quasimc.InputError, quasimc.Error)
    assert not issubclass(quasimc.Stopped, ValueError)


@pytest.mark.parametrize(
    "state",
    [
        lambda scene, text: scene.add_material(text, reflectance=0.1),
        lambda scene, text: scene.add_mesh(*TRIANGLE, material="leaf", name=text),
        lambda scene, text: scene.add_mesh(*TRIANGLE, material="leaf", labels={"plant": text}),
        lambda scene, text: scene.add_mesh(*TRIANGLE, material="leaf", labels={text: "1"}),
    ],
)
def test_half_a_character_is_refused_as_such(state):
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1)
    with pytest.raises(quasimc.InputError, match="lone surrogate"):
        state(scene, "bl\udce4tt")
        scene.build()


def test_errors_reach_other_processes():
    with pytest.raises(quasimc.InputError) as caught:
        canopy().run(paths=0)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.faults) == (str(caught.value), caught.value.faults)
    stopped = pickle.loads(pickle.dumps(quasimc.Stopped("stopped: why", "interrupted")))
    assert (str(stopped), stopped.why) == ("stopped: why", "interrupted")


@pytest.mark.parametrize(
    "keys, words",
    [
        ({"paths": 0}, "paths: 0 is out of range"),
        ({"pathes": 10}, "no keyword 'pathes'; did you mean 'paths'"),
        ({"sampler": "dice"}, "sampler"),
        ({"seed": 2**70}, "integer that is too large"),
        ({"seed": object()}, "of the type object"),
        ({"ratios": ["PAR:FIR"]}, "FIR"),
    ],
)
def test_options_are_checked_as_those_of_a_run_file(keys, words):
    with pytest.raises(quasimc.InputError, match=words):
        canopy().run(**keys)


@pytest.mark.parametrize(
    "change, words",
    [
        (lambda v, f, o: (v[:, :2], f, o), "must be .n, 3."),
        (lambda v, f, o: (v, f.astype(float), o), "must be integers"),
        (lambda v, f, o: (v, f, o[:-1]), "one for each of the 8 faces"),
        (lambda v, f, o: (v, f + 10, o), "refers to vertex"),
        (lambda v, f, o: (v, f - 1, o), "refers to vertex -1"),
        (lambda v, f, o: (v * np.nan, f, o), "finite"),
        (lambda v, f, o: (v, f[:0], o[:0]), "no triangles"),
        (lambda v, f, o: (v, f, np.full(len(f), 2**63, dtype=np.uint64)), "largest integer is 2.63"),
        (lambda v, f, o: (v, f.astype(np.uint64) + np.uint64(2**63), o), "largest integer is 2.63"),
        (lambda v, f, o: (v, f, [2**70] * len(f)), "must be integers"),
        (lambda v, f, o: (np.ma.masked_greater(v, 1.5), f, o), "some of vertices are masked"),
        (lambda v, f, o: (v, np.ma.masked_equal(f, 0), o), "some of faces are masked"),
        (lambda v, f, o: (v, f, np.ma.masked_equal(o, 1)), "some of organ are masked"),
    ],
)
def test_bad_arrays_are_refused(change, words):
    vertices, faces, organ = change(*leaves(4))
    with pytest.raises(quasimc.InputError, match=words):
        scene = quasimc.Scene("PAR").add_material("leaf", reflectance=0.1)
        scene.add_mesh(vertices, faces, organ=organ, material="leaf").build()


def test_the_lines_of_a_run_file_are_told(tmp_path):
    (tmp_path / "bad.toml").write_text('bands = ["PAR"]\n[[material]]\nname = "leaf"\nshine = 3\n')
    with pytest.raises(quasimc.InputError, match=r"bad\.toml:4: .*shine"):
        quasimc.load(tmp_path / "bad.toml")


def test_a_file_that_is_not_there_is_an_error():
    with pytest.raises(quasimc.InputError, match="nowhere.toml"):
        quasimc.load("nowhere.toml")


def test_a_run_without_light_is_an_error():
    scene = canopy()
    with pytest.raises(quasimc.InputError, match="source"):
        scene.run([])


def test_a_run_that_has_no_time_for_a_result_stops():
    # The first paths have a quarter of a second, and take some fifteen on one thread.
    slow = {"method": "light_tracing", "accelerator": "brute_force", "threads": 1}
    with pytest.raises(quasimc.Stopped) as caught:
        canopy(100_000).run(max_seconds=1e-9, **slow)
    assert caught.value.why == "time_limit"


def test_what_is_probably_not_meant_is_a_warning():
    scene = quasimc.Scene("PAR").add_material("leaf", reflectance=0.1)
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    scene.add_mesh(corners, [[0, 1, 2], [0, 1, 2]], material="leaf")
    with pytest.warns(quasimc.QuasimcWarning, match="triangle"):
        scene.build()
    result = scene.run(quasimc.sky(irradiance_horizontal=1), **FEW)
    assert result.warnings


@pytest.mark.parametrize("sources", ["sky", ["sky"], [3], ("sun", 4)])
def test_what_is_no_source_is_refused(sources):
    with pytest.raises(quasimc.InputError, match="is not a source"):
        canopy().run(sources)


def test_a_source_may_be_a_dict():
    stated = {"type": "uniform_sky", "irradiance_horizontal": 100}
    light = canopy().run(stated, **FEW)["absorbed_flux"].values
    assert np.array_equal(light, canopy().run([stated], **FEW)["absorbed_flux"].values)


@pytest.mark.parametrize("key, options", [("all", {}), ("layer", {"layers": 2})])
def test_a_label_named_as_other_groups_is_refused(key, options):
    scene = canopy()
    scene.add_mesh(*leaves(1)[:2], material="leaf", organ=99, labels={key: "x"})
    with pytest.raises(quasimc.InputError, match="a label with the name of other groups"):
        scene.run(groups=[key], **options, **FEW)
    assert [g["by"] for g in scene.run(groups=["plant"], **FEW).groups.groups] == ["all", "plant"]
