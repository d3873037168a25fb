"""Triangles of PlantGL scenes and MTGs (duck-typed: neither is imported)."""

from __future__ import annotations

import sys
from collections.abc import Mapping


def is_triangles(geometry):
    """Whether it is a list of triangles already."""
    return isinstance(geometry, (list, tuple))


def _tesselator():
    for name in ("openalea.plantgl.all", "openalea.plantgl.algo"):
        if hasattr(sys.modules.get(name), "Tesselator"):
            return sys.modules[name].Tesselator()
    return None


def triangles_of(geometry):
    """The triangles of a geometry: list of lists of three (x, y, z).

    A geometry is a list of triangles, has `pointList` and `indexList`, is a shape (which has an
    `id` and a `geometry`), or is one of PlantGL, which its user has imported.
    """
    if is_triangles(geometry):
        return list(geometry)
    if hasattr(geometry, "pointList") and hasattr(geometry, "indexList"):
        points = [tuple(float(x) for x in point) for point in geometry.pointList]
        return [
            [points[face[0]], points[face[k]], points[face[k + 1]]]
            for face in (list(face) for face in geometry.indexList)
            for k in range(1, len(face) - 1)
        ]
    # A translated, scaled or turned geometry of PlantGL has a `geometry` too, but no `id`.
    if hasattr(geometry, "geometry") and hasattr(geometry, "id"):
        return triangles_of(geometry.geometry)
    tesselator = _tesselator()
    if tesselator is None or not hasattr(geometry, "apply"):
        raise ValueError(f"scene: a {type(geometry).__name__} can't be divided into triangles")
    geometry.apply(tesselator)
    return [] if tesselator.result is None else triangles_of(tesselator.result)


def scene_to_cscene(scene):
    """The triangles of a PlantGL scene: dict, shape.id -> list; shapes of one id together."""
    result = {}
    for shape in scene:
        found = triangles_of(shape)
        if found:
            result.setdefault(shape.id, []).extend(found)
    return result


def mtg_to_cscene(mtg, property_name="geometry"):
    """The triangles of an MTG: dict, vertex -> list of triangles."""
    geometries = mtg.property(property_name)
    result = {vid: triangles_of(geometry) for vid, geometry in geometries.items()}
    return {vid: triangles for vid, triangles in result.items() if triangles}


def is_lsystem_pair(scene):
    """Whether it is an L-system of L-Py and an L-string that it draws."""
    is_pair = isinstance(scene, tuple) and len(scene) == 2
    return is_pair and callable(getattr(scene[0], "sceneInterpretation", None))


def is_mtg(scene):
    return callable(getattr(scene, "property", None)) and not isinstance(scene, Mapping)


def is_plantgl_scene(scene):
    """Whether it is a list of shapes with an id and a geometry."""
    if isinstance(scene, (str, Mapping)) or not hasattr(scene, "__iter__"):
        return False
    return all(hasattr(shape, "id") and hasattr(shape, "geometry") for shape in scene)
