"""Organs of shapes and files, taken out of them as meshes of the scene."""

from __future__ import annotations

from itertools import groupby

import numpy as np

from ._mesh_edits import with_digest

#: A label that says which entry of the scene an organ is from.
_ENTRY = "quasimc: entry"
_KEYS = ("organ", "geometry")


class TakenOut:
    """The shapes and files of a scene as meshes, which come before the others.

    Results stay the same: ids, names, labels, materials and order are those of the organs as built.

    Attributes
    ----------
    meshes : dict
        As of the scene, number -> mesh.
    """

    def __init__(self, scene, organs):
        table = scene._table
        self._scene = scene
        self._entries = [(key, entry) for key in _KEYS for entry in table.get(key, [])]
        draft = scene._document_of(_with_marks(table, self._entries)).draft()
        others = {key: value for key, value in table.items() if key not in _KEYS}
        known = scene._document_of(others).draft()["optics"]
        self._materials = [
            {"name": name, "reflectance": reflectance, "transmittance": transmittance}
            for name, (reflectance, transmittance) in draft["optics"].items()
            if name not in known
        ]
        first = min([0, *(number[0] for number in scene._meshes)]) - 1
        meshes = _meshes_of(draft, organs, self._entries, scene._name)
        self.meshes = {(first, i): mesh for i, mesh in enumerate(meshes)}

    def check(self, organ, _):
        """Refuses a faulty organ. Its id is that of the organ that it replaces."""
        materials = [*self._scene._table.get("material", []), *self._materials]
        self._scene._frame_of(materials).check(organ)

    def put(self):
        """Puts the meshes into the scene, instead of the shapes and files."""
        scene = self._scene
        for key, entry in self._entries:
            scene._unmark(key, entry)
        for key in _KEYS:
            scene._table.pop(key, None)
        if self._materials:  # of files
            scene._table["material"] = [*scene._table.get("material", []), *self._materials]
        scene._document = scene._frame = None
        for number, mesh in self.meshes.items():
            scene._put(mesh, number)


def _with_marks(table, entries):
    marked = {key: [] for key in _KEYS}
    for i, (key, entry) in enumerate(entries):
        marked[key].append({**entry, "labels": {**entry.get("labels", {}), _ENTRY: str(i)}})
    return {**table, **{key: entries for key, entries in marked.items() if entries}}


def _meshes_of(draft, organs, entries, scene_name):
    """The meshes: as few for each entry as can hold its organs.

    Organs of a mesh have the same keys of labels and ascending ids.
    """
    meshes = []
    labels = [dict(own) for own in draft["labels"]]
    entry_of = [int(own.pop(_ENTRY)) for own in labels]
    ids = organs.ids[: len(labels)]
    descents = np.cumsum(np.diff(ids, prepend=ids[:1]) < 0)

    def kind(i):
        return entry_of[i], descents[i], list(labels[i]), draft["measured"][i], draft["field_of_view_deg"][i]

    for (entry, _, keys, measured, field_of_view), members in groupby(range(len(labels)), kind):
        members = list(members)
        first, last = members[0], members[-1] + 1
        meshes.append(
            with_digest(
                {
                    "where": f"{scene_name}: {organs.names[first]!r}",
                    **_triangles_of(draft, first, last),
                    "ids": np.ascontiguousarray(ids[first:last], np.int64),
                    "names": organs.names[first:last],
                    "labels": [(key, [labels[i][key] for i in members]) for key in keys],
                    "measured": measured,
                    "field_of_view_deg": field_of_view,
                    "name": entries[entry][1].get("name"),
                }
            )
        )
    return meshes


def _triangles_of(draft, first, last):
    """The triangles of some organs, as entries of a mesh."""
    starts = draft["starts"][first : last + 1]
    rows = slice(starts[0], starts[-1])
    used, of_face = np.unique(draft["material_of_triangle"][rows], return_inverse=True)
    return {
        "vertices": draft["triangles"][rows].reshape(-1, 3).copy(),
        "faces": None,
        "order": None,
        "starts": starts - starts[0],
        "materials": [draft["material_names"][i] for i in used],
        "material_of_face": of_face.astype(np.uint32) if len(used) > 1 else None,
    }
