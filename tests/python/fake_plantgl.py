"""Stands for openalea.plantgl.all: those of its documented classes that scenes of leaves are made of.

As in PlantGL, vectors and arrays are known by their items alone, a transformed geometry has a
`geometry` but no `id`, and triangles of any geometry are found by applying a `Tesselator` to it.
"""

from __future__ import annotations

import sys
import types


class _Items:
    """Known by [] and len(), as what boost::python wraps is."""

    def __init__(self, *items):
        self._items = items

    def __len__(self):
        return len(self._items)

    def __getitem__(self, i):
        if i >= len(self._items):
            raise IndexError(i)
        return self._items[i]


class Vector3(_Items):
    def __init__(self, x=0.0, y=0.0, z=0.0):
        super().__init__(x, y, z)


class Index3(_Items):
    pass


class _Array(_Items):
    def __init__(self, items):
        super().__init__(*items)


class Point3Array(_Array):
    def __init__(self, points):
        super().__init__(Vector3(*point) for point in points)


class Index3Array(_Array):
    def __init__(self, faces):
        super().__init__(Index3(*face) for face in faces)


class _Geometry:
    def apply(self, action):
        action.result = TriangleSet(*self.triangles())
        return True


class TriangleSet(_Geometry):
    def __init__(self, points, faces):
        self.pointList = Point3Array(points)
        self.indexList = Index3Array(faces)

    def triangles(self):
        return [list(p) for p in self.pointList], [list(f) for f in self.indexList]


class _Transformed(_Geometry):
    def __init__(self, geometry):
        self.geometry = geometry

    def triangles(self):
        points, faces = self.geometry.triangles()
        return [self.moved(point) for point in points], faces


class Translated(_Transformed):
    def __init__(self, translation, geometry):
        super().__init__(geometry)
        self.translation = Vector3(*translation)

    def moved(self, point):
        return [x + y for x, y in zip(point, self.translation)]


class Scaled(_Transformed):
    def __init__(self, scale, geometry):
        super().__init__(geometry)
        self.scale = Vector3(*scale)

    def moved(self, point):
        return [x * y for x, y in zip(point, self.scale)]


class Shape:
    def __init__(self, geometry, appearance=None, id=0):
        self.geometry, self.appearance, self.id = geometry, appearance, id

    def apply(self, action):
        return self.geometry.apply(action)


class Scene:
    def __init__(self, shapes=()):
        self._shapes = list(shapes)

    def add(self, shape):
        self._shapes.append(shape)

    def __len__(self):
        return len(self._shapes)

    def __iter__(self):
        return iter(self._shapes)


class Tesselator:
    result = None


def install(monkeypatch):
    """Lets the module be found as PlantGL is by who has imported it."""
    name = "openalea.plantgl.all"
    module = types.ModuleType(name)
    for each in (Vector3, Point3Array, Index3Array, TriangleSet, Translated, Scaled):
        setattr(module, each.__name__, each)
    for each in (Shape, Scene, Tesselator):
        setattr(module, each.__name__, each)
    monkeypatch.setitem(sys.modules, name, module)
