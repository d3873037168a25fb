"""Weighted sums of organs' light, which the engine estimates as it does those of groups."""

from __future__ import annotations

import numpy as np

from . import _core
from ._first_order import FirstOrder
from ._lights import Lights
from ._rows import Rows
from ._spread import Spread


class Combination:
    """Weighted sums of one quantity: a source of estimates (see `_spread`)."""

    __slots__ = ("_lights", "_quantity", "_rows", "_band", "_is_single", "_sums")

    #: Stands for the sunlit area, which has no bands.
    SUNLIT = len(_core.quantities())

    def __init__(self, lights, quantity, rows, band=None, is_single=False):
        self._lights = lights
        self._quantity = quantity
        self._rows = rows
        self._band = 0 if quantity == self.SUNLIT else band
        self._is_single = is_single  # of one row, whose axis is dropped
        self._sums = None  # of the rows, by band

    def _with(self, rows, is_single=False):
        return Combination(self._lights, self._quantity, rows, self._band, is_single)

    @property
    def ndim(self):
        return int(not self._is_single) + int(self._has_bands)

    @property
    def _has_bands(self):
        return self._band is None or np.ndim(self._band) > 0

    @property
    def replicates(self):
        return self._lights.count

    @property
    def key(self):
        """What it is a sum of, and its shape: terms of the same may be joined."""
        rows = None if self._is_single else len(self._rows)
        return self._lights.run, self._quantity, tuple(self._bands()), self._has_bands, rows

    def _bands(self):
        return range(self._lights.bands) if self._band is None else np.atleast_1d(self._band).tolist()

    def with_band(self, band):
        bands = band if self._band is None else np.asarray(self._band)[band]
        return Combination(self._lights, self._quantity, self._rows, bands, self._is_single)

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
        terms = [
            (self._with(self._rows.weighted(part).merged(), True), sign)
            for sign, part in ((1.0, np.maximum(weights, 0)), (-1.0, np.maximum(-weights, 0)))
            if part.any() or (sign > 0 and not weights.any())
        ]
        return terms[0][0] if terms[0][1] > 0 and len(terms) == 1 else FirstOrder.of_terms(terms)

    def unit(self):
        """The light of rows of one organ each, and the weights of these; of other rows itself, and 1."""
        weights = self._rows.weights
        if not self._rows.are_organs or np.all(weights == 1):
            return self, 1.0
        rows = self._rows.unit()
        equal = len(weights) and np.all(weights == weights[0])
        return self._of(self._lights, rows), float(weights[0]) if equal else self._shaped(weights)

    def joined(self, slope, others):
        """The sum of this times a slope and of others: a list of terms, as few as may be.

        Parameters
        ----------
        slope : float or numpy.ndarray
        others : list
            Terms of the same key: pairs of a Combination and a slope.
        """
        terms = [(self, slope), *others]
        slopes = [own for _, own in terms]
        lights, rows = Lights.of_same(
            [(light._lights, light._rows) for light, _ in terms], self._quantity, self._bands()
        )
        first = rows[0]
        if first.are_organs and all(np.array_equal(first.organs, each.organs) for each in rows):
            unit = self._of(lights, first.unit())
            return [(unit, sum(own * self._shaped(each.weights) for own, each in zip(slopes, rows)))]
        common, by_row = 1.0, [self._by_row(own) for own in slopes]
        if any(own is None for own in by_row) and np.all(slope):  # as seconds in units of each band
            common, by_row = slope, [self._by_row(own / slope) for own in slopes]
        if any(own is None for own in by_row):
            return terms
        return [(self._of(lights, part), sign * common) for sign, part in Rows.added(rows, by_row)]

    def _shaped(self, weights):
        """Weights of the rows in the shape of slopes."""
        weights = weights[0] if self._is_single else weights
        return weights[..., None] if self._has_bands else weights

    def _of(self, lights, rows):
        return Combination(lights, self._quantity, rows, self._band, self._is_single)

    def _by_row(self, slope):
        """One factor for each row; None if bands have factors of their own, or there are more."""
        slope = np.asarray(slope, float)
        if slope.ndim > self.ndim:
            return None
        if self._has_bands and slope.ndim:
            if not np.all(slope == slope[..., :1]):
                return None
            slope = slope[..., 0]
        return np.broadcast_to(slope, len(self._rows))

    def _sums_by_band(self):
        """The sums by band, each of the length of the rows."""
        if self._sums is None:
            self._sums = [
                self._lights.light(self._quantity, band).combined(*self._rows.arrays())
                for band in self._bands()
            ]
        return self._sums

    def estimates(self):
        bands = [sums.estimates() for sums in self._sums_by_band()]
        values = np.stack(bands, axis=1) if self._has_bands else bands[0]
        return values[0] if self._is_single else values

    def spread(self):
        if self._rows.are_organs and not self._is_single:
            lights = (self._lights.light(self._quantity, band) for band in self._bands())
            bands = [self._rows.read(light) for light in lights]
        else:
            bands = [Spread(sums.means, sums.deviations, sums.sizes) for sums in self._sums_by_band()]
        spread = Spread.of_bands(bands) if self._has_bands else bands[0]
        return spread.take(0) if self._is_single else spread

    def __reduce__(self):
        """Keeps what its rows need: light of organs, or of the sums that were made of them."""
        rows = self._rows
        if rows.are_organs:
            organs, entries = np.unique(rows.organs, return_inverse=True)
            parts, labels = Rows.of_organs(organs), self._lights.labels_of(organs)
            rows = Rows(rows.starts, entries, rows.weights)
        else:
            parts, labels = rows, rows.labels(self._lights.labels_of(rows.organs))
            rows = Rows.of_organs(np.arange(len(rows)))
        lights = self._lights.kept(parts, labels, self._quantity, self._bands())
        return Combination, (lights, self._quantity, rows, self._band, self._is_single)
