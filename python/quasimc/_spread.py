"""What lies behind estimates: weighted sums of organs' light, or numbers replicate by replicate."""

from __future__ import annotations

import numpy as np

from . import _core


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
    """Weighted sums of one quantity, which the engine estimates as it does those of groups."""

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

    def with_band(self, band):
        return Combination(self._core, self._quantity, self._rows, band, self._is_single)

    def take(self, key):
        """Rows at an array of positions, or one of them."""
        if np.ndim(key) == 0:
            return self._with(self._rows.take(np.array([key])), True)
        return self._with(self._rows.take(key))

    def scaled(self, factors):
        """Times factors above 0, one for each row or for all."""
        return self._with(self._rows.scaled(factors), self._is_single)

    def summed(self, weights):
        """The weighted sum of the rows: a combination, or the spread of a difference of two."""
        parts = []
        for sign in (1, -1):
            rows = np.flatnonzero(sign * weights > 0)
            part = self._rows.take(rows).scaled(sign * weights[rows])
            parts.append(self._with(part.merged(), True))
        if not np.any(weights < 0):
            return parts[0]
        above, below = (part.spread() for part in parts)
        return linear(above.means - below.means, [(above, 1.0), (below, -1.0)])

    def estimates(self):
        """(rows, bands, 4) or (rows, 4): mean, standard error and interval."""
        if self._quantity == self.SUNLIT:
            values = self._core.combine_sunlit(*self._rows.arrays())
        else:
            values = self._core.combine(*self._rows.arrays())[:, self._quantity]
            values = values if self._band is None else values[:, self._band]
        return values[0] if self._is_single else values

    def spread(self):
        """The replicates of every row: Spread."""
        if self._quantity == self.SUNLIT:
            values, sizes = self._core.sunlit_replicates(*self._rows.arrays())
            values, sizes = values[..., 0], sizes[:, 0]
        else:
            values, sizes = self._core.replicates(*self._rows.arrays(), self._quantity)
            if self._band is not None:
                values, sizes = values[..., self._band], sizes[:, self._band]
        spread = Spread.of_replicates(values, sizes)
        return spread.take(0) if self._is_single else spread


class Stack:
    """Numbers of several runs: the first axis is that of runs, and each has its own source.

    Runs may share their random numbers: a contribution that one of them lacks, others may lack too.
    """

    __slots__ = ("_parts", "_is_shared")

    def __init__(self, parts, is_shared):
        self._parts = list(parts)
        self._is_shared = is_shared

    def _with(self, parts):
        return Stack(parts, self._is_shared)

    def each(self, change):
        """The same runs with another source for each."""
        return self._with(change(part) for part in self._parts)

    def with_band(self, band):
        return self.each(lambda part: part.with_band(band))

    def take(self, key):
        """Runs at an array of positions, or one of them."""
        return self._parts[key] if np.ndim(key) == 0 else self._with(self._parts[row] for row in key)

    def summed(self, weights, axis=0):
        """The weighted sum over as many axes as the weights have, from a given one."""
        if axis == 1:
            return self.each(lambda part: part.summed(weights))
        if weights.ndim > 1:
            rows = self._with(part.summed(own) for part, own in zip(self._parts, weights))
            return rows.summed(np.ones(len(weights)))
        spreads = self._spreads()
        means = sum(weight * spread.means for weight, spread in zip(weights, spreads))
        total = linear(means, list(zip(spreads, weights)))
        if self._is_shared:
            total.sizes = shared_sizes(spreads, weights)
        return total

    def _spreads(self):
        spreads = [part.spread() for part in self._parts]
        counts = sorted({spread.replicates for spread in spreads})
        if len(counts) > 1:
            raise ValueError(f"{counts[0]} and {counts[1]} replicates: they can't be paired")
        return spreads

    def estimates(self):
        """(runs, ..., 4): mean, standard error and interval."""
        return np.stack([part.estimates() for part in self._parts])

    def spread(self):
        """The replicates of every run, paired by number: Spread."""
        spreads = self._spreads()
        return Spread(
            np.stack([spread.means for spread in spreads]),
            np.stack([spread.deviations for spread in spreads], axis=1),
            np.stack([spread.sizes for spread in spreads]),
        )


def shared_sizes(spreads, weights):
    """One contribution to a weighted sum of runs with the same random numbers: it may be missing from all of
    them, so sizes of one sign add up; those of the other sign are as if independent."""
    above, below = (
        sum((abs(w) * spread.sizes[..., ::sign] for w, spread in zip(weights, spreads) if sign * w > 0), 0.0)
        for sign in (1, -1)
    )
    return np.broadcast_to(np.hypot(above, below), spreads[0].sizes.shape)


class Spread:
    """Numbers with their deviations in each replicate, and the size of a contribution.

    ``means`` has any shape, ``deviations`` one more axis before it, and ``sizes`` one more after it:
    the change by one contribution more, and by one less, which replicates may not show.
    """

    __slots__ = ("means", "deviations", "sizes")

    def __init__(self, means, deviations, sizes):
        self.means, self.deviations, self.sizes = means, deviations, sizes

    @classmethod
    def of_replicates(cls, values, sizes):
        means = values.mean(axis=0)
        return cls(means, values - means, sizes)

    @classmethod
    def exact(cls, means, count):
        """Numbers without deviations."""
        return cls(means, np.zeros((count, *means.shape)), np.zeros((*means.shape, 2)))

    @classmethod
    def of_values(cls, means, errors, count):
        """Numbers whose replicates were not kept: where they have an error, deviations are NaN."""
        unknown = np.where(errors == 0, 0.0, np.nan)
        return cls(means, np.broadcast_to(unknown, (count, *means.shape)), np.zeros((*means.shape, 2)))

    @property
    def replicates(self):
        return len(self.deviations)

    def spread(self):
        return self

    def take(self, key):
        """Positions of the first axis."""
        return Spread(self.means[key], self.deviations[:, key], self.sizes[key])

    def with_band(self, band):
        return Spread(self.means[..., band], self.deviations[..., band], self.sizes[..., band, :])

    def summed(self, weights, axis=0):
        """The weighted sum over as many axes as the weights have, from a given one."""
        axes = tuple(range(axis, axis + weights.ndim))
        weights = weights.reshape(*weights.shape, *[1] * (self.means.ndim - len(axes) - axis))
        each = linear(self.means * weights, [(self, weights)])
        deviations = each.deviations.sum(axis=tuple(one + 1 for one in axes))
        return Spread(each.means.sum(axis=axes), deviations, np.sqrt((each.sizes**2).sum(axis=axes)))

    def estimates(self):
        """(*shape, 4): mean, standard error and interval."""
        numbers = _core.estimates(
            np.ascontiguousarray(self.means, float).ravel(),
            np.ascontiguousarray(self.deviations, float).reshape(self.replicates, -1),
            np.ascontiguousarray(self.sizes, float).reshape(-1, 2),
        )
        return numbers.reshape(*np.shape(self.means), 4)


def linear(means, terms):
    """The spread of a function, to first order. Replicate r of one term belongs to r of the others.

    Contributions of different terms are independent.

    Parameters
    ----------
    means : array_like
        Values of the function.
    terms : list
        Pairs of an argument, a Spread, and the derivative by it.
    """
    means = np.asarray(means, float)
    deviations, squares = 0.0, np.zeros((*means.shape, 2))
    for spread, slope in terms:
        added = (1,) * (means.ndim - spread.means.ndim)
        own = spread.deviations.reshape(spread.replicates, *added, *spread.means.shape)
        deviations = deviations + slope * own
        slope = np.asarray(slope)[..., None]
        sizes = np.where(slope < 0, spread.sizes[..., ::-1], spread.sizes) * np.abs(slope)
        squares = squares + sizes**2
    deviations = np.broadcast_to(deviations, (len(deviations), *means.shape))
    return Spread(means, deviations, np.sqrt(squares))
