"""Numbers of several runs: points of a sweep, or time steps."""

from __future__ import annotations

import numpy as np

from ._spread import Spread, linear, paired


class Stack:
    """Numbers of several runs, each of its own source; the first axis is that of runs. A source itself.

    Runs may share their random numbers: a contribution that one of them lacks, others may lack too.
    """

    __slots__ = ("_parts", "_is_shared")

    def __init__(self, parts, is_shared):
        self._parts = list(parts)
        self._is_shared = is_shared

    def _with(self, parts):
        return Stack(parts, self._is_shared)

    @property
    def ndim(self):
        return 1 + self._parts[0].ndim

    @property
    def replicates(self):
        return paired(self._parts)

    def with_band(self, band):
        return self._with(part.with_band(band) for part in self._parts)

    def take(self, key):
        return self._parts[key] if np.ndim(key) == 0 else self._with(self._parts[row] for row in key)

    def take_inner(self, key):
        return self._with(part.take(key) for part in self._parts)

    def summed(self, factors, axes=(0,)):
        if 1 in axes:
            rows = self._with(part.summed(own) for part, own in zip(self._parts, factors))
            return rows if axes == (1,) else rows.summed(np.ones(len(factors)))
        spreads = self._spreads()
        means = sum(factor * spread.means for factor, spread in zip(factors, spreads))
        if not self._is_shared:
            return self._sum(means, factors)
        total = linear(means, list(zip(spreads, factors)))
        total.sizes = shared_sizes(spreads, factors)
        return total

    def _sum(self, means, factors):
        """A sum of runs, of which some are the same computation, scaled: its contributions add up."""
        from ._first_order import FirstOrder

        return FirstOrder.of_terms(list(zip(self._parts, factors)), means).spread()

    def _spreads(self):
        paired(self._parts)
        return [part.spread() for part in self._parts]

    def estimates(self):
        return np.stack([part.estimates() for part in self._parts])

    def spread(self):
        spreads = self._spreads()
        return Spread(
            np.stack([spread.means for spread in spreads]),
            np.stack([spread.deviations for spread in spreads], axis=1),
            np.stack([spread.sizes for spread in spreads]),
        )


def shared_sizes(spreads, factors):
    """One contribution to a weighted sum of runs with the same random numbers: it may be missing from all of
    them, so sizes of one sign add up; those of the other sign are as if independent."""
    above, below = (
        sum(
            np.maximum(sign * factor, 0.0)[..., None] * spread.sizes[..., ::sign]
            for factor, spread in zip(factors, spreads)
        )
        for sign in (1, -1)
    )
    return np.hypot(above, below)
