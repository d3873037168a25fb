"""The organs of a scene, which can be edited."""

from __future__ import annotations

import numbers
from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from ._mesh_edits import divided, moved, organ_count, organs_from, with_entries, with_triangles
from ._meshes import input_error, mesh_arrays
from ._taken_out import TakenOut


class SceneOrgans:
    """The organs of a scene as it is now: all that `Organs` has, and ways to edit them.

    An edited organ keeps its position in results, and they have the bits of a new scene with the same
    organs in the same order. Organs that were added without an id are numbered anew when others are
    removed.

    The first edit of an organ of a shape or a file takes all organs of shapes and files out: they
    become meshes with the same ids, names, labels and materials, in the same order, and the files are
    not read again. Copies get triangles of their own, which need memory. Later `Scene.add_organ` and
    `add_file` add before them.

    `which` is an id, a name, a list of these, or a mask of organs ((organs,) of bool, as of `where`).
    A refused call changes nothing: it raises KeyError if there is no such organ, and InputError if
    the change is invalid.

    Examples
    --------
    >>> scene.organs.transform("leaf 3", translate=[0, 0, 0.1])  # doctest: +SKIP
    """

    def __init__(self, scene):
        self._edited = scene

    def __getattr__(self, name):
        if name.startswith("__") or name == "_edited":
            raise AttributeError(name)
        return getattr(self._edited.build(), name)

    def __contains__(self, organ):
        """Whether there is an organ with an id or a name."""
        if isinstance(organ, numbers.Integral) and int(organ) in self._edited._ids:
            return True
        built = self._edited.build()
        return organ in (built.names if isinstance(organ, str) else built.ids)

    def __len__(self):
        return len(self._edited.build())

    def __repr__(self):
        return repr(self._edited.build())

    def replace(self, which, vertices, faces=None, *, organ=None, material=None):
        """Replaces the triangles of organs; id, name, labels and position stay.

        Parameters
        ----------
        which
            An organ; or several, with `organ`.
        vertices, faces : array_like
            As of `Scene.add_mesh`: (n, 3) and (m, 3), or triangles (m, 3, 3).
        organ : array_like of int
            (m,): for several organs, the id of the organ of each face.
        material : str or list of str
            Default: the old one.
        """
        new = mesh_arrays(
            "organs.replace", vertices, faces, organ, "" if material is None else material,
            None, None, True, 90.0,
        )  # fmt: skip
        with self._edited._lock.to_change():
            found, taken = self._find(which)
            given = [id for _, _, id in found] if new["ids"] is None else new["ids"].tolist()
            if sorted(given) != sorted(id for _, _, id in found) or len(given) != organ_count(new):
                raise input_error(
                    "organs.replace",
                    f"there are triangles of {organ_count(new)} organs for {len(found)} organs",
                    "each needs its own",
                    "give organ=, the id of the organ of each face",
                )
            parts = {id: organs_from(new, i, i + 1) for i, id in enumerate(given)}
            self._change(found, taken, lambda organ, id: with_triangles(organ, parts[id]))

    def remove(self, which):
        """Removes organs."""
        with self._edited._lock.to_change():
            self._change(*self._find(which), None)

    def transform(self, which, *, scale=1, rotate=None, translate=None):
        """Scales, then rotates, then translates organs, as `transform` of a run file does.

        Parameters
        ----------
        scale : float
            About the origin; not 0.
        rotate : dict
            axis (3 floats) and angle_deg, about an axis through the origin.
        translate : sequence of 3 floats
            In the unit of length.
        """
        if not _floats("scale", scale, ()):
            raise input_error("organs.transform", f"scale is {scale}", "it must not be 0")
        if translate is not None:
            _floats("translate", translate, (3,))
        if rotate is not None:
            _check_rotation(rotate)
        with self._edited._lock.to_change():
            self._change(
                *self._find(which), lambda organ, _: moved(organ, scale, rotate, translate)
            )

    def set(self, which, *, material=None, labels=None, name=None, measured=None):
        """Sets the material, labels, name of organs, or whether their light is reported.

        Parameters
        ----------
        material : str
        labels : dict
            Key -> value; other labels stay; the value None removes one.
        name : str
        measured : bool
        """
        if labels is not None and not isinstance(labels, Mapping):
            kind = type(labels).__name__
            raise input_error("organs.set", f"labels is of the type {kind}", "it must be a dict")
        with self._edited._lock.to_change():
            self._change(
                *self._find(which),
                lambda organ, _: with_entries(organ, material, labels, name, measured),
            )

    def _find(self, which):
        """Number of the mesh, index in it, and id of each organ; and what must be taken out of files."""
        meshes, taken = self._edited._meshes, None
        keys = self._keys(which)
        if all(isinstance(key, numbers.Integral) for key in keys):
            found = [_of_id(self._edited, key) for key in keys]
            if None not in found:
                return found, None
        organs = self._edited._build()
        positions = [organs.index_of(key) for key in keys]
        if min(positions) < len(organs) - sum(organ_count(mesh) for mesh in meshes.values()):
            taken = TakenOut(self._edited, organs)
            meshes = {**taken.meshes, **meshes}
        order = [(number, i) for number in sorted(meshes) for i in range(organ_count(meshes[number]))]
        first = len(organs) - len(order)
        return [(*order[position - first], int(organs.ids[position])) for position in positions], taken

    def _keys(self, which):
        """Ids and names, each once."""
        if isinstance(which, (str, numbers.Integral)):
            return [which]
        array = np.asarray(which)
        if array.dtype == bool:
            ids = self._edited._build().ids
            if array.shape != ids.shape:
                problem = f"the mask has the shape {array.shape}"
                raise input_error("scene.organs", problem, f"it must be {ids.shape}")
            return ids[array].tolist()
        return list(dict.fromkeys(key if isinstance(key, str) else int(key) for key in which))

    def _change(self, found, taken, change):
        """Puts changed organs instead of the old ones; `change` None: removes them."""
        scene = self._edited
        meshes, check = scene._meshes, scene._check_mesh
        if taken is not None:
            meshes, check = {**taken.meshes, **meshes}, taken.check
        changed = defaultdict(dict)
        for number, index, id in found:
            mesh = meshes[number]
            changed[number][index] = (
                None if change is None else change(organs_from(mesh, index, index + 1), id)
            )
        for number, organs in changed.items():
            for organ in organs.values():
                if organ is not None:
                    check(organ, [number])
        if taken is not None:
            taken.put()
        for number, organs in changed.items():
            parts = divided(scene._meshes[number], organs)
            scene._take(number)
            for i, part in enumerate(parts):
                scene._put(part, number if len(parts) == 1 else (*number, i))


def _of_id(scene, id):
    """Number of the mesh, index in it, and id of an organ whose id was given; None: there is none."""
    number = scene._ids.get(id)
    if number is None:
        return None
    return number, int(np.searchsorted(scene._meshes[number]["ids"], id)), int(id)


def _floats(key, value, shape):
    """An array of finite numbers of a shape."""
    array = np.asarray(value, dtype=float)
    if array.shape != shape or not np.all(np.isfinite(array)):
        count = f"{shape[0]} numbers" if shape else "a number"
        raise input_error("organs.transform", f"{key} is {value!r}", f"it must be {count}")
    return array


def _check_rotation(rotate):
    if not isinstance(rotate, Mapping) or set(rotate) != {"axis", "angle_deg"}:
        raise input_error(
            "organs.transform", f"rotate is {rotate!r}", "", 'give {"axis": [0, 0, 1], "angle_deg": 90}'
        )
    if not np.any(_floats("axis", rotate["axis"], (3,))):
        raise input_error("organs.transform", "axis is 0", "it has no direction")
    _floats("angle_deg", rotate["angle_deg"], ())
