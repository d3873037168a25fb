"""Scenes and runs as run files that hold all of them."""

from __future__ import annotations

import itertools
import os

import numpy as np

from . import _core
from ._meshes import input_error, mesh_arrays, plain


class Written:
    """What a result was computed from: a scene, its meshes, and the light on it.

    It refers to tables and meshes of a scene, which are never changed in place.
    """

    text = None  # a result of it is written anew

    def __init__(self, name, folder, scene_table, meshes, light_table):
        self.name = name
        self.folder = os.getcwd() if folder is None else folder
        self.scene_table = scene_table
        self.meshes = meshes
        self.light_table = light_table

    def table(self, built):
        """The run file as a dict. @param built: the organs of the scene"""
        table = {"title": os.path.basename(self.name), **self.light_table, **self.scene_table}
        organs = list(table.get("organ", []))
        free = iter(free_ids(self.meshes, built))
        for mesh in self.meshes:
            organs.extend(_mesh_organs(mesh, free))
        if organs:
            table["organ"] = organs
        return table

    def lit(self):
        """The same with some light: a scene without any can't be drawn."""
        if {"source", "time"} & self.light_table.keys():
            return self
        light = {**self.light_table, "source": [{"type": "uniform_sky", "irradiance_horizontal": 1}]}
        return Written(self.name, self.folder, self.scene_table, self.meshes, light)

    def document(self, built):
        return _core.Document(self.table(built), self.name, self.folder)

    def with_plant(self, organs, count, step):
        """A stand with a plant in it, after a growth step, which has a seed of its own.

        Parameters
        ----------
        organs : Organs
            Of the stand and the plant.
        count : int
            Of the plant: the last ones.
        """
        run = self.light_table.get("run", {})
        usual = next(option["default"] for option in _core.options() if option["key"] == "seed")
        light = {**self.light_table, "run": {**run, "seed": int(run.get("seed", usual)) + step}}
        return WrittenPlant(self, organs, count, light)


class WrittenPlant(Written):
    """A stand with a plant in it. Its meshes are made when they are needed."""

    def __init__(self, stand, organs, count, light_table):
        self.name, self.folder = stand.name, stand.folder
        self.scene_table, self.light_table = stand.scene_table, light_table
        self._stand, self._organs, self._count = stand, organs, count

    def __reduce__(self):
        return Written, (self.name, self.folder, self.scene_table, self.meshes, self.light_table)

    @property
    def meshes(self):
        organs, first = self._organs, len(self._organs) - self._count
        rows = range(first, len(organs))
        return [*self._stand.meshes, *(_mesh_of_organ(organs, row) for row in rows)]


def _mesh_of_organ(organs, row):
    """An organ of a scene as the mesh of a scene."""
    corners = np.asarray(organs.triangles(row), float)
    ids = np.full(len(corners), organs.ids[row])
    labels = {key: values[row] for key, values in organs.labels.items() if values[row]}
    where, material = f"organ {organs.ids[row]}", organs._scene.materials[row]
    return mesh_arrays(where, corners, None, ids, material, organs.names[row], labels, True, 90)


class WrittenSweep:
    """The scene of a sweep, and the keys of a run file that it sets."""

    text = None

    def __init__(self, base, values, combine, points):
        self._base = base
        self._values = {run_file_key(name): [plain(value) for value in each] for name, each in values.items()}
        self._combine = combine
        self._points = points  # what each point was computed from

    def document(self, organs):
        """Raises InputError if a point is not what the run file makes of its values."""
        table = self._base.table(organs)
        for point, own in zip(combined(self._values, self._combine), self._points):
            made = table
            for key, value in point.items():
                made = _with_value(made, key, value)
            if own is None or made is None or plain(made) != plain(own.table(organs)):
                raise input_error(
                    "Sweep.save",
                    f"its point {point} is not in the form of [sweep] of a run file",
                    "that sets single keys, no whole values and no organs without ids",
                    "save the result of each point, sweep[i].save(...)",
                )
        swept = {"combine": self._combine, **self._values}
        return _core.Document({**table, "sweep": swept}, self._base.name, self._base.folder)


def combined(lists, combine):
    """The points of lists of values: list of dict. The first name varies slowest."""
    rows = itertools.product(*lists.values()) if combine == "product" else zip(*lists.values())
    return [dict(zip(lists, row)) for row in rows]


def run_file_key(name):
    """The key of a run file for one of a sweep: "material.leaf.reflectance"."""
    part, _, rest = name.partition(".")
    part = {"materials": "material", "sources": "source"}.get(part, part)
    return f"{part}.{rest}" if rest else part


def _with_value(table, key, value):
    """A run file with another value of a key; None if it has no such table."""
    section, _, rest = key.partition(".")
    if not rest:
        return {**table, "run": {**table.get("run", {}), section: value}}
    old = table.get(section)
    if isinstance(old, list):
        name, _, last = rest.rpartition(".")
        return {
            **table,
            section: [{**item, last: value} if item.get("name") == name else item for item in old],
        }
    return None if old is None else {**table, section: {**old, rest: value}}


def free_ids(meshes, organs):
    """Ids that the scene gave to organs of meshes without one; meshes are the last in its order."""
    counts = [len(mesh["starts"]) - 1 for mesh in meshes]
    own = organs.ids[len(organs) - sum(counts) :]
    starts = np.cumsum([0, *counts])
    return [
        int(organ)
        for mesh, start, count in zip(meshes, starts, counts)
        if mesh["ids"] is None
        for organ in own[start : start + count]
    ]


def _mesh_organs(mesh, free):
    """The organs of a mesh as tables of the shape "mesh"."""
    of_faces = mesh["material_of_face"]
    count = len(mesh["starts"]) - 1
    corners = mesh["faces"]
    if corners is None:
        corners = np.arange(len(mesh["vertices"])).reshape(-1, 3)
    order = mesh["order"]
    for i in range(count):
        rows = np.arange(mesh["starts"][i], mesh["starts"][i + 1])
        rows = rows if order is None else order[rows]
        used, faces = np.unique(corners[rows], return_inverse=True)
        materials = {0} if of_faces is None else set(of_faces[rows].tolist())
        organ = int(next(free)) if mesh["ids"] is None else int(mesh["ids"][i])
        if len(materials) > 1:
            raise ValueError(
                f"{mesh['where']}: organ {organ} has several materials, which run files can't hold; "
                "give its parts as organs"
            )
        table = {
            "shape": "mesh",
            "id": organ,
            "material": mesh["materials"][materials.pop()],
            "vertices": mesh["vertices"][used].tolist(),
            "faces": faces.reshape(-1, 3).tolist(),
            "measured": mesh["measured"],
        }
        if mesh["field_of_view_deg"] != 90:
            table["field_of_view_deg"] = mesh["field_of_view_deg"]
        if mesh["names"]:
            table["name"] = mesh["names"][i]
        if mesh["labels"]:
            table["labels"] = {
                key: values[i if len(values) > 1 else 0] for key, values in mesh["labels"]
            }
        yield table
