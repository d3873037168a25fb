"""Organs of a scene."""

from __future__ import annotations

import difflib
from functools import cached_property

import numpy as np

from ._format import number


class Organs:
    """The organs of a scene, in the order of its results. The ground is not among them.

    Attributes
    ----------
    ids : numpy.ndarray
        (organs,), int64.
    names : list of str
    labels : dict
        Key -> list of str, "" where an organ has no such label.
    areas : numpy.ndarray
        (organs,), one-sided area in square units of length.
    heights : numpy.ndarray
        (organs,), height of the centroid of the area, in units of length.
    has_ground : bool
        Whether the scene has a ground.
    bands : tuple of str
    units : tuple of str
        Unit of irradiance of each band.
    length_unit : str
    """

    def __init__(self, scene):
        self._scene = scene
        self.bands = tuple(name for name, _ in scene.bands)
        self.units = tuple(unit for _, unit in scene.bands)
        self.length_unit = scene.length_unit
        self.has_ground = scene.has_ground
        self.triangle_count = scene.triangle_count

    @cached_property
    def ids(self):
        return self._of_organs(self._scene.ids)

    @cached_property
    def areas(self):
        return self._of_organs(self._scene.areas)

    @cached_property
    def heights(self):
        return self._of_organs(self._scene.heights)

    @cached_property
    def names(self):
        return self._scene.names[: len(self)]

    @cached_property
    def labels(self):
        return {key: values[: len(self)] for key, values in self._scene.labels.items()}

    def _of_organs(self, array):
        """The entries of organs, which can't be written to."""
        array.flags.writeable = False
        return array[: len(self)]

    def where(self, condition=None, **labels):
        """A mask of organs, (organs,) of bool.

        Parameters
        ----------
        condition : str
            As those of groups: "height > 0.5 and kind == 'leaf'" (docs/guide/sums-layers-sensors.md).
        **labels
            Values of labels, each one value or a list: ``where(kind="leaf", plant=[1, 2])``.

        Raises
        ------
        InputError
            If the condition has an error.
        KeyError
            If no organ has such a label, or the value.
        """
        mask = np.ones(len(self), bool)
        if condition is not None:
            mask &= self._scene.where(condition)[: len(self)]
        for key, values in labels.items():
            values = [values] if isinstance(values, str) or np.ndim(values) == 0 else values
            own = self.label(key)
            for value in values:
                if str(value) not in own:
                    known = ", ".join(sorted(set(own[own != ""]))[:10])
                    raise KeyError(f"no organ has {key} = {value!r}; there are: {known}")
            mask &= np.isin(own, [str(value) for value in values])
        return mask

    def label(self, key):
        """The values of a label, (organs,) of str. Raises KeyError if no organ has it."""
        if key not in self.labels:
            known = ", ".join(self.labels) or "none"
            raise KeyError(f"no organ has a label {key!r}; there are: {known}")
        return np.array(self.labels[key])

    @cached_property
    def sensor_sets(self):
        """Sensors: list of dict with name, names, positions, counts, is_sphere and is_averaged."""
        return self._scene.sensors

    @cached_property
    def _index_of_id(self):
        return {int(organ): i for i, organ in enumerate(self.ids)}

    @cached_property
    def _index_of_name(self):
        """None for a name that several organs have."""
        indices = {}
        for i, name in enumerate(self.names):
            indices[name] = None if name in indices else i
        return indices

    def index_of(self, organ):
        """Returns the index of an organ, given by its id or its name.

        Raises KeyError if there is none, or if several organs have the name.
        """
        if not isinstance(organ, str):
            if organ not in self._index_of_id:
                raise KeyError(f"there is no organ with the id {organ}")
            return self._index_of_id[organ]
        if organ in self._index_of_name:
            index = self._index_of_name[organ]
            if index is None:
                count = self.names.count(organ)
                raise KeyError(f"{count} organs have the name {organ!r}: use an id")
            return index
        near = difflib.get_close_matches(organ, self.names, n=3)
        known = ", ".join(map(repr, near or self.names[:10]))
        raise KeyError(f"there is no organ {organ!r}; there are: {known}")

    def triangles(self, index):
        """The triangles of the organ at an index: (n, 3, 3), in the axes of the scene.

        The index after that of the last organ is that of the ground, if there is one. Raises IndexError
        if there is no organ at the index.
        """
        count = self._scene.organ_count
        if not 0 <= index < count:
            raise IndexError(
                f"organs.triangles: there is no index {index} (there are 0 to {count - 1}); "
                "index_of(id) gives that of an organ"
            )
        return self._scene.triangles_of(index)

    def without_triangles(self):
        """A copy that can be pickled in little memory."""
        return Organs(StoredScene(self._scene))

    def __reduce__(self):
        is_stored = isinstance(self._scene, StoredScene)
        return Organs, (self._scene if is_stored else StoredScene(self._scene, has_triangles=True),)

    def __len__(self):
        return self._scene.organ_count - self.has_ground

    def __repr__(self):
        labels = f"; labels {', '.join(self.labels)}" if self.labels else ""
        area = number(float(self.areas.sum()))
        return f"<{len(self)} organs{labels}; area {area} {self.length_unit}2>"


class StoredScene:
    """The organs of a scene as arrays, which can be pickled."""

    _FIELDS = (
        "ids", "areas", "heights", "names", "labels", "bands", "length_unit", "has_ground",
        "triangle_count", "organ_count", "up", "sensors",
    )  # fmt: skip

    def __init__(self, scene, has_triangles=False):
        for field in self._FIELDS:
            setattr(self, field, getattr(scene, field))
        if has_triangles:
            triangles = [scene.triangles_of(organ) for organ in range(scene.organ_count)]
            self._triangles = np.concatenate(triangles) if triangles else np.zeros((0, 3, 3))
            self._starts = np.concatenate([[0], np.cumsum([len(t) for t in triangles])])

    def triangles_of(self, organ):
        if not hasattr(self, "_triangles"):
            raise ValueError("the triangles were not stored: use result.organs")
        return self._triangles[self._starts[organ] : self._starts[organ + 1]]

    def where(self, condition):
        raise ValueError("conditions need the scene: use labels, or result.organs of the run")
