import copy
import warnings

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy, leaves

SKY = quasimc.uniform_sky(irradiance_horizontal=100)


def scene_of_material():
    return quasimc.Scene("PAR").add_material("leaf", reflectance=0.1, transmittance=0.05)


def test_organs_of_a_mesh_come_in_the_order_of_their_ids():
    vertices, faces, organ = leaves(3)
    mixed = [5, 0, 3, 1, 4, 2]
    scene = scene_of_material().add_mesh(
        vertices,
        faces[mixed],
        organ=organ[mixed],
        material="leaf",
        name={1: "a", 2: "b", 3: "c"},
        labels={"kind": "leaf", "plant": {1: 7, 2: 8, 3: 9}},
    )
    organs = scene.organs
    assert organs.ids.tolist() == [1, 2, 3]
    assert organs.names == ["a", "b", "c"]
    assert organs.labels == {"kind": ["leaf"] * 3, "plant": ["7", "8", "9"]}
    sides = [vertices[faces[:, k]] - vertices[faces[:, 0]] for k in (1, 2)]
    areas = np.linalg.norm(np.cross(*sides), axis=1) / 2
    assert np.allclose(organs.areas, areas.reshape(3, 2).sum(axis=1), rtol=1e-12)


def test_the_order_of_faces_changes_no_bit():
    vertices, faces, organ = leaves(10)
    straight = scene_of_material().add_mesh(vertices, faces, organ=organ, material="leaf")
    order = np.argsort(-organ, kind="stable")
    turned = scene_of_material().add_mesh(
        vertices, faces[order], organ=organ[order], material="leaf"
    )
    a, b = (scene.run(SKY, **FEW) for scene in (straight, turned))
    assert np.array_equal(a["absorbed_flux"].values, b["absorbed_flux"].values)


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint32, np.uint8])
def test_faces_of_every_type_of_integer_are_the_same(dtype):
    vertices, faces, organ = leaves(4)
    flat = scene_of_material().add_mesh(vertices[faces], organ=organ, material="leaf")
    scene = scene_of_material().add_mesh(
        vertices, faces.astype(dtype), organ=organ.astype(dtype), material="leaf"
    )
    a, b = (s.run(SKY, **FEW)["absorbed_flux"].values for s in (flat, scene))
    assert np.array_equal(a, b) and np.all(a > 0)


TRIANGLE = np.array([[0, 0, 1], [0.1, 0, 1], [0, 0.1, 1.0]])


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint32])
def test_later_writes_to_arrays_change_nothing(dtype):
    vertices = TRIANGLE.copy()
    faces = np.array([[0, 1, 2]], dtype=dtype)
    corners = 2 * vertices
    reflectance = np.array([0.1])
    irradiance = np.array([100.0])
    scene = quasimc.Scene("PAR").add_material("leaf", reflectance=reflectance)
    scene.add_mesh(vertices, faces, material="leaf")
    scene.add_mesh(memoryview(vertices[None] + 1), material="leaf")
    scene.add_organ("triangle", corners=corners, material="leaf")
    scene.sources.append(quasimc.Source("uniform_sky", irradiance_horizontal=irradiance))
    before = scene.run(**FEW)
    for array in (vertices, faces, corners, reflectance, irradiance):
        array *= 0
    scene.add_material("soil", reflectance=0.1)
    after = scene.run(**FEW)
    assert np.allclose(before.organs.areas, [0.02, 0.005, 0.005])
    assert np.array_equal(after.organs.areas, before.organs.areas)
    assert np.array_equal(after["absorbed_flux"].values, before["absorbed_flux"].values)


@pytest.mark.parametrize(
    "change, words",
    [
        ({"material": "leef"}, "did you mean 'leaf'"),
        ({"faces": [[0, 1, 3]]}, "face 0 refers to vertex 3"),
        ({"faces": [[0, 1, -1]]}, "face 0 refers to vertex -1"),
        ({"vertices": TRIANGLE + [0, np.nan, 0]}, "coordinates must be finite"),
        ({"vertices": TRIANGLE + [0, np.inf, 0]}, "coordinates must be finite"),
        ({"organ": 7}, "id 7"),
    ],
)
def test_a_faulty_mesh_is_refused_at_the_call_and_leaves_the_scene_as_it_was(change, words):
    scene = scene_of_material().add_mesh(TRIANGLE, [[0, 1, 2]], organ=7, material="leaf", name="a")
    before = scene.run(SKY, **FEW)
    mesh = {"vertices": TRIANGLE, "faces": [[0, 1, 2]], "material": "leaf", **change}
    with pytest.raises(quasimc.InputError, match=words):
        scene.add_mesh(**mesh)
    if "organ" not in change:
        with pytest.raises(quasimc.InputError, match=words):
            scene.replace("a", **mesh)
    after = scene.run(SKY, **FEW)
    assert np.array_equal(after["absorbed_flux"].values, before["absorbed_flux"].values)


def test_a_faulty_material_is_refused_at_the_call_and_leaves_the_scene_as_it_was():
    scene = scene_of_material().add_mesh(TRIANGLE, [[0, 1, 2]], material="leaf")
    before = scene.run(SKY, **FEW)
    with pytest.raises(quasimc.InputError, match="leaf.*exceeds 1"):
        scene.add_material("leaf", reflectance=0.9, transmittance=0.3)
    with pytest.raises(quasimc.InputError, match="3 values"):
        scene.add_material("leaf", reflectance=[0.1, 0.2, 0.3])
    after = scene.run(SKY, **FEW)
    assert np.array_equal(after["absorbed_flux"].values, before["absorbed_flux"].values)


def test_materials_may_come_after_their_meshes():
    scene = quasimc.Scene("PAR").add_mesh(TRIANGLE, [[0, 1, 2]], material="leaf")
    scene.add_material("leaf", reflectance=0.1)
    assert len(scene.organs) == 1


def test_what_was_added_is_removed_and_replaced_by_its_name():
    scene = scene_of_material()
    scene.add_mesh(TRIANGLE, [[0, 1, 2]], material="leaf", name="first")
    scene.add_mesh(TRIANGLE + 1, [[0, 1, 2]], material="leaf", name="second")
    scene.add_organ("triangle", corners=TRIANGLE + 2, material="leaf", name="third")
    scene.sources.append(quasimc.Source("uniform_sky", irradiance_horizontal=100, name="dim"))
    scene.sources.append(quasimc.Source("uniform_sky", irradiance_horizontal=300, name="bright"))
    scene.replace("first", 2 * TRIANGLE, [[0, 1, 2]], material="leaf")
    assert scene.organs.names == ["third", "first", "second"]
    assert np.allclose(scene.organs.areas, [0.005, 0.02, 0.005])
    scene.remove("third").remove("second")
    assert scene.organs.names == ["first"]
    both = scene.run(**FEW)["incident_upper"]["PAR"].values[0]
    one = scene.remove("bright").run(**FEW)["incident_upper"]["PAR"].values[0]
    assert both == pytest.approx(400, rel=0.05) and one == pytest.approx(100, rel=0.05)
    for call in (scene.remove, lambda name: scene.replace(name, TRIANGLE[None], material="leaf")):
        with pytest.raises(quasimc.InputError, match="'frist'.*did you mean 'first'"):
            call("frist")
    assert scene.organs.names == ["first"]


@pytest.mark.parametrize(
    "add",
    [
        lambda scene: scene.add_mesh(TRIANGLE, [[0, 1, 2]], material="leaf"),
        lambda scene: scene.add_mesh(
            TRIANGLE + np.random.default_rng().uniform(0, 1), [[0, 1, 2]], material="leaf", name="a"
        ),
        lambda scene: scene.add_organ("triangle", corners=TRIANGLE, material="leaf"),
        lambda scene: scene.sources.append(SKY),
        lambda scene: scene.add_detector("escaped_by_zenith"),
    ],
)
def test_a_cell_of_a_notebook_that_runs_twice_warns(add):
    scene = scene_of_material()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        add(scene)
    twin = copy.copy(scene)
    for each in (scene, twin):
        with pytest.warns(quasimc.QuasimcWarning, match="already has .* and now has both"):
            add(each)


def test_names_that_many_share_are_warned_of_once():
    scene = scene_of_material()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for x in range(5):
            scene.add_mesh(TRIANGLE + [x, 0, 0], [[0, 1, 2]], material="leaf", name="leaf")
            scene.add_organ("triangle", corners=TRIANGLE + [x, 1, 0], material="leaf", name="blade")
    assert len(caught) == 1 and "of the name 'leaf'" in str(caught[0].message)


def test_a_source_keeps_the_numbers_that_it_was_given():
    power = np.array([100.0])
    source = quasimc.sky(irradiance_horizontal=power)
    power[0] = 1
    assert source.irradiance_horizontal == [100.0]


def test_numbers_beyond_all_vertices_are_refused_as_they_stand():
    vertices, faces, _ = leaves(1)
    faces = faces.astype(np.uint32)
    faces[0, 0] = 2**32 - 1
    with pytest.raises(quasimc.InputError, match="vertex 4294967295"):
        scene_of_material().add_mesh(vertices, faces, material="leaf").run(SKY, **FEW)


def test_faces_of_one_organ_may_have_materials_of_their_own():
    scene = quasimc.Scene("PAR")
    scene.add_material("black", reflectance=0)
    scene.add_material("white", reflectance=1)
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    scene.add_mesh(square, [[0, 1, 2], [0, 2, 3]], material=["black", "white"])
    scene.add_mesh(square + [0, 0, -1e-3], [[0, 1, 2], [0, 2, 3]], organ=[8, 9],
                   material={8: "black", 9: "white"})
    beam = quasimc.directional(direction=[0, 0, -1], irradiance_facing=100)
    result = scene.run(beam, paths=4096)
    absorbed = result["absorbed_flux"]["PAR"]
    assert sorted(result.organs.ids.tolist())[-2:] == [8, 9] and len(result.organs) == 3
    assert absorbed.values[0] == pytest.approx(50, abs=1e-3)


def test_organs_of_shapes_files_and_meshes_stand_together(tmp_path):
    (tmp_path / "leaf.obj").write_text("v 0 0 2\nv 1 0 2\nv 0 1 2\ng blade\nf 1 2 3\n")
    scene = scene_of_material()
    scene.add_mesh([[0, 0, 3], [1, 0, 3], [0, 1, 3]], [[0, 1, 2]], material="leaf", name="mesh")
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1,
                    name="disk")
    scene.add_file(tmp_path / "leaf.obj", material="leaf")
    assert scene.organs.names == ["disk", "blade", "mesh"]


def test_organs_without_an_id_take_none_that_is_stated():
    scene = scene_of_material()
    scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=0.1)
    scene.add_mesh([[0, 0, 3], [1, 0, 3], [0, 1, 3]], [[0, 1, 2]], organ=1, material="leaf")
    assert scene.organs.ids.tolist() == [2, 1]


def test_a_scene_can_be_changed_after_a_run():
    scene = canopy()
    before = scene.run(**FEW)["absorbed_flux"]["PAR"].values
    scene.add_material("leaf", reflectance=0.5, transmittance=0.4)
    after = scene.run(**FEW)["absorbed_flux"]["PAR"].values
    assert np.all(after < before)
    assert scene._simulator.builds == 1  # the triangles are the same
    scene.add_mesh([[0, 0, 3], [1, 0, 3], [0, 1, 3]], [[0, 1, 2]], material="leaf", name="new")
    assert len(scene.run(**FEW).organs) == 21


def test_a_scene_repeats_in_its_cell():
    scene = canopy()
    scene.ground = quasimc.Ground("soil")
    scene.cell = quasimc.Cell(x=[0, 1], y=[0, 1])
    result = scene.run(**FEW)
    parts = [result.canopy[key]["PAR"] for key in ("reflectance", "absorptance", "ground_absorptance")]
    error = sum(part.standard_error for part in parts)
    assert error < 1e-2
    assert sum(part.values for part in parts) == pytest.approx(1, abs=5 * error)


def test_bands_may_have_units_of_their_own():
    scene = quasimc.Scene({"PAR": "umol m-2 s-1", "NIR": "W m-2"}, length_unit="cm")
    scene.add_material("leaf", reflectance={"PAR": 0.1, "NIR": 0.4})
    scene.add_mesh([[0, 0, 3], [1, 0, 3], [0, 1, 3]], [[0, 1, 2]], material="leaf")
    light = scene.run(quasimc.sky(irradiance_horizontal=[2000, 300]), **FEW)
    assert light["incident_upper"]["PAR"].unit == "umol m-2 s-1"
    assert light["absorbed_flux"].units == {"PAR": "1e-4 umol s-1", "NIR": "1e-4 W"}


def test_a_scene_is_loaded_from_a_run_file(tmp_path):
    (tmp_path / "leaf.toml").write_text(
        'bands = ["PAR"]\n[run]\npaths = 512\n[[source]]\ntype = "uniform_sky"\n'
        'irradiance_horizontal = 100\n[[material]]\nname = "leaf"\nreflectance = 0.1\n'
        '[[organ]]\nmaterial = "leaf"\nshape = "disk"\ncenter = [0, 0, 1]\nnormal = [0, 0, 1]\n'
        'radius = 0.1\n[output]\ncsv = "leaf.csv"\n'
    )
    scene = quasimc.load(tmp_path / "leaf.toml")
    assert scene.run().run.paths == 512
    assert scene.run(paths=256).run.paths == 256
    assert scene.run(SKY, paths=128).run.paths == 128
    assert not (tmp_path / "leaf.csv").exists()


DAY = """
bands = ["PAR"]
[run]
paths = 64
[site]
latitude_deg = 52
longitude_deg = 5.67
[[material]]
name = "leaf"
reflectance = 0.1
[[organ]]
material = "leaf"
shape = "disk"
center = [0, 0, 1]
normal = [0, 0, 1]
radius = 0.1
[time]
day = "2024-06-21"
utc_offset_hours = 1
hours = [11, 13]
"""


def test_passed_sources_replace_the_times_of_a_scene_that_was_loaded(tmp_path):
    (tmp_path / "day.toml").write_text(DAY)
    scene = quasimc.load(tmp_path / "day.toml")
    assert scene.time == quasimc.day("2024-06-21", utc_offset_hours=1, hours=[11, 13])
    assert len(scene.series()) == 2
    with pytest.raises(ValueError, match="use scene.series"):
        scene.run()
    sun = quasimc.sun(azimuth_deg=180, elevation_deg=60, irradiance_facing=1500)
    result = scene.run([sun], paths=64)
    expected = 1500 * np.sin(np.radians(60))
    assert result["incident_upper"]["PAR"].values[0] == pytest.approx(expected, rel=1e-3)
    hour = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[12, 13])
    series = scene.series(hour, sun)
    assert len(series) == 1
    assert series[0]["incident_upper"]["PAR"].values[0] > expected + 1
    assert len(scene.series()) == 2, "the scene is as it was"
    with pytest.raises(quasimc.KeywordError, match="scene.series"):
        scene.run(sun, time=hour)


def test_lists_go_by_the_order_in_which_organs_appear():
    triangles = np.zeros((4, 3, 3)) + [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
    triangles[:, :, 2] += np.arange(4)[:, None]
    scene = scene_of_material()
    scene.add_mesh(
        triangles,
        organ=[5, 3, 5, 9],
        material="leaf",
        name=["five", "three", "nine"],
        labels={"k": np.array(["of 5", "of 3", "of 9"]), "d": {3: "c", 5: "e", 9: "i"}},
    )
    assert scene.organs.ids.tolist() == [3, 5, 9]
    assert scene.organs.names == ["three", "five", "nine"]
    assert scene.organs.labels == {"k": ["of 3", "of 5", "of 9"], "d": ["c", "e", "i"]}
    assert scene.organs.areas.tolist() == [0.5, 1.0, 0.5]


def test_files_are_those_of_the_folder_in_which_they_were_added(tmp_path, monkeypatch):
    scene = scene_of_material()
    (tmp_path / "leaf.obj").write_text("v 0 0 2\nv 1 0 2\nv 0 1 2\ng blade\nf 1 2 3\n")
    monkeypatch.chdir(tmp_path)
    scene.add_file("leaf.obj", material="leaf")
    monkeypatch.chdir("/")
    assert scene.organs.names == ["blade"]


def test_a_sweep_is_left_to_the_program(tmp_path):
    (tmp_path / "sweep.toml").write_text(
        'bands = ["PAR"]\n[[material]]\nname = "leaf"\nreflectance = 0.1\n'
        "[sweep]\n\"run.seed\" = [1, 2]\n"
    )
    with pytest.raises(quasimc.InputError, match=r"sweep.toml:5: \[sweep\] describes several runs"):
        quasimc.load(tmp_path / "sweep.toml")


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_is_a_scene_of_its_own(copied):
    scene = canopy()
    before = scene.run(**FEW)["absorbed_flux"].values
    other = copied(scene)
    assert np.array_equal(other.run(**FEW)["absorbed_flux"].values, before)
    vertices = [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]]
    other.add_mesh(np.array(vertices), material="leaf")
    other.add_material("leaf", reflectance=[0.9, 0.1])
    scene.add_material("unused", reflectance=[0.1, 0.1])
    assert np.array_equal(scene.run(**FEW)["absorbed_flux"].values, before)
    assert len(other.organs) == len(scene.organs) + 1


def test_labels_must_be_a_dict():
    with pytest.raises(quasimc.InputError, match="labels is of the type list"):
        canopy().add_mesh(np.zeros((1, 3, 3)), material="leaf", labels=["a"])


def test_calls_cost_the_same_however_much_was_added(tmp_path, monkeypatch):
    (tmp_path / "leaf.obj").write_text("v 0 0 2\nv 1 0 2\nv 0 1 2\ng blade\nf 1 2 3\n")
    scene = scene_of_material().add_file(tmp_path / "leaf.obj", material="leaf", first_id=100)
    materials = []
    monkeypatch.setattr(quasimc._core, "Frame", counted(quasimc._core.Frame, materials))
    for i in range(20):
        scene.add_mesh(TRIANGLE + i, [[0, 1, 2]], organ=[i + 1], material="leaf", name=f"leaf {i}")
    assert len(materials) == 1
    seen = []
    monkeypatch.setattr(quasimc._scene_meshes, "ids_of", counted(quasimc._scene_meshes.ids_of, seen))
    monkeypatch.setattr(quasimc._scene_meshes, "marks_of", counted(quasimc._scene_meshes.marks_of, seen))
    scene.replace("leaf 3", TRIANGLE + 30, [[0, 1, 2]], organ=[4], material="leaf")
    assert len(materials) == 1 and len(seen) < 10  # of 20 meshes
    for i in range(5):
        scene.add_material(f"other {i}", reflectance=0.1)
    assert [len(document.table()["material"]) for document in materials[1:]] == [1] * 5
    assert len(scene.organs) == 21


def counted(function, calls):
    """The function, which notes its last argument at each call."""

    def call(*arguments):
        calls.append(arguments[-1])
        return function(*arguments)

    return call


def test_numbers_of_meshes_are_not_given_twice():
    scene = scene_of_material()
    for name in "ab":
        scene.add_mesh(TRIANGLE, [[0, 1, 2]] if name == "a" else [[1, 2, 0]], material="leaf", name=name)
    scene.remove("a")
    with pytest.raises(quasimc.InputError, match="mesh 3: "):
        scene.add_mesh(TRIANGLE, [[0, 1, 3]], material="leaf")


def test_files_organs_and_lamps_have_copies(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plot.csv").write_text("x,y,tree\n0,0,7\n3,0,8\n")
    (tmp_path / "trees.obj").write_text(
        "v 0 0 1\nv 1 0 1\nv 0 1 1\no layer1\ng leaf1\nf 1 2 3\no layer2\ng leaf1\nf 3 2 1\n"
    )
    scene = scene_of_material()
    scene.add_file(
        "trees.obj",
        material="leaf",
        at={"file": "plot.csv"},
        labels_from="layer{story}",
        measured=False,
    )
    scene.add_organ(
        "disk",
        material="leaf",
        center=[0, 0, 2],
        normal=[0, 0, 1],
        radius=0.2,
        at=[{"x": 0, "y": 0, "tilt_deg": 90, "row": 1}, {"x": np.float64(2), "y": 5, "row": 2}],
    )
    monkeypatch.chdir("/")
    organs = scene.organs
    assert len(organs.ids) == 6
    assert organs.labels["row"] == ["1", "2", "", "", "", ""]
    assert organs.labels["tree"] == ["", "", "7", "7", "8", "8"]
    assert organs.labels["story"] == ["", "", "1", "2", "1", "2"]
    lamp = quasimc.lamp(
        "point",
        name="hps",
        power=4,
        at={"start": [0, 0, 5], "along": [4, 0, 0], "counts": 2},
    )
    result = scene.run(
        [lamp],
        **FEW,
        groups=["row+layer", {"name": "top", "by": "row", "where": "height > 1.5 and row in [1, 2]"}],
        layer_heights=[0, 3],
    )
    groups = [(g["by"], g["labels"]) for g in result.groups.groups]
    assert ("top", {"row": "2"}) in groups
    shares = result.groups["fraction_absorbed"]["PAR"].values
    assert shares[0] == pytest.approx(1)
    # The first disk is tilted about the origin, and so is not high.
    second = groups.index(("row+layer", {"row": "2", "layer": "1"}))
    top = groups.index(("top", {"row": "2"}))
    assert 0.3 < shares[top] < 0.9
    assert shares[top] == pytest.approx(shares[second])
    frame = result.groups.to_pandas()
    assert "fraction_incident_PAR_se" in frame
    with pytest.raises(quasimc.InputError, match="unknown label 'rov'"):
        scene.run([lamp], **FEW, groups=["row where rov == 1"])
