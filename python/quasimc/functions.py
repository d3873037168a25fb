"""Functions of estimates."""

from __future__ import annotations

import numpy as np

from . import _arithmetic as arithmetic
from .estimates import Estimates


def _require_estimates(light, what):
    for one in light:
        if not isinstance(one, Estimates):
            raise TypeError(
                f"{what} takes Estimates, as result[quantity][band], not {type(one).__name__}"
            )


def propagate(function, *light, unit="", name=""):
    """Any function of estimates, with errors by the jackknife over replicates.

    The function is called with arrays of values, once for the values and once without each replicate.

    Parameters
    ----------
    function : callable
        Takes one array for each of `light`, and returns an array.
    *light : Estimates
        Replicate r of one is paired with replicate r of the others.
    unit, name : str
        Of the result.

    Returns
    -------
    Estimates
        Their errors are those that replicates show: without the size of single contributions of
        light. Unknown if the replicates of `light` were not kept.
    """
    _require_estimates(light, "propagate")
    index, bands = arithmetic._common(light)
    spread, bias = arithmetic.jackknife(function, light)
    if spread is None:
        arithmetic.warn_of_unknown(light)
        values = arithmetic.unknown(np.asarray(function(*[one.values for one in light]), float))
    else:
        values = spread.estimates()
        if np.mean(np.abs(bias) > values[..., 1]) > 0.05:
            arithmetic.warn_of_bias()
    shape = values.shape[:-1]
    first = max(light, key=lambda one: one.ndim)
    same_rows = index is not None and shape[:1] == (len(index),)
    same_bands = bool(bands) and shape[-1:] == (len(bands),)
    return Estimates(
        values,
        name or getattr(function, "__name__", "").replace("<lambda>", "") or first.name,
        unit,
        bands if same_bands else (),
        index=index if same_rows else None,
        source=spread,
    )


def align(a, b):
    """The estimates of the organs that both have, in the order of a: a pair of Estimates."""
    _require_estimates((a, b), "align")
    if a.index is None or b.index is None:
        raise TypeError("align takes light of organs or groups: result[quantity][band]")
    rows = {key: row for row, key in enumerate(list(b.index.keys))}
    pairs = [(row, rows[key]) for row, key in enumerate(list(a.index.keys)) if key in rows]
    first, second = np.array(pairs, int).reshape(-1, 2).T
    return a[first], b[second]
