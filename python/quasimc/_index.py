"""The meaning of the first axis of estimates."""

from __future__ import annotations

import difflib

import numpy as np

from ._optional import needed


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

    def to_pandas(self):
        pandas = needed("pandas")

        return pandas.Index(self.ids, name="organ")

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

    def to_pandas(self):
        pandas = needed("pandas")

        return pandas.Index(self.keys, name="group")

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


class RunIndex:
    """Several runs: points of a sweep, or time steps.

    Attributes
    ----------
    axis : str
        "point" or "time".
    names : list of str
        What the values of a key are called.
    keys : list
        For each run: a value, or a tuple of one for each name.
    inner : OrganIndex, GroupIndex or None
        The meaning of the second axis.
    """

    def __init__(self, axis, names, keys, inner=None):
        self.axis = axis
        self.names = list(names)
        self.keys = list(keys)
        self.inner = inner

    @property
    def areas(self):
        return self.inner.areas

    def with_inner(self, inner):
        return RunIndex(self.axis, self.names, self.keys, inner)

    def take(self, rows):
        return RunIndex(self.axis, self.names, [self.keys[row] for row in rows], self.inner)

    def find(self, key):
        """The row of a run. Raises KeyError if there is none."""
        key = key.isoformat(timespec="minutes") if hasattr(key, "isoformat") else key
        if key not in self.keys:
            first = ", ".join(repr(known) for known in self.keys[:10])
            raise KeyError(f"there is no {self.axis} {key!r}; there are: {first}")
        return self.keys.index(key)

    def to_pandas(self):
        """A pandas index: times with their offset, or the values of each name; then those of `inner`."""
        pandas = needed("pandas")

        if self.axis == "time":
            levels = [time_index(self.keys)]
        else:
            rows = [key if len(self.names) > 1 else (key,) for key in self.keys]
            levels = [pandas.Index([as_hashable(row[i]) for row in rows], name=name)
                      for i, name in enumerate(self.names)]
        if self.inner is None:
            return levels[0] if len(levels) == 1 else pandas.MultiIndex.from_arrays(levels)
        within = self.inner.to_pandas()
        repeated = [level.repeat(len(within)) for level in levels]
        inside = within[np.tile(np.arange(len(within)), len(self))]
        return pandas.MultiIndex.from_arrays([*repeated, inside])

    def __len__(self):
        return len(self.keys)

    def __eq__(self, other):
        return (
            isinstance(other, RunIndex)
            and (self.axis, self.keys) == (other.axis, other.keys)
            and self.inner == other.inner
        )

    __hash__ = None


def time_index(times):
    """A pandas.DatetimeIndex of times, with the offset from UTC of the first."""
    import datetime

    pandas = needed("pandas")

    offset = datetime.datetime.fromisoformat(times[0]).tzinfo if times else None
    return pandas.DatetimeIndex(pandas.to_datetime(times, utc=True), name="time").tz_convert(offset)


def as_hashable(value):
    """A value of a table's index: itself, or its text if it is a list, a dict or a value of a scene."""
    return value if isinstance(value, (str, int, float, bool)) else str(value)
