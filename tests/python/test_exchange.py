"""Geometry and light as objects of trimesh, pyvista and pint, and geometry from them."""

import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy, leaves

SOURCE = Path(os.environ["QUASIMC_SOURCE_DIR"])


def empty():
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1)
    return scene


def test_scenes_go_to_trimesh_and_back():
    trimesh = pytest.importorskip("trimesh")
    scene = canopy()
    mesh = scene.to_trimesh()
    assert isinstance(mesh, trimesh.Trimesh) and len(mesh.faces) == 40
    assert mesh.area == pytest.approx(scene.organs.areas.sum())
    again = empty()
    again.add_trimesh(mesh, material="leaf")
    assert np.array_equal(again.organs.ids, scene.organs.ids)
    assert np.array_equal(again.organs.triangles(7), scene.organs.triangles(7))


def test_meshes_of_trimesh_become_one_organ_or_those_that_are_given():
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=1, radius=0.5)
    scene = empty()
    scene.add_trimesh(ball, material="leaf", name="ball")
    ball.apply_translation([2, 0, 0])
    scene.add_trimesh(ball, material="leaf", organ=np.arange(10, 10 + len(ball.faces)))
    assert len(scene.organs) == 1 + len(ball.faces)
    assert scene.organs.areas[0] == pytest.approx(ball.area)


def test_several_meshes_of_trimesh_are_refused_with_what_to_do():
    trimesh = pytest.importorskip("trimesh")
    both = trimesh.Scene([trimesh.creation.box(), trimesh.creation.icosphere()])
    with pytest.raises(TypeError, match="add each mesh"):
        empty().add_trimesh(both, material="leaf")


def test_scenes_go_to_pyvista_and_back():
    pyvista = pytest.importorskip("pyvista")
    scene = canopy()
    mesh = scene.to_pyvista()
    assert isinstance(mesh, pyvista.PolyData) and mesh.n_cells == 40
    assert mesh.area == pytest.approx(scene.organs.areas.sum())
    assert list(mesh.cell_data["label_plant"]) == ["1"] * 40
    again = empty()
    again.add_pyvista(mesh, material="leaf")
    assert np.array_equal(again.organs.ids, scene.organs.ids)
    assert np.allclose(again.organs.areas, scene.organs.areas)


def test_data_sets_of_pyvista_give_their_surface():
    pyvista = pytest.importorskip("pyvista")
    scene = empty()
    scene.add_pyvista(pyvista.ImageData(dimensions=(3, 3, 3)), material="leaf")
    plane = pyvista.Plane(center=(0, 0, 5), i_resolution=2, j_resolution=2)
    scene.add_pyvista(plane, material="leaf")
    assert np.allclose(scene.organs.areas, [24, 1])


def test_results_for_pyvista_have_light_and_errors_on_cells():
    pytest.importorskip("pyvista")
    result = canopy().run(**FEW)
    mesh = result.to_pyvista()
    light = result["absorbed_flux"]["NIR"]
    for row in (0, 11):
        own = mesh.cell_data["organ"] == result.organs.ids[row]
        assert np.count_nonzero(own) == 2
        assert np.all(mesh.cell_data["absorbed_flux_NIR"][own] == light.values[row])
        assert np.all(mesh.cell_data["absorbed_flux_NIR_se"][own] == light.standard_error[row])
    assert {"incident_upper_PAR", "sunlit_fraction", "name"} <= set(mesh.cell_data.keys())


def test_objects_of_another_kind_are_refused():
    for add in (empty().add_trimesh, empty().add_pyvista):
        with pytest.raises(TypeError):
            add(leaves(1)[0], material="leaf")


def test_estimates_are_quantities_of_pint():
    pint = pytest.importorskip("pint")
    light = canopy().run(**FEW)["incident_upper"]["PAR"]
    registry = pint.UnitRegistry()
    values, errors = light.to_pint(registry)
    assert values.units == errors.units == registry.watt / registry.metre**2
    assert values.to("kW/m^2").magnitude == pytest.approx(light.values / 1000)
    assert np.array_equal(values.magnitude, light.values)
    assert np.array_equal(errors.magnitude, light.standard_error)
    assert light.with_unit("umol m-2 s-1").to_pint()[0].to("mol/m^2/hour").magnitude == pytest.approx(
        light.values * 3600e-6
    )
    with pytest.raises(ValueError, match="with_unit"):
        light.with_unit("5 mol").to_pint()


@pytest.mark.parametrize("package", ["trimesh", "pyvista", "pint", "pandas", "xarray", "matplotlib"])
def test_a_missing_package_is_named(package, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    for module in [name for name in sys.modules if name.startswith("matplotlib.")]:
        monkeypatch.delitem(sys.modules, module)
    scene = canopy()
    result = scene.run(**FEW)
    call = {
        "trimesh": scene.to_trimesh,
        "pyvista": scene.to_pyvista,
        "pint": lambda: result["incident_upper"]["PAR"].to_pint(),
        "pandas": result.to_pandas,
        "xarray": result.to_xarray,
        "matplotlib": result.plot.profile,
    }[package]
    with pytest.raises(ImportError, match=f"^{package} is missing; install it: pip install {package}$"):
        call()


def test_the_extras_are_those_of_the_guide():
    guide = (SOURCE / "docs" / "guide" / "install.md").read_text("utf-8")
    project = (SOURCE / "pyproject.toml").read_text("utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| ([\w, ]+) \|", guide, flags=re.M))
    section = project[project.index("[project.optional-dependencies]") : project.index("[tool.scikit-build]")]
    extras = dict(re.findall(r"^(\w+) = \[(.*)\]$", section, flags=re.M))
    assert extras.pop("all") == f'"quasimc[{",".join(extras)}]"'
    assert {name: text.replace('"', "") for name, text in extras.items()} == rows
