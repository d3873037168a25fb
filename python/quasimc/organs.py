"""Organs of a scene."""

from __future__ import annotations

import difflib
from functools import cached_property


class Organs:
    """The organs of a scene, in the order of its results; the ground, if any, is the last.

    Attributes
    ----------
    ids : numpy.ndarray
        (organs,), int64.
    names : list of str
    labels : dict
        Key -> list of str, "" where an organ has no such label.
    areas : numpy.ndarray
        (organs,), one-sided area in square units of length.
    has_ground : bool
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
        return _fixed(self._scene.ids)

    @cached_property
    def areas(self):
        return _fixed(self._scene.areas)

    @cached_property
    def names(self):
        return self._scene.names

    @cached_property
    def labels(self):
        return self._scene.labels

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
        """The triangles of the organ at an index: (n, 3, 3), in the axes of the scene."""
        return self._scene.triangles_of(index)

    def __len__(self):
        return self._scene.organ_count

    def __repr__(self):
        return f"<Organs: {len(self)} of {self.triangle_count} triangles>"


def _fixed(array):
    """The array, which can't be written to."""
    array.flags.writeable = False
    return array
