"""Plants that grow by models in cpfg's language."""

import json
import os
import pickle
import stat
import subprocess

import numpy as np
import pytest

import quasimc
from canopies import FEW

# A small leaf over a large one; the third query has no module with shapes.
TWO_LEAVES = """lsystem: 1
derivation length: 2
axiom: ?E(0)f(1)[^(90)?E(0,5)L]?E(7)f(1)[^(90)?E(0,5)U]
homomorphism
L --> @o(4)
U --> @o(2)
endlsystem
"""

ZENITH = quasimc.directional(direction=[0, 0, -1], irradiance_facing=100)


@pytest.fixture
def model(tmp_path):
    def write(text=TWO_LEAVES):
        path = tmp_path / "model.l"
        path.write_text(text)
        return path

    return write


def stand():
    scene = quasimc.Scene({"PAR": "umol m-2 s-1"}, length_unit="cm")
    return scene.add_material("leaf", reflectance=0).add_material("soil", reflectance=0)


def density(step, band="PAR"):
    light = step.light["absorbed_flux_density"][band].values
    return dict(zip(step.light.organs.labels["module"], light))


def test_a_model_without_light(model):
    path = model("lsystem: 1\nderivation length: 3\naxiom: A\nA --> F(1)[+A]A\nendlsystem\n")
    steps = list(quasimc.grow(path))
    assert [step.step for step in steps] == [0, 1, 2, 3]
    assert steps[0].string == "A" and steps[0].organs is None
    assert steps[2].string == "F(1)[+F(1)[+A]A]F(1)[+A]A"
    assert len(steps[2].organs) == 3 and steps[2].organs.labels["order"] == ["0", "1", "0"]
    assert steps[2].organs.triangles(0).shape[1:] == (3, 3)
    assert steps[2].light is None and steps[2].scene is None and steps[2].image is None
    assert len(list(quasimc.grow(path, steps=1))) == 2


def test_a_plant_in_a_stand(model):
    steps = list(quasimc.grow(model(), light=stand(), sources=ZENITH, **FEW))
    assert len(steps) == 3
    for step in steps:
        light = density(step)
        assert light["U"] == pytest.approx(100, abs=0.1)
        assert light["L"] == pytest.approx(75, abs=0.3)
    assert "?E(7)f(1)" in steps[1].string
    assert f"?E({density(steps[0])['L']:g},5)L" in steps[1].string
    assert steps[0].light.organs.labels["step"] == ["0", "0"]
    assert steps[0].light.organs.units == ("umol m-2 s-1",) and steps[0].scene.length_unit == "cm"


def test_the_light_is_that_of_a_scene_of_the_same_organs(model):
    first = next(quasimc.grow(model(), light=stand(), sources=ZENITH, seed=5, **FEW))
    alone = stand()
    for index, organ in enumerate(first.organs.ids):
        corners = first.organs.triangles(index)[..., [2, 0, 1]]  # z up
        alone.add_mesh(corners, material="leaf", organ=int(organ))
    expected = alone.run(ZENITH, seed=5, **FEW)
    assert np.array_equal(first.light._core.values, expected._core.values, equal_nan=True)


def test_the_light_of_a_step_is_saved(model, tmp_path):
    field = stand().add_material("grey", reflectance=0.5)
    field.add_organ("disk", material="soil", center=[0, 0, 0.1], normal=[0, 0, 1], radius=9)
    field.ground = quasimc.Ground("soil", x=[-20, 20], y=[-20, 20])
    options = {"materials": {"U": "grey"}, "groups": ["module"], "seed": 5, **FEW}
    for step in quasimc.grow(model(), light=field, sources=ZENITH, **options):
        path = step.light.save(tmp_path / f"{step.step}.json")
        back = quasimc.open(path)
        assert back == step.light and back.organs.labels == step.light.organs.labels
        moved = pickle.loads(pickle.dumps(step.light))
        assert moved == step.light
        assert moved.save(tmp_path / "moved.json").read_bytes() == path.read_bytes()
        document = json.loads(path.read_text())["run_file"]
        assert document["run"]["seed"] == 5 + step.step
        materials = {str(organ.get("labels", {}).get("module")): organ["material"] for organ in document["organ"]}
        assert materials == {"None": "soil", "U": "grey", "L": "leaf"}
        again = tmp_path / "again.json"
        program = os.environ.get("QUASIMC_PROGRAM")
        if program:
            subprocess.run([program, "run", "--repeat", path, "--json", again], check=True, capture_output=True)
            assert quasimc.open(again) == step.light


def test_materials_by_module(model):
    steps = quasimc.grow(
        model(),
        light=stand().add_material("grey", reflectance=0.5).add_material("U", reflectance=0.25),
        sources=ZENITH,
        materials={"L": "grey"},
        **FEW,
    )
    light = density(next(steps))
    assert 37 < light["L"] < 45  # half of the light on it, and some that the other leaf reflects
    assert 74.9 < light["U"] < 100
    with pytest.raises(quasimc.InputError, match="no material 'stem'"):
        quasimc.grow(model(), light=stand(), sources=ZENITH, material="stem")
    with pytest.raises(quasimc.InputError, match="symbol"):
        quasimc.grow(model(), light=stand(), sources=ZENITH, materials={"LL": "leaf"})
    with pytest.raises(quasimc.InputError, match="quantity"):
        quasimc.grow(model(), light=stand(), sources=ZENITH, quantity="light")


def test_a_stand_in_a_run_file(model, tmp_path):
    (tmp_path / "stand.toml").write_text(
        'bands = ["PAR"]\n[run]\npaths = 512\n[[material]]\nname = "leaf"\nreflectance = 0\n'
        '[[source]]\ntype = "directional"\ndirection = [0, 0, -1]\nirradiance_facing = 50\n'
    )
    first = next(quasimc.grow(model(), light=tmp_path / "stand.toml"))
    assert density(first)["U"] == pytest.approx(50, abs=0.5)
    scene = quasimc.Scene("PAR")
    scene.ground = quasimc.Ground("leaf", x=[-9, 9], y=[-9, 9])
    scene.add_material("leaf", reflectance=0)
    scene.add_mesh([[[8, 8, 8], [9, 8, 8], [8, 9, 8]]], material="leaf", organ=4)
    first = next(quasimc.grow(model(), light=scene, sources=ZENITH, **FEW))
    ids = first.light.organs.ids.tolist()
    assert ids[0] == 4 and ids[1:] == [4 + organ for organ in first.organs.ids]
    assert first.light.organs.has_ground and density(first)["L"] == pytest.approx(75, abs=1)


def test_a_specification(model, tmp_path):
    (tmp_path / "light.qmc").write_text("number of rays: 1024\nreturn type: D\n")
    path = model("lsystem: 1\nderivation length: 2\naxiom: ^(90)?E(1)P(1,1)\nendlsystem\n")
    first, second, last = quasimc.grow(path, light=tmp_path / "light.qmc")
    light = first.light["absorbed_flux_density"]
    value = float(light[first.light.bands[0]].values[0])
    assert value > 0 and second.string == f"^(90)?E({value:g})P(1,1)"
    assert last.step == 2 and last.light is not None


def test_a_specification_with_rays_of_each_band(model, tmp_path):
    (tmp_path / "light.qmc").write_text(
        "number of rays: 512\nspectrum samples: 2\nsource spectrum: 660 1 730 2\n"
        "one ray per spectrum: no\nreturn type: D\nleaf material (top): 0 0 0 0\n: 0 0 0 0\n"
    )
    path = model("lsystem: 1\nderivation length: 1\naxiom: ^(90)?E(1,1)P(1,1)\nendlsystem\n")
    red, far_red = next(quasimc.grow(path, light=tmp_path / "light.qmc")).light
    assert (red.bands, far_red.bands) == (("1: 660",), ("2: 730",))
    light = [r["absorbed_flux_density"][r.bands[0]].values[0] for r in (red, far_red)]
    assert 0 < light[0] < light[1]
    assert len(far_red.to_pandas()) == 1


def test_an_environment_program(model, tmp_path):
    program = tmp_path / "program"
    program.write_text(
        "#!/bin/sh\nprintf '\\001'\nwhile IFS= read -r line; do case \"$line\" in\n"
        "'Control: 8'*) printf 'Control: 5\\n\\001'; exit 0;;\n"
        "Control*) printf '0 E(4)\\nControl: 4\\n\\001';;\nesac; done\n"
    )
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    (tmp_path / "comm.e").write_text(f"communication type: pipes\nexecutable: {program}\n")
    path = model("lsystem: 1\nderivation length: 1\naxiom: ?E(1)P\nendlsystem\n")
    first, last = quasimc.grow(path, light=tmp_path / "comm.e")
    assert (first.string, last.string) == ("?E(1)P", "?E(4)P")
    assert first.light is None


def test_prints_and_errors_of_models(model, capsys):
    path = model(
        'lsystem: 1\nderivation length: 1\nStart: {printf("a number: %g\\n", 2);}\n'
        "axiom: A\nA --> B\nhomomorphism\nB --> F(2)\nendlsystem\n"
    )
    *_, last = quasimc.grow(path, image=True)
    assert last.image == "F(2)"
    assert "a number: 2" in capsys.readouterr().err
    with pytest.raises(quasimc.InputError, match="model.l:3"):
        quasimc.grow(model("lsystem: 1\nderivation length: 1\naxiom: A(\nendlsystem\n"))
    with pytest.raises(quasimc.InputError):
        quasimc.grow("no_such_file.l")
    for wrong in ({"steps": -1}, {"sources": ZENITH}, {"paths": 64}):
        with pytest.raises(quasimc.InputError, match="grow"):
            quasimc.grow(model(), **wrong)
    with pytest.raises(quasimc.InputError):
        next(quasimc.grow(model(), light=stand(), sources=ZENITH, pathes=64))


def test_the_view_file_beside_the_model_is_used(model, tmp_path):
    path = model("lsystem: 1\nderivation length: 0\naxiom: F(1)+F(1)\nendlsystem\n")
    (tmp_path / "model.v").write_text("angle factor: 4\n")
    (bent,) = quasimc.grow(path)
    (tmp_path / "other.v").write_text("angle factor: 2\n")
    (other,) = quasimc.grow(path, tmp_path / "other.v")
    assert not np.allclose(bent.organs.triangles(1), other.organs.triangles(1))


def test_an_error_of_progress_ends_the_growth(model):
    class Enough(Exception):
        pass

    def stop(progress):
        raise Enough

    steps = quasimc.grow(
        model(), light=stand(), sources=ZENITH, progress=stop, paths=1 << 18, replicates=8,
        method="light_tracing",
    )
    with pytest.raises(Enough):
        list(steps)
    assert list(steps) == []
