"""Sums and means of estimates."""

from __future__ import annotations

import numpy as np

from . import _arithmetic as arithmetic


class Summable:
    """Part of `Estimates`."""

    __slots__ = ()

    def sum(self, axis=None, dtype=None, out=None, *, where=None, weights=None):
        """The sum over organs, groups, sensors or points, with its error; the axis of bands stays.

        Parameters
        ----------
        axis : int or str
            None: all but that of bands; or one of them, by number or name: "organ", "point", "time".
        where : array_like of bool
            Mask of what is summed: of the axis, or of all axes.
        weights : array_like
            Factors of any sign, in the shape of a mask; a density may then be summed. A sum over times
            then has no unit, as weights may be seconds or shares: name it by `with_unit`.

        Raises
        ------
        ValueError
            For a quantity per area, and over times, without weights; for weights of another shape, or
            that are NaN where the mask is true.
        """
        first, shape = self._summed_axes(axis, dtype, out)
        if weights is None:
            self._check_sum(first)
            weights = np.ones(shape)
        total = self._weighted(self._factors(weights, where, shape), first)
        return total.with_unit("") if self._is_over_times(first) else total

    def mean(self, axis=None, dtype=None, out=None, *, where=None):
        """The plain mean over organs, groups, sensors or points, with its error; bands stay.

        The arguments are those of `sum`.
        """
        first, shape = self._summed_axes(axis, dtype, out)
        mask = self._factors(np.ones(shape), where, shape)
        if not mask.any():
            raise ValueError(f"the mean of {self.name} over nothing")
        return self._weighted(mask / np.count_nonzero(mask), first)

    def average(self, weights="area", *, axis=None, where=None):
        """The mean weighted by area, or by an array of weights, with its error; see `sum`."""
        first, shape = self._summed_axes(axis, None, None)
        if isinstance(weights, str):
            areas = getattr(self.index, "areas", None)
            if weights != "area" or areas is None or shape[-1:] != np.shape(areas):
                raise ValueError('weights: give "area" for light of organs or groups, or an array')
            weights = areas
        weights = self._factors(weights, where, shape)
        total = weights.sum()
        if total == 0:
            raise ValueError(f"the weights of the average of {self.name} add up to 0")
        return self._weighted(weights / total, first)

    def _summed_axes(self, axis, dtype, out):
        """The first axis that is summed, and the shape of all that are."""
        if dtype is not None or out is not None:
            raise TypeError("estimates take no dtype and no out")
        if not self._has_rows:
            raise ValueError(f"{self.name} has nothing to sum over; the axis of bands is not summed")
        shape = self._row_shape
        if axis is None:
            return 0, shape
        names = [getattr(index, "axis", None) for index in (self.index, self._inner)][: len(shape)]
        axis = axis[0] if isinstance(axis, tuple) and len(axis) == 1 else axis
        if np.ndim(axis) > 0:
            raise TypeError("an axis is a number or a name; a mask is given as where=")
        axis = names.index(axis) if isinstance(axis, str) and axis in names else axis
        if axis not in range(min(len(shape), 2)):
            known = ", ".join(repr(name) if name else str(i) for i, name in enumerate(names))
            raise ValueError(f"axis {axis!r} can't be summed; give one of {known}")
        return axis, shape[axis : axis + 1]

    def _is_over_times(self, first):
        return first == 0 and getattr(self.index, "axis", None) == "time"

    def _check_sum(self, first):
        """Refuses a sum that means nothing. @param first: the first axis of it"""
        if self._is_over_times(first):
            raise ValueError(
                f"{self.name} at several times is a rate: use series.total or series.days, give "
                'weights (seconds) and the unit of the sum (with_unit), or sum over axis="organ"'
            )
        if not self.extensive:
            raise ValueError(
                f"{self.name} is per area: use the flux, average(), or mean() for the plain mean"
            )

    def _factors(self, weights, where, shape):
        """Weights in the shape of the summed axes, 0 where a mask is false."""
        weights = self._in_shape(np.asarray(weights, float), shape, "weights")
        if where is not None:
            where = np.asarray(where)
            if where.dtype != bool:
                raise ValueError(f"where is {where.dtype}; give a mask: an array of bool")
            weights = np.where(self._in_shape(where, shape, "a mask"), weights, 0.0)
        missing = np.count_nonzero(np.isnan(weights))
        if missing:
            raise ValueError(
                f"{missing} of {weights.size} weights of {self.name} are NaN; give 0, or a mask (where=) "
                "without them"
            )
        return weights

    def _in_shape(self, array, shape, what):
        if array.shape not in (shape, shape[1:] if len(shape) > 1 else shape):
            raise ValueError(f"{what} of the shape {array.shape} for numbers of the shape {shape}")
        return np.broadcast_to(array, shape)

    def _weighted(self, weights, first):
        """The weighted sum over as many axes as the weights have, from the first one."""
        if self._source is not None:
            factors = weights.reshape(*weights.shape, *[1] * (self.ndim - first - weights.ndim))
            axes = tuple(range(first, first + weights.ndim))
            source = self._source.summed(np.broadcast_to(factors, self.shape), axes)
            values = source.estimates()
        else:
            source, values = None, self._sum_of_unknown(weights, first)
        index = self._inner if weights.ndim == 1 and not first else None
        if first:
            index = None if self.index is None else self.index.with_inner(None)
        return self._mapped(values, source, index, lambda part: part._weighted(weights, first))

    def _sum_of_unknown(self, weights, first):
        """The sum of values whose replicates are not known."""
        axes = tuple(range(first, first + weights.ndim))
        weights = weights.reshape(*weights.shape, *[1] * (self.ndim - first - weights.ndim))
        means = np.where(weights != 0, weights * self.values, 0.0).sum(axis=axes)
        if np.all((weights == 0) | (self.standard_error == 0)):
            return np.stack([means, np.zeros_like(means), means, means], axis=-1)
        arithmetic.warn_of_unknown([self])
        return arithmetic.unknown(means)
