"""Functions of light: their errors, and those of their sums."""

from __future__ import annotations

import numpy as np

from ._spread import linear
from ._stack import Stack

#: More lights than these are no longer known one by one, so that a long sum of results frees them.
_MOST_TERMS = 64


class FirstOrder:
    """A function of several lights, to first order: a source of estimates (see `_spread`).

    Its sum is the sum of each light times the slope of the function by it: lights are summed before
    they meet. So the sum of a function has the error of the function of sums, wherever both are the
    same, and a contribution counts by its size in the sum, as the engine finds it for groups.
    """

    __slots__ = ("_spread", "_terms")

    def __init__(self, spread, terms):
        self._spread = spread
        self._terms = terms if len(terms) <= _MOST_TERMS else [(spread, 1.0)]

    @classmethod
    def of(cls, function, slopes, sources):
        """A function of sources whose shapes broadcast.

        Parameters
        ----------
        function, slopes : callable
            Of the values of all: the values of the function, and its derivatives.
        sources : list
        """
        spreads = [source.spread() for source in sources]
        means = [spread.means for spread in spreads]
        values = np.asarray(function(*means), float)
        derivatives = slopes(*means)
        terms = []
        for source, spread, slope in zip(sources, spreads, derivatives):
            inner = source._terms if isinstance(source, cls) else [(source, 1.0)]
            if spread.means.shape != values.shape[values.ndim - spread.ndim :]:
                inner = [(_broadcast(spread, values.shape), 1.0)]  # of one number along an axis
            terms += [(light, slope * own) for light, own in inner]
        return cls(linear(values, list(zip(spreads, derivatives))), terms)

    @property
    def ndim(self):
        return self._spread.ndim

    @property
    def replicates(self):
        return self._spread.replicates

    def with_band(self, band):
        def select(light, _):
            return light.with_band(band) if light.ndim else light

        return self._selected(self.ndim - 1, band, select)

    def take(self, key):
        return self._selected(0, key, lambda light, lacking: light if lacking else light.take(key))

    def take_inner(self, key):
        def select(light, lacking):
            return light.take_inner(key) if not lacking else light.take(key) if lacking == 1 else light

        return self._selected(1, key, select)

    def _selected(self, axis, key, select):
        """An index of one axis. @param select: of a light, and the number of first axes that it lacks"""
        index = (slice(None),) * axis + (key,)
        shape = self._spread.means.shape
        return FirstOrder(
            self._spread.at(index),
            [
                (
                    select(light, self.ndim - light.ndim),
                    np.broadcast_to(slope, shape)[index] if np.ndim(slope) else slope,
                )
                for light, slope in self._terms
            ],
        )

    def summed(self, factors, axes=(0,)):
        used = factors != 0
        terms = [
            _summed(light, np.where(used, slope, 0.0) * factors, axes) for light, slope in self._terms
        ]
        means = (np.where(used, self._spread.means, 0.0) * factors).sum(axis=axes)
        return FirstOrder(linear(means, [(light.spread(), slope) for light, slope in terms]), terms)

    def spread(self):
        return self._spread

    def estimates(self):
        return self._spread.estimates()


def _summed(light, factors, axes):
    """The sum of a light times factors, which may have axes before its own: a light and its slope."""
    lacking = factors.ndim - light.ndim
    before = tuple(axis for axis in axes if axis < lacking)
    own = tuple(axis - len(before) for axis in axes if axis >= lacking)
    factors = factors.sum(axis=before)
    if not own:
        return light, factors
    return _sum_of_each(light, factors, own), 1.0


def _sum_of_each(light, factors, axes):
    """The sum of a light for each index of the first axes of factors, which the light lacks."""
    if factors.ndim == light.ndim:
        return light.summed(factors, axes)
    inner = tuple(axis - 1 for axis in axes)
    return Stack([_sum_of_each(light, own, inner) for own in factors], is_shared=True)


def _broadcast(spread, shape):
    return linear(np.broadcast_to(spread.means, shape), [(spread, 1.0)])
