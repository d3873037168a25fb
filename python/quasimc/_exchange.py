"""Geometry and light as objects of other packages: trimesh, pyvista, pint."""

from __future__ import annotations

import numpy as np

from ._optional import needed
from ._units import factors_of

#: The array of cells, or attribute of faces, that has the ids of organs.
ORGAN = "organ"


def triangles_of(organs):
    """Triangles of all organs (m, 3, 3), and the position of the organ of each (m,)."""
    each = [organs.triangles(i) for i in range(len(organs))]
    triangles = np.concatenate([*each, np.zeros((0, 3, 3))])
    return triangles, np.repeat(np.arange(len(organs)), [len(own) for own in each])


def _indexed(triangles):
    """Vertices, each once, and the faces: arrays (n, 3) and (m, 3)."""
    vertices, corners = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return vertices, corners.reshape(-1, 3)


def to_trimesh(organs):
    """A trimesh.Trimesh with the face attribute "organ"."""
    trimesh = needed("trimesh")
    triangles, organ = triangles_of(organs)
    vertices, faces = _indexed(triangles)
    attributes = {ORGAN: organs.ids[organ]}
    metadata = {"length_unit": organs.length_unit}
    return trimesh.Trimesh(
        vertices, faces, process=False, face_attributes=attributes, metadata=metadata
    )


def to_pyvista(organs, columns=None):
    """A pyvista.PolyData; of each triangle organ, name, labels and the values of its organ.

    @param columns: name -> one value for each organ
    """
    pyvista = needed("pyvista")
    triangles, organ = triangles_of(organs)
    vertices, faces = _indexed(triangles)
    mesh = pyvista.PolyData(vertices, np.insert(faces, 0, 3, axis=1).ravel())
    texts = {"name": organs.names, **{f"label_{key}": v for key, v in organs.labels.items()}}
    for name, values in {ORGAN: organs.ids, **texts, **(columns or {})}.items():
        mesh.cell_data[name] = np.asarray(values)[organ]
    mesh.field_data["length_unit"] = [organs.length_unit]
    return mesh


def of_trimesh(mesh):
    """Vertices, faces, and the organs of the faces or None."""
    if not hasattr(mesh, "faces"):
        raise TypeError(
            f"mesh: {type(mesh).__name__} has no faces (it must be one trimesh.Trimesh); "
            "of a trimesh.Scene add each mesh, or scene.to_mesh()"
        )
    organ = getattr(mesh, "face_attributes", {}).get(ORGAN)
    return np.array(mesh.vertices, float), np.array(mesh.faces, np.int64), organ


def of_pyvista(mesh):
    """Vertices, faces, and the organs of the faces or None. Polygons are divided into triangles."""
    if not hasattr(mesh, "cell_data"):
        raise TypeError(f"mesh: {type(mesh).__name__} has no cells (it must be a data set of pyvista)")
    surface = mesh if hasattr(mesh, "faces") and hasattr(mesh, "strips") else mesh.extract_geometry()
    surface = surface.triangulate()
    faces = np.asarray(surface.faces, np.int64).reshape(-1, 4)[:, 1:]
    organ = surface.cell_data[ORGAN] if ORGAN in surface.cell_data else None
    return np.array(surface.points, float), faces, organ


def to_pint(values, standard_error, unit, registry=None):
    """Two quantities of pint: the values, and their standard errors."""
    registry = registry or needed("pint").get_application_registry()
    text = " * ".join(f"{symbol} ** {power}" for symbol, power in factors_of(unit).items())
    own = registry.parse_units(text) if text else registry.dimensionless
    return registry.Quantity(values, own), registry.Quantity(standard_error, own)
