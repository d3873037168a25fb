"""Light of several runs as one array."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ._spread import Spread
from ._stack import Stack
from .estimates import Estimates


def stacked(parts, runs):
    """The estimates of several runs as one, whose first axis is that of runs.

    Parameters
    ----------
    parts : list of Estimates
        Of equal shape and of the same organs.
    runs : RunIndex
        Their meaning; its `inner` is replaced.
    """
    first = parts[0]
    for part in parts:
        if part.shape != first.shape or not part.index == first.index:
            raise ValueError(
                f"the {runs.axis}s have different organs: take each alone, or use quasimc.align(a, b)"
            )
    origins = [name for name in first.origins if all(name in part.origins for part in parts)]
    return Estimates(
        np.stack([part._values for part in parts]),
        first.name,
        first._units,
        first.bands,
        index=runs.with_inner(first.index),
        source=_source_of(parts, runs.axis == "point"),
        origins={
            name: (lambda name=name: stacked([part.origin(name) for part in parts], runs))
            for name in origins
        },
        extensive=first.extensive,
    )


def _source_of(parts, is_shared):
    """What sums are made of; None if it is not known for any run.

    Points of a sweep share their random numbers, time steps do not.
    """
    known = [part._source for part in parts if part._source is not None]
    if not known:
        return None
    count = known[0].replicates
    sources = (
        Spread.of_values(part.values, part.standard_error, count) if part._source is None else part._source
        for part in parts
    )
    return Stack(sources, is_shared)


class StackedLight(Mapping):
    """Light of several runs by its quantity or part: ``light[quantity]`` has the axis of runs first."""

    def __init__(self, lights, runs):
        self._lights = lights
        self._runs = runs

    def __getitem__(self, name):
        return stacked([light[name] for light in self._lights], self._runs)

    def __iter__(self):
        return iter(self._lights[0])

    def __len__(self):
        return len(self._lights[0])
