"""Sums of light over time steps, whose errors are independent."""

from __future__ import annotations

import numpy as np

from . import _core
from ._first_order import FirstOrder
from ._spread import paired


class TimeSum:
    """The weighted sum of the light of time steps: a source of estimates (see `_spread`).

    Its errors are those of the engine's sums over days: time steps have different random numbers, so
    their variances add. In arithmetic with other light its replicates are sums over time as well.
    """

    __slots__ = ("_parts", "_weights")

    def __init__(self, parts, weights):
        self._parts = list(parts)  # sources of equal shape
        self._weights = weights  # (steps,) or (steps, bands)

    def _with(self, parts):
        return TimeSum(parts, self._weights)

    @property
    def ndim(self):
        return self._parts[0].ndim

    @property
    def replicates(self):
        return paired(self._parts)

    @property
    def terms(self):
        return list(zip(self._parts, self._weights))

    def with_band(self, band):
        return TimeSum([part.with_band(band) for part in self._parts], self._weights[:, band])

    def take(self, key):
        return self._with(part.take(key) for part in self._parts)

    def summed(self, factors, axes=(0,)):
        return self._with(part.summed(factors, axes) for part in self._parts)

    def scaled(self, factors):
        """Times factors above 0, one for each row or for all; None for sums of both signs."""
        if not all(hasattr(part, "scaled") for part in self._parts):
            return None
        return self._with(part.scaled(factors) for part in self._parts)

    def spread(self):
        return FirstOrder.of_terms(self.terms).spread()

    def estimates(self):
        values = np.stack([part.estimates() for part in self._parts])
        values[..., 0] = np.stack([part.spread().means for part in self._parts])  # without bounds
        steps, shape = len(values), values.shape[1:-1]
        lacking = values.ndim - 1 - self._weights.ndim
        weights = self._weights.reshape(steps, *[1] * lacking, *self._weights.shape[1:])
        weights = np.broadcast_to(weights, (steps, *shape)).reshape(steps, -1)
        freedom = max(1, self.replicates - 1)
        sums = _core.sum_of_times(values.reshape(steps, -1, 4), weights, freedom)
        return sums.reshape(*shape, 4)


class TimeLights:
    """The light of time steps, of which that of a day is the weighted sum.

    Parameters
    ----------
    lights : list of Lights
    weights : numpy.ndarray
        (steps, bands).
    """

    def __init__(self, lights, weights):
        self._lights, self._weights = lights, weights

    def source(self, quantity, rows):
        """The weighted sums of rows of organs."""
        return TimeSum([lights.source(quantity, rows) for lights in self._lights], self._weights)

    def origin(self, name):
        """The light that came from an origin."""
        return TimeLights([lights.origin(name) for lights in self._lights], self._weights)
