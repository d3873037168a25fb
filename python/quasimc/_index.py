"""The meaning of the first axis of estimates."""

from __future__ import annotations

import difflib

import numpy as np


class OrganIndex:
    """Organs of a result, by id or name.

    Attributes
    ----------
    positions : numpy.ndarray
        (n,), in the organs of the result.
    """

    axis = "organ"

    def __init__(self, organs, positions=None):
        self.organs = organs
        self.positions = np.arange(len(organs)) if positions is None else positions

    @property
    def ids(self):
        return self.organs.ids[self.positions]

    @property
    def keys(self):
        return self.ids

    @property
    def areas(self):
        return self.organs.areas[self.positions]

    @property
    def is_all(self):
        return len(self.positions) == len(self.organs) and np.array_equal(
            self.positions, np.arange(len(self.organs))
        )

    def take(self, rows):
        return OrganIndex(self.organs, self.positions[rows])

    def find(self, key):
        """The row of an organ, by id or name. Raises KeyError if there is none."""
        if isinstance(key, (bool, np.bool_)):
            raise TypeError("at() takes ids and names; a mask selects by light[mask]")
        position = self.organs.index_of(key)
        rows = np.flatnonzero(self.positions == position)
        if not len(rows):
            raise KeyError(f"organ {key!r} is not among these {len(self)} organs")
        return int(rows[0])

    def __len__(self):
        return len(self.positions)

    def __reduce__(self):
        return OrganIndex, (self.organs.without_triangles(), self.positions)

    def __eq__(self, other):
        return isinstance(other, OrganIndex) and np.array_equal(self.ids, other.ids)

    __hash__ = None


class GroupIndex:
    """Groups of organs, by the value of their label, or a tuple of values."""

    axis = "group"

    def __init__(self, keys, areas):
        self.keys = list(keys)
        self.areas = np.asarray(areas, float)

    def take(self, rows):
        return GroupIndex([self.keys[row] for row in rows], self.areas[rows])

    def find(self, key):
        key = str(key) if key not in self.keys and str(key) in self.keys else key
        if key not in self.keys:
            near = difflib.get_close_matches(str(key), [str(k) for k in self.keys], 3)
            known = ", ".join(near or [str(k) for k in self.keys[:10]])
            raise KeyError(f"there is no group {key!r}; there are: {known}")
        if self.keys.count(key) > 1:
            raise KeyError(f"{self.keys.count(key)} groups have the value {key!r}: use a position")
        return self.keys.index(key)

    def __len__(self):
        return len(self.keys)

    def __eq__(self, other):
        return isinstance(other, GroupIndex) and self.keys == other.keys

    __hash__ = None
