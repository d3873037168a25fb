"""Results as files, pictures and pickles."""

import copy
import json
import multiprocessing
import os
import pickle
import subprocess
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy

PROGRAM = os.environ.get("QUASIMC_PROGRAM", "")
needs_program = pytest.mark.skipif(not PROGRAM, reason="the program was not built")


def same_light(a, b):
    for quantity in a:
        np.testing.assert_array_equal(a[quantity]._values, b[quantity]._values)


@pytest.fixture(scope="module")
def result():
    return canopy().run(
        **FEW, groups=["plant"], layers=2, ratios=["PAR:NIR"], origins=["sun", "sky"], audit=0.5
    )


def test_json_is_read_back_whole(result, tmp_path):
    path = result.save(tmp_path / "light.json")
    back = quasimc.open(path)
    assert back == result and not back.has_replicates
    same_light(back, result)
    same_light(back.groups, result.groups)
    same_light(back.ground, result.ground)
    assert back.run.method == result.run.method and back.run.paths == 1024
    assert back.run.audit["p_value"] == result.run.audit["p_value"]
    for name in ("budget", "canopy"):
        for part, light in getattr(result, name).items():
            same = getattr(back, name)[part]
            np.testing.assert_array_equal(same.values, light.values)
            np.testing.assert_array_equal(same.standard_error, light.standard_error)
    np.testing.assert_array_equal(back.ratios["PAR:NIR"].values, result.ratios["PAR:NIR"].values)
    part = back["absorbed_flux"].origin("sky")
    np.testing.assert_array_equal(part.values, result["absorbed_flux"].origin("sky").values)
    assert back.organs.labels == result.organs.labels
    np.testing.assert_array_equal(back.organs.triangles(3), result.organs.triangles(3))
    again = back.save(tmp_path / "again.json")
    assert again.read_bytes() == path.read_bytes()


@needs_program
def test_the_program_repeats_a_saved_result(result, tmp_path):
    path = result.save(tmp_path / "light.json")
    said = subprocess.run(
        [PROGRAM, "run", "--repeat", path, "--json", tmp_path / "again.json"],
        capture_output=True,
        text=True,
    )
    assert said.returncode == 0, said.stderr
    again = json.loads((tmp_path / "again.json").read_text())
    assert again["organs_sha256"] == json.loads(path.read_text())["organs_sha256"]


def test_scenes_of_all_kinds_are_saved(tmp_path):
    scene = canopy(5)
    (tmp_path / "leaf.obj").write_text("v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n")
    scene.add_file(tmp_path / "leaf.obj", material="leaf", first_id=100)
    scene.add_organ("disk", material="leaf", center=[0, 0, 3], normal=[0, 0, 1], radius=0.1)
    scene.add_mesh([[[0, 0, 2.5], [1, 0, 2.5], [0, 1, 2.5]]], material="soil", name="flag",
                   labels={"kind": "flag"}, measured=True)
    result = scene.run(**FEW, groups=["kind"])
    back = quasimc.open(result.save(tmp_path / "all.json"))
    ids = result.organs.ids
    assert sorted(back.organs.ids) == sorted(ids)
    light = back["incident_upper"].at(ids.tolist())
    np.testing.assert_array_equal(light.values, result["incident_upper"].values)
    assert back.organs.names[back.organs.index_of("flag")] == "flag"
    np.testing.assert_array_equal(
        back.groups["absorbed_flux"].at("flag").values,
        result.groups["absorbed_flux"].at("flag").values,
    )


def test_a_table_is_saved_as_csv(result, tmp_path):
    text = result.save(tmp_path / "light.csv").read_text()
    rows = [line for line in text.splitlines() if not line.startswith("#")]
    assert len(rows) == 22 and rows[0].startswith("id,")
    value = float(rows[1].split(",")[rows[0].split(",").index("absorbed_flux_PAR")])
    assert value == result["absorbed_flux"]["PAR"].values[0]


@needs_program
@pytest.mark.parametrize("ending, begins", [("vtp", b"<?xml"), ("glb", b"glTF"), ("ply", b"ply")])
def test_scenes_with_light_are_saved(result, tmp_path, ending, begins):
    assert result.save(tmp_path / f"light.{ending}").read_bytes().startswith(begins)


def test_files_that_fail_are_not_left(result, tmp_path):
    with pytest.raises(ValueError, match="light.doc: ends in '.doc' .*; use .json, .csv"):
        result.save(tmp_path / "light.doc")
    with pytest.raises(OSError):
        result.save(tmp_path / "missing" / "light.json")
    assert not list(tmp_path.iterdir())
    (tmp_path / "no.json").write_text("{}")
    with pytest.raises(quasimc.InputError):
        quasimc.open(tmp_path / "no.json")


@needs_program
def test_pictures_are_drawn_by_the_program(result, tmp_path):
    picture = result.picture(tmp_path / "a.png", "incident_upper", "NIR", size=(320, 240))
    assert picture.size == (320, 240) and picture.pixels.shape == (240, 320, 4)
    assert len(np.unique(picture.pixels.reshape(-1, 4), axis=0)) > 20
    assert (tmp_path / "a.png").read_bytes() == picture._repr_png_()
    errors = result.picture(error=True, size=(320, 240))
    assert errors != picture and result.picture(minus=result, size=(320, 240)) != picture
    with pytest.raises(quasimc.Error, match="camera"):
        result.picture(camera="nowhere")
    bare = canopy().picture(size=(320, 240))
    leaf = quasimc.Scene("PAR").add_material("leaf", 0.1)
    leaf.add_mesh([[[0, 0, 1], [1, 0, 1], [0, 1, 1]]], material="leaf")
    assert leaf.picture(size=(64, 48)).size == (64, 48), "without any light"
    assert bare.size == (320, 240) and canopy().picture(label="plant", size=(320, 240)) != bare


@needs_program
def test_a_report_is_one_page(result, tmp_path):
    pytest.importorskip("numpy")
    try:
        page = result.report(tmp_path / "light.html").read_text()
    except quasimc.Error as error:
        pytest.skip(f"built without the page: {error}")
    assert page.lstrip().lower().startswith("<!doctype html")


@pytest.mark.parametrize("keep", ["auto", "estimates"])
def test_results_are_pickled(keep):
    result = canopy().run(**FEW, groups=["plant"], origins=["sun", "sky"], keep=keep)
    back = pickle.loads(pickle.dumps(result))
    assert back == result and back.has_replicates == result.has_replicates
    same_light(back, result)
    same_light(back.groups, result.groups)
    assert back.run.solve_seconds == result.run.solve_seconds
    if keep == "auto":
        ours, theirs = (r["absorbed_flux"]["PAR"][:7].sum() for r in (result, back))
        assert ours._values.tolist() == theirs._values.tolist()
        assert pickle.loads(pickle.dumps(back)) == result
    assert copy.deepcopy(result) == result
    assert result != canopy().run(**{**FEW, "seed": 9})


def test_scenes_and_sources_are_pickled():
    scene = canopy()
    back = pickle.loads(pickle.dumps(scene))
    assert back == scene and back.run(**FEW) == scene.run(**FEW)
    back.add_material("leaf", reflectance=[0.2, 0.2])
    assert back != scene
    sun = quasimc.sun(azimuth_deg=1, elevation_deg=2, irradiance_facing=3)
    assert pickle.loads(pickle.dumps(sun)) == sun


def light_of(seed):
    return canopy().run(**FEW, seed=seed, threads=1)


def test_results_come_from_other_processes():
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        results = list(pool.map(light_of, [1, 2]))
    for seed, result in zip((1, 2), results):
        assert result == light_of(seed)
    difference = results[0]["absorbed_flux"]["PAR"].sum() - results[1]["absorbed_flux"]["PAR"].sum()
    assert difference.standard_error > 0


def part_of(index):
    options = {"paths": 1024, "replicates": 4, "threads": 1, "origins": ["sun"], "groups": ["plant"]}
    return canopy().part(index, 3, **options)


def test_parts_of_other_processes_are_the_run_bit_for_bit():
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        parts = list(pool.map(part_of, range(3)))
    merged = quasimc.merge(reversed(parts))
    whole = canopy().run(paths=1024, replicates=4, origins=["sun"], groups=["plant"])
    assert merged == whole and merged.run.method == whole.run.method
    assert merged.run.rays == whole.run.rays
    same_light(merged.groups, whole.groups)
    ours, theirs = (r["absorbed_flux"].origin("other")[:5].sum() for r in (merged, whole))
    assert ours._values.tolist() == theirs._values.tolist()
    for wrong in (parts[:2], [*parts, parts[0]], []):
        with pytest.raises(ValueError):
            quasimc.merge(wrong)
    with pytest.raises(ValueError):
        quasimc.merge([parts[0], canopy().part(1, 3, paths=512), parts[2]])


def test_parts_that_can_not_be_are_refused():
    with pytest.raises(ValueError, match="no part 3 of 3: they are 0 to 2"):
        canopy().part(3, 3)
    with pytest.raises(ValueError, match="give paths"):
        canopy().part(0, 3, target_error=0.1)


def test_text_says_something(result):
    assert repr(result).startswith("<Result: 20 organs, PAR, NIR; absorbed PAR 82.1 ± 0.4 W")
    assert repr(result.run).startswith("<from organs, 1,024 paths x 4")
    assert "20 organs" in repr(result.organs) and repr(canopy()) == (
        "<Scene 'scene': 1 meshes; PAR, NIR; not built>"
    )
    assert repr(result.groups) == "<Groups by all, plant, layer: 4>"
