"""Functions of light: their errors, and those of their sums."""

from __future__ import annotations

import numpy as np

from ._spread import linear, paired
from ._stack import Stack

#: More lights than these are no longer known one by one, so that a long sum of results frees them.
_MOST_TERMS = 64


class FirstOrder:
    """A function of several lights, to first order: a source of estimates (see `_spread`).

    Its sum is the sum of each light times the slope of the function by it: lights are summed before
    they meet. So the sum of a function has the error of the function of sums, wherever both are the
    same, and a contribution counts by its size in the sum, as the engine finds it for groups.
    """

    __slots__ = ("means", "terms", "_spread")

    def __init__(self, means, terms):
        self.means = means
        self._spread = None  # deviations are made when they are needed
        self.terms = terms
        if len(terms) > _MOST_TERMS:
            self.terms = [(self.spread(), 1.0)]

    @classmethod
    def of(cls, function, slopes, sources):
        """A function of sources whose shapes broadcast.

        Parameters
        ----------
        function, slopes : callable
            Of the values of all: the values of the function, and its derivatives.
        sources : list
        """
        units = [_unit(source) for source in sources]
        means = [_times(factor, _means_of(unit)) for unit, factor in units]
        values = np.asarray(function(*means), float)
        terms = []
        for (unit, factor), own, slope in zip(units, means, slopes(*means)):
            if own.shape != values.shape[values.ndim - own.ndim :]:
                unit = _broadcast(unit.spread(), values.shape)  # of one number along an axis
            terms.append((unit, _times(slope, factor)))
        return cls.of_terms(terms, values)

    @classmethod
    def of_terms(cls, terms, means=None):
        """The sum of lights times their slopes.

        Parameters
        ----------
        terms : list
            Pairs of a source and a slope.
        means : numpy.ndarray
            Values, if they are not the sum of the terms.
        """
        terms = joined_terms(
            [
                (inner, _times(own, slope))
                for light, slope in terms
                for inner, own in terms_of(light)
            ]
        )
        if means is None:
            means = sum(_means_of(light) * slope for light, slope in terms)
        return cls(means, terms)

    @property
    def ndim(self):
        return np.ndim(self.means)

    @property
    def replicates(self):
        return paired([light for light, _ in self.terms])

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
        shape = self.means.shape
        return FirstOrder(
            self.means[index],
            [
                (
                    select(light, self.ndim - light.ndim),
                    np.broadcast_to(slope, shape)[index] if np.ndim(slope) else slope,
                )
                for light, slope in self.terms
            ],
        )

    def summed(self, factors, axes=(0,)):
        used = factors != 0
        terms = [
            _summed(light, np.where(used, slope, 0.0) * factors, axes) for light, slope in self.terms
        ]
        means = (np.where(used, self.means, 0.0) * factors).sum(axis=axes)
        return FirstOrder.of_terms(terms, means)

    def spread(self):
        if self._spread is None:
            with np.errstate(divide="ignore", invalid="ignore"):
                terms = [(light.spread(), slope) for light, slope in self.terms]
                self._spread = linear(self.means, terms)
        return self._spread

    def estimates(self):
        return self.spread().estimates()


def _means_of(source):
    return source.means if hasattr(source, "means") else source.spread().means


def terms_of(source):
    """What a source is the sum of: pairs of a source and its slope."""
    return getattr(source, "terms", [(source, 1.0)])


def _unit(source):
    """A source without the factors of its rows, and these."""
    return source.unit() if hasattr(source, "unit") else (source, 1.0)


def _times(factor, numbers):
    return numbers if np.ndim(factor) == 0 and factor == 1 else factor * numbers


def joined_terms(terms):
    """Terms of which those of the same light are one, or one of each sign; the same list if all differ."""
    by_key = {}
    for light, slope in terms:
        by_key.setdefault(getattr(light, "key", light), []).append((light, slope))
    if len(by_key) == len(terms):
        return terms
    joined = []
    for (light, slope), *others in by_key.values():
        if all(other is light for other, _ in others):
            joined.append((light, sum([own for _, own in others], slope)))
        else:
            joined += light.joined(slope, others)
    return joined


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
