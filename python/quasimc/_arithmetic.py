"""Arithmetic of estimates: their errors come from the replicates, paired by number."""

from __future__ import annotations

import warnings

import numpy as np

from ._first_order import FirstOrder
from ._spread import Spread, paired
from ._units import product
from .errors import QuasimcWarning

#: Functions of the values alone, which return plain arrays of bool.
_TESTS = (
    np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.not_equal,
    np.isnan, np.isfinite, np.isinf, np.signbit,
)  # fmt: skip

#: Functions of one argument, each with its derivative and the unit of its value.
_FUNCTIONS = {
    np.negative: (lambda x: -np.ones_like(x), lambda unit: unit),
    np.positive: (np.ones_like, lambda unit: unit),
    np.absolute: (np.sign, lambda unit: unit),
    np.sqrt: (lambda x: 0.5 / np.sqrt(x), lambda unit: ""),
    np.square: (lambda x: 2 * x, lambda unit: product(unit, unit)),
    np.exp: (np.exp, lambda unit: ""),
    np.expm1: (np.exp, lambda unit: ""),
    np.log: (lambda x: 1 / x, lambda unit: ""),
    np.log1p: (lambda x: 1 / (1 + x), lambda unit: ""),
    np.log10: (lambda x: 1 / (x * np.log(10)), lambda unit: ""),
}

_SIGNS = {np.add: "+", np.subtract: "-", np.multiply: "*", np.true_divide: "/", np.power: "**"}


def apply(ufunc, inputs, is_estimate):
    """A function of numpy on estimates. Raises TypeError for one whose errors are not known."""
    if ufunc in _TESTS:
        return ufunc(*[x.values if is_estimate(x) else x for x in inputs])
    if ufunc in _FUNCTIONS:
        return _function(ufunc, inputs[0])
    if ufunc is np.matmul:
        return _product_of_vectors(*inputs, is_estimate)
    if ufunc not in _SIGNS:
        raise TypeError(
            f"{ufunc.__name__} of estimates: use light.values, or "
            f"quasimc.propagate(np.{ufunc.__name__}, light)"
        )
    a, b = (x if is_estimate(x) else np.asarray(x, float) for x in inputs)
    if is_estimate(a) and is_estimate(b):
        return _of_two(ufunc, a, b)
    if ufunc is np.add:
        return _shifted(a, b) if is_estimate(a) else _shifted(b, a)
    if ufunc is np.subtract:
        return _shifted(a, -b) if is_estimate(a) else _shifted(times(b, np.array(-1.0)), a)
    if ufunc is np.multiply:
        return times(a, b) if is_estimate(a) else times(b, a)
    if ufunc is np.true_divide and is_estimate(a):
        return times(a, 1 / b)
    if ufunc is np.power and is_estimate(a):
        return _power(a, b)
    if ufunc is np.true_divide:
        return _over(a, b)
    raise TypeError("a number to the power of estimates: use quasimc.propagate")


def times(light, factors):
    """Estimates times exact numbers. An array of them leaves no unit, and what may be summed."""
    shape = _shape_of(light, factors)
    source, values = None, None
    if np.all(factors >= 0) and shape == light.shape:
        values = light._values * factors[..., None]
        if hasattr(light._source, "scaled") and np.all(factors > 0):
            source = _scaled_rows(light, factors)
    if source is None and light._source is not None:
        source = FirstOrder.of(lambda x: x * factors, lambda x: [factors], [light._source])
    if values is None and source is None:
        values = _turned(light, factors)
    result = light._like(values, source, shape=shape)
    if factors.ndim:
        result._set_unit("")
        result.extensive = True
    return result


def _scaled_rows(light, factors):
    """The source times factors that are equal in all bands; None for others."""
    if factors.ndim == 0:
        return light._source.scaled(factors)
    if light.bands:
        if factors.ndim != 2 or factors.shape[1] != 1:
            return None
        factors = factors[:, 0]
    return light._source.scaled(factors) if factors.ndim == 1 else None


def _turned(light, factors):
    """Estimates of unknown deviations times factors of any sign."""
    values = light._values * factors[..., None]
    ends = np.sort(values[..., 2:], axis=-1)
    return np.concatenate([values[..., :1], np.abs(values[..., 1:2]), ends], axis=-1)


def _shifted(light, numbers):
    """Estimates plus exact numbers."""
    shape = _shape_of(light, numbers)
    moved = numbers[..., None] * np.array([1.0, 0, 1, 1])
    source = None
    if light._source is not None:
        source = FirstOrder.of(lambda x: x + numbers, lambda x: [1.0], [light._source])
    return light._like(light._values + moved, source, shape=shape)


def _shape_of(light, numbers):
    try:
        return np.broadcast_shapes(light.shape, numbers.shape)
    except ValueError:
        hint = "choose a band, or give the array another axis: x[:, None]" if light.bands else ""
        raise ValueError(
            f"{light.name} has the shape {light.shape} and the array {numbers.shape}"
            f"{'; ' if hint else ''}{hint}"
        ) from None


def _function(ufunc, light):
    slope, unit_of = _FUNCTIONS[ufunc]
    if ufunc is np.negative:
        return times(light, np.array(-1.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        result = of_sources(ufunc, lambda x: [slope(x)], [light])
    result.name = light.name if ufunc is np.positive else f"{ufunc.__name__}({light.name})"
    result._set_units([unit_of(unit) for unit in light._units])
    return result


def _power(light, power):
    result = of_sources(lambda x: x**power, lambda x: [power * x ** (power - 1)], [light])
    result._set_units([product("", unit, float(power)) if not power.ndim else "" for unit in light._units])
    return result


def _over(numbers, light):
    with np.errstate(divide="ignore", invalid="ignore"):
        result = of_sources(lambda x: numbers / x, lambda x: [-numbers / x**2], [light])
    result._set_units([product("", unit, -1) if not numbers.ndim else "" for unit in light._units])
    return result


def _of_two(ufunc, a, b):
    """Replicate r of one belongs to replicate r of the other."""
    slopes = {
        np.add: lambda x, y: (1.0, 1.0),
        np.subtract: lambda x, y: (1.0, -1.0),
        np.multiply: lambda x, y: (y, x),
        np.true_divide: lambda x, y: (1 / y, -x / y**2),
    }
    if ufunc not in slopes:
        raise TypeError("estimates to the power of estimates: use quasimc.propagate")
    if ufunc in (np.add, np.subtract) and set(a._units) != set(b._units):
        raise ValueError(f"the units differ: {a._units[0]!r} and {b._units[0]!r}; see with_unit()")
    with np.errstate(divide="ignore", invalid="ignore"):
        result = of_sources(ufunc, slopes[ufunc], [a, b])
    if a.name != b.name:
        result.name = f"{a.name} {_SIGNS[ufunc]} {b.name}"
    if ufunc in (np.multiply, np.true_divide):
        power = 1 if ufunc is np.multiply else -1
        count = max(len(a._units), len(b._units))
        left, right = (u * count if len(u) == 1 else u for u in (a._units, b._units))
        result._set_units([product(x, y, power) for x, y in zip(left, right)])
    else:
        result.extensive = a.extensive and b.extensive
    return result


def of_sources(function, slopes, arguments):
    """A function of estimates to first order in their deviations.

    Its errors are unknown if those of an argument are not kept.
    """
    index, bands = _common(arguments)
    sources = sources_of(arguments)
    if sources is None:
        warn_of_unknown(arguments)
        means = np.asarray(function(*[argument.values for argument in arguments]))
        values, source = unknown(means), None
    else:
        values, source = None, FirstOrder.of(function, slopes, sources)
    shape = source.means.shape if values is None else values.shape[:-1]
    first = max(arguments, key=lambda argument: argument.ndim)
    result = first._like(values, source, shape=shape, index=index)
    result.extensive = True
    return result


def _common(arguments):
    """The index and the bands of all. Raises ValueError if they differ."""
    index, bands = None, ()
    for argument in sorted(arguments, key=lambda each: -each.ndim):
        own = argument.index
        if not (index is None or own is None or own in (index, getattr(index, "inner", None))):
            raise ValueError(
                f"the {own.axis}s of {argument.name} differ: use quasimc.align(a, b)"
            )
        index = own if index is None else index
        if bands and argument.bands and bands != argument.bands:
            raise ValueError(
                f"the bands differ: {', '.join(bands)} and {', '.join(argument.bands)}"
            )
        bands = bands or argument.bands
    return index, bands


def sources_of(arguments):
    """The sources of estimates, of equal numbers of replicates; None if one is not known.

    Numbers without an error deviate in no replicate.
    """
    known = [a._source for a in arguments if a._source is not None]
    count = paired(known) if known else 2
    exact = [a for a in arguments if a._source is None]
    if not all(np.all(a.standard_error == 0) for a in exact):
        return None
    return [Spread.exact(a.values, count) if a._source is None else a._source for a in arguments]


def unknown(means):
    """Estimates whose errors are unknown."""
    nan = np.full(np.shape(means), np.nan)
    return np.stack([means, nan, nan, nan], axis=-1)


def warn_of_unknown(arguments):
    """Says why errors are not known, at the line of the caller."""
    from ._warn import warn_here

    names = ", ".join(sorted({light.name for light in arguments if light._source is None}))
    warn_here(
        [
            f"the replicates of {names} were not kept: errors of sums and differences are unknown; "
            'run with keep="replicates"; light on sensors and daylight coefficients have none: use '
            "average=True for sensors, and groups of the run"
        ]
    )


def _product_of_vectors(a, b, is_estimate):
    light, weights = (a, b) if is_estimate(a) else (b, a)
    if is_estimate(weights) or np.ndim(weights) != 1:
        raise TypeError("@ takes estimates and an array of one axis")
    return light.sum(weights=np.asarray(weights, float))


def jackknife(function, arguments):
    """The spread of any function by the delete-one jackknife over replicates.

    Returns it with the jackknife's estimate of the bias of the function of the means.
    """
    sources = sources_of(arguments)
    if sources is None:
        return None, None
    spreads = [source.spread() for source in sources]
    count = spreads[0].replicates
    value = np.asarray(function(*[spread.means for spread in spreads]), float)
    if count < 2:
        return Spread(value, np.zeros((count, *value.shape)), np.zeros((*value.shape, 2))), value * 0
    without = np.stack(
        [
            np.asarray(function(*[s.means - s.deviations[r] / (count - 1) for s in spreads]), float)
            for r in range(count)
        ]
    )
    centre = without.mean(axis=0)
    deviations = (count - 1) * (centre - without)
    spread = Spread(value, deviations, np.zeros((*value.shape, 2)))
    return spread, (count - 1) * (centre - value)


def warn_of_bias():
    warnings.warn(
        "the function is curved over the range of the error: use more paths",
        QuasimcWarning,
        stacklevel=3,
    )
