"""Rows of a sparse matrix of weights."""

from __future__ import annotations

import hashlib

import numpy as np

from ._spread import Spread


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

    def __reduce__(self):
        return Rows, self.arrays()

    def arrays(self):
        return self.starts, self.organs, self.weights

    @property
    def are_organs(self):
        """Whether each row has one organ."""
        return len(self.organs) == len(self) and bool(np.all(np.diff(self.starts) == 1))

    def take(self, rows):
        """The rows at an array of positions."""
        counts = np.diff(self.starts)[rows]
        starts = np.concatenate([[0], np.cumsum(counts)])
        entries = np.arange(starts[-1]) + np.repeat(self.starts[:-1][rows] - starts[:-1], counts)
        return Rows(starts, self.organs[entries], self.weights[entries])

    def scaled(self, factors):
        """Rows times factors above 0."""
        if np.ndim(factors) == 0:
            return Rows(self.starts, self.organs, self.weights * factors)
        return Rows(self.starts, self.organs, self.weights * np.repeat(factors, np.diff(self.starts)))

    def weighted(self, factors):
        """Rows times factors, without those of the factor 0."""
        rows = np.flatnonzero(factors)
        return self.scaled(factors) if len(rows) == len(self) else self.take(rows).scaled(factors[rows])

    def unit(self):
        """The same with weights of 1."""
        return Rows(self.starts, self.organs, np.ones(len(self.organs)))

    def merged(self):
        """The sum of all rows: one row."""
        return Rows([0, len(self.organs)], self.organs, self.weights)

    def read(self, light):
        """Of rows of one organ each: their light, a Spread."""
        first, count = (int(self.organs[0]) if len(self) else 0), len(self)
        is_range = np.array_equal(self.organs, np.arange(first, first + count))
        key = slice(first, first + count) if is_range else self.organs
        spread = Spread(light.means[key], light.deviations[:, key], light.sizes[key])
        if np.all(self.weights == 1):
            return spread
        weights = self.weights
        return Spread(
            spread.means * weights, spread.deviations * weights, spread.sizes * weights[:, None]
        )

    def labels(self, of_organs):
        """A number below 0 for each row, by the labels of its organs and by its weights."""
        parts = np.stack([of_organs, self.weights.view(np.int64)], axis=1)
        digests = (
            hashlib.blake2b(parts[first:last].tobytes(), digest_size=7).digest()
            for first, last in zip(self.starts[:-1], self.starts[1:])
        )
        return np.array([~int.from_bytes(digest, "little") for digest in digests], np.int64)

    @staticmethod
    def added(rows, factors):
        """The sum of rows times factors of any sign: pairs of a sign and rows, as far as there are any.

        Parameters
        ----------
        rows : list of Rows
            Of equal length.
        factors : list of numpy.ndarray
            One factor for each row.
        """
        count = len(rows[0])
        of_row = np.concatenate([np.repeat(np.arange(count), np.diff(each.starts)) for each in rows])
        organs = np.concatenate([each.organs for each in rows]).astype(np.int64)
        weights = np.concatenate(
            [each.weights * np.repeat(own, np.diff(each.starts)) for each, own in zip(rows, factors)]
        )
        span = int(organs.max(initial=0)) + 1
        cells, inverse = np.unique(of_row * span + organs, return_inverse=True)
        weights = np.bincount(inverse, weights, len(cells))
        parts = []
        for sign in (1.0, -1.0):
            used = sign * weights > 0
            starts = np.searchsorted(cells[used] // span, np.arange(count + 1))
            if sign > 0 or used.any():
                parts.append((sign, Rows(starts, cells[used] % span, sign * weights[used])))
        return parts
