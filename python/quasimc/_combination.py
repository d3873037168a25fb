"""Weighted sums of organs' light, which the engine estimates as it does those of groups."""

from __future__ import annotations

import numpy as np

from ._spread import Spread, linear


class Rows:
    """Sums of organs, each times a positive weight: the rows of a sparse matrix.

    ``starts`` (rows + 1,), ``organs`` and ``weights`` (entries,) as the core takes them.
    """

    __slots__ = ("starts", "organs", "weights")

    def __init__(self, starts, organs, weights):
        self.starts = np.ascontiguousarray(starts, np.int64)
        self.organs = np.ascontiguousarray(organs, np.uint32)
        self.weights = np.ascontiguousarray(weights, float)

    @classmethod
    def of_organs(cls, positions):
        """A row for each organ."""
        return cls(np.arange(len(positions) + 1), positions, np.ones(len(positions)))

    @classmethod
    def of_groups(cls, groups):
        """A row for each array of positions."""
        counts = [len(group) for group in groups]
        organs = np.concatenate([*groups, np.zeros(0, np.uint32)])
        return cls(np.concatenate([[0], np.cumsum(counts)]), organs, np.ones(len(organs)))

    def __len__(self):
        return len(self.starts) - 1

    def arrays(self):
        return self.starts, self.organs, self.weights

    def take(self, rows):
        """The rows at an array of positions."""
        counts = np.diff(self.starts)[rows]
        starts = np.concatenate([[0], np.cumsum(counts)])
        entries = np.arange(starts[-1]) + np.repeat(self.starts[:-1][rows] - starts[:-1], counts)
        return Rows(starts, self.organs[entries], self.weights[entries])

    def scaled(self, factors):
        """Rows times factors above 0."""
        factors = np.broadcast_to(factors, len(self))
        return Rows(self.starts, self.organs, self.weights * np.repeat(factors, np.diff(self.starts)))

    def merged(self):
        """The sum of all rows: one row."""
        return Rows([0, len(self.organs)], self.organs, self.weights)


class Combination:
    """Weighted sums of one quantity: a source of estimates (see `_spread`)."""

    __slots__ = ("_core", "_quantity", "_rows", "_band", "_is_single")

    #: Stands for the sunlit area, which has no bands.
    SUNLIT = -1

    def __init__(self, core, quantity, rows, band=None, is_single=False):
        self._core = core
        self._quantity = quantity
        self._rows = rows
        self._band = band
        self._is_single = is_single  # of one row, whose axis is dropped

    def _with(self, rows, is_single=False):
        return Combination(self._core, self._quantity, rows, self._band, is_single)

    @property
    def ndim(self):
        return int(not self._is_single) + int(self._band is None and self._quantity != self.SUNLIT)

    @property
    def replicates(self):
        return self._core.count

    def with_band(self, band):
        return Combination(self._core, self._quantity, self._rows, band, self._is_single)

    def take(self, key):
        if np.ndim(key) == 0:
            return self._with(self._rows.take(np.array([key])), True)
        return self._with(self._rows.take(key))

    def scaled(self, factors):
        """Times factors above 0, one for each row or for all."""
        return self._with(self._rows.scaled(factors), self._is_single)

    def summed(self, factors, axes=(0,)):
        if factors.ndim == 1:
            return self._sum(factors)
        if np.all(factors == factors[:, :1]):
            return self._sum(factors[:, 0])
        return Spread.of_bands(
            [self.with_band(band)._sum(column).spread() for band, column in enumerate(factors.T)]
        )

    def _sum(self, weights):
        """The weighted sum of the rows; of weights of both signs, a difference of two sums."""
        if not np.all(np.isfinite(weights)):
            return self.spread().summed(weights)
        if not np.any(weights < 0):
            return self._sum_of_positive(weights)
        parts = [(self._sum_of_positive(sign * weights).spread(), sign) for sign in (1.0, -1.0)]
        return linear(sum(sign * spread.means for spread, sign in parts), parts)

    def _sum_of_positive(self, weights):
        rows = np.flatnonzero(weights > 0)
        return self._with(self._rows.take(rows).scaled(weights[rows]).merged(), True)

    def estimates(self):
        if self._quantity == self.SUNLIT:
            values = self._core.combine_sunlit(*self._rows.arrays())
        else:
            values = self._core.combine(*self._rows.arrays())[:, self._quantity]
            values = values if self._band is None else values[:, self._band]
        return values[0] if self._is_single else values

    def spread(self):
        if self._quantity == self.SUNLIT:
            values, sizes = self._core.sunlit_replicates(*self._rows.arrays())
            values, sizes = values[..., 0], sizes[:, 0]
        else:
            values, sizes = self._core.replicates(*self._rows.arrays(), self._quantity)
            if self._band is not None:
                values, sizes = values[..., self._band], sizes[:, self._band]
        spread = Spread.of_replicates(values, sizes)
        return spread.take(0) if self._is_single else spread
