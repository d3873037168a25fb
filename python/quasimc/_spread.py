"""Numbers replicate by replicate.

What lies behind estimates is called their source. All sources have

- ``ndim``, and the number of ``replicates``;
- ``with_band(i)``: one band, of the last axis, or several;
- ``take(key)`` and ``take_inner(key)``: an index or an array of them, of the first or second axis;
- ``summed(factors, axes)``: the sum over axes other than that of bands, of the numbers times exact
  factors of the same shape;
- ``spread()``: the deviations of the replicates, as a `Spread`;
- ``estimates()``: (..., 4), mean, standard error and ends of the interval.
"""

from __future__ import annotations

import numpy as np

from . import _core


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
    def of_bands(cls, spreads):
        """Numbers of several bands, whose axis is the last one."""
        return cls(
            np.stack([spread.means for spread in spreads], axis=-1),
            np.stack([spread.deviations for spread in spreads], axis=-1),
            np.stack([spread.sizes for spread in spreads], axis=-2),
        )

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
    def ndim(self):
        return np.ndim(self.means)

    @property
    def replicates(self):
        return len(self.deviations)

    def spread(self):
        return self

    def at(self, index):
        """Numbers at a tuple of indices."""
        return Spread(self.means[index], self.deviations[(slice(None), *index)], self.sizes[index])

    def take(self, key):
        return self.at((key,))

    def take_inner(self, key):
        return self.at((slice(None), key))

    def with_band(self, band):
        return Spread(self.means[..., band], self.deviations[..., band], self.sizes[..., band, :])

    def summed(self, factors, axes=(0,)):
        """Contributions to different numbers are taken as independent."""
        with np.errstate(invalid="ignore"):
            used = np.where(factors == 0, 0.0, self.means) * factors
            each = linear(used, [(self, factors)])
        deviations = np.where(factors == 0, 0.0, each.deviations).sum(axis=tuple(a + 1 for a in axes))
        return Spread(each.means.sum(axis=axes), deviations, np.sqrt((each.sizes**2).sum(axis=axes)))

    def estimates(self):
        numbers = _core.estimates(
            np.ascontiguousarray(self.means, float).ravel(),
            np.ascontiguousarray(self.deviations, float).reshape(self.replicates, -1),
            np.ascontiguousarray(self.sizes, float).reshape(-1, 2),
        )
        return numbers.reshape(*np.shape(self.means), 4)


def paired(sources):
    """The number of replicates of all. Raises ValueError if it differs."""
    counts = sorted({source.replicates for source in sources})
    if len(counts) > 1:
        raise ValueError(f"{counts[0]} and {counts[1]} replicates: they can't be paired")
    return counts[0]


def linear(means, terms):
    """The spread of a function, to first order. Replicate r of one term belongs to r of the others.

    Contributions of different terms are taken as independent.

    Parameters
    ----------
    means : array_like
        Values of the function.
    terms : list
        Pairs of an argument, a Spread, and the derivative by it.
    """
    means = np.asarray(means, float)
    deviations, squares = None, np.zeros((*means.shape, 2))
    for spread, slope in terms:
        added = (1,) * (means.ndim - spread.means.ndim)
        own = spread.deviations.reshape(spread.replicates, *added, *spread.means.shape)
        own = slope * own
        if deviations is not None and np.shape(deviations) == np.shape(own):
            deviations += own
        else:
            deviations = own if deviations is None else deviations + own
        squares += _sizes(spread.sizes, np.asarray(slope)[..., None]) ** 2
    if deviations.shape[1:] != means.shape:
        deviations = np.broadcast_to(deviations, (len(deviations), *means.shape))
    return Spread(means, deviations, np.sqrt(squares))


def _sizes(sizes, slope):
    """Sizes of a contribution times a slope: where it is below 0, one more makes the number less."""
    if slope.size == 1:
        return (sizes if slope.item() >= 0 else sizes[..., ::-1]) * abs(slope.item())
    return np.where(slope < 0, sizes[..., ::-1], sizes) * np.abs(slope)
