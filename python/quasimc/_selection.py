"""Selection of estimates by band, position, id and name."""

from __future__ import annotations

import operator

import numpy as np


class Selectable:
    """Part of `Estimates`."""

    __slots__ = ()

    @property
    def _has_rows(self):
        """Whether the first axis is not that of bands."""
        return self.ndim > (1 if self.bands else 0)

    def __getitem__(self, key):
        if isinstance(key, str):
            return self._band(key)
        if self.ndim == 0:
            raise IndexError(f"{self.name} is a single number")
        if isinstance(key, tuple):
            return self._by_axes(key)
        rows = self._rows(key)
        values = self._values[rows]
        source = self._source.take(rows) if self._source is not None and self._has_rows else None
        if not self._has_rows:  # positions of bands
            source = None if self._source is None else self._source.spread().with_band(rows)
            return type(self)(
                values,
                self.name,
                np.asarray(self._units * len(self.bands))[: len(self.bands)][rows].tolist(),
                np.asarray(self.bands)[rows].tolist() if np.ndim(rows) else (),
                source=source,
                extensive=self.extensive,
            )
        if np.ndim(rows) == 0:
            index = self._inner
        else:
            index = None if self.index is None else self.index.take(rows)
        return self._mapped(values, source, index, lambda part: part[key])

    def _by_axes(self, keys):
        """An index for each axis: an integer takes one away, and the first of two may also be several."""
        first, *others = keys
        result = self[first]
        if others and (isinstance(first, slice) or np.ndim(first)):
            if len(others) > 1 or len(self._row_shape) != 2:
                raise TypeError(f"{self.name}[{keys}]: index axis by axis, as light[2][3]")
            return result._within(others[0])
        return result[tuple(others)] if len(others) > 1 else result[others[0]] if others else result

    def _within(self, key):
        """Positions of the second axis of rows."""
        rows = self._rows(key, self.shape[1])
        source = None if self._source is None else self._source.take_inner(rows)
        keeps_inner = self._inner is not None and np.ndim(rows)
        index = self.index
        if index is not None:
            index = index.with_inner(self._inner.take(rows) if keeps_inner else None)
        return self._mapped(self._values[:, rows], source, index, lambda part: part._within(key))

    @property
    def _row_shape(self):
        """The shape without the axis of bands."""
        return self.shape[:-1] if self.bands else self.shape

    @property
    def _inner(self):
        """The meaning of the second axis of rows; None: it has none."""
        return getattr(self.index, "inner", None)

    def _band(self, band):
        if band not in self.bands:
            known = ", ".join(self.bands) or "none"
            near = [b for b in self.bands if b.lower() == band.lower()]
            hint = f"did you mean {near[0]!r}?" if near else f"there are: {known}"
            raise KeyError(f"there is no band {band!r}; {hint}")
        i = self.bands.index(band)
        result = self._mapped(
            self._values[..., i, :],
            None if self._source is None else self._source.with_band(i),
            self.index,
            lambda part: part[band],
        )
        result.bands = ()
        result._units = (self._units[i if len(self._units) > 1 else 0],)
        return result

    def _rows(self, key, count=None):
        """Positions of the first axis (or of one of `count`): an integer or an array of them."""
        count = self.shape[0] if count is None else count
        try:
            if isinstance(key, slice):
                return np.arange(count)[key]
            if np.ndim(key) == 0 and not isinstance(key, (bool, np.bool_)):
                return np.arange(count)[operator.index(key)]
            key = np.asarray(key)
            if key.size == 0 and key.dtype != bool:
                key = key.astype(int)
            if key.ndim != 1 or key.dtype.kind not in "biu":
                raise TypeError
            return np.arange(count)[key]
        except TypeError:
            raise TypeError(
                f"{key!r} is not a position, slice, mask or band; by id or name: light.at(...)"
            ) from None
        except IndexError as error:
            if np.ndim(key) == 0:
                hint = f"; by id: light.at({int(key)})" if self.index is not None else ""
                raise IndexError(f"position {int(key)} of {count}{hint}") from None
            raise IndexError(str(error)) from None

    def at(self, key):
        """The estimates of an organ or group, or of several in the given order.

        Parameters
        ----------
        key : int, str, or sequence of them
            Id (int) or name (str) of an organ; value of a group or of a point; time.

        Raises
        ------
        KeyError
            If there is none, or if several have the name.
        """
        if self.index is None:
            raise KeyError(f"{self.name} has no organs or groups")
        if isinstance(key, (list, np.ndarray)):
            return self[np.array([self.index.find(one) for one in key], int)]
        return self[self.index.find(key)]

    def where(self, mask):
        """The estimates of a mask: the same as ``light[mask]``."""
        return self[np.asarray(mask, bool)]
