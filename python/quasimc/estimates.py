"""Estimates: arrays of numbers with standard errors and confidence intervals."""

from __future__ import annotations

import operator

import numpy as np

from . import _arithmetic as arithmetic
from ._format import pair
from ._units import shown

_NO_FLOAT = "take light.sum(), light.mean() or light[0]"


class Estimates(np.lib.mixins.NDArrayOperatorsMixin):
    """Numbers with standard errors and 95 % confidence intervals, which behave as an array.

    The first axis is that of organs (or groups, bins, ...), the last one that of bands; light of a
    sweep or a series has its points or times before the organs.
    ``light["PAR"]`` selects a band, ``light[3]``, ``light[1:4]`` and ``light[mask]`` select by position,
    and `at` selects by id or name. Sums and arithmetic keep the errors: they are computed replicate by
    replicate, never added in quadrature, and replicate r of one is paired with replicate r of the other.
    ``np.asarray(light)`` are the values alone.

    Intervals contain the values and end at physical bounds (docs/theory/statistics.md); after
    differences, ratios and functions they have no bounds.

    Attributes
    ----------
    name : str
        Name of the quantity.
    bands : tuple of str
        Names of the bands; empty for one band or none.
    index : OrganIndex, GroupIndex, RunIndex or None
        The meaning of the first axis; ``index.keys`` are ids of organs, values of groups, or times.
    extensive : bool
        Whether sums over organs have a meaning: those of fluxes have, those of densities have not.
    """

    __slots__ = ("_values", "_source", "_origins", "_units", "name", "bands", "index", "extensive")

    def __init__(
        self, values, name, unit, bands=(), *, index=None, source=None, origins=None, extensive=True
    ):
        self._values = values  # (..., 4): mean, standard error, ends of the interval
        self._source = source  # a Combination or a Spread; None: replicates are not known
        self._origins = origins or {}  # name -> function that returns Estimates
        self._units = (unit,) if isinstance(unit, str) else tuple(unit)
        self.name = name
        self.bands = tuple(bands)
        self.index = index
        self.extensive = extensive

    # Values and errors.

    @property
    def values(self):
        """Values."""
        return self._values[..., 0]

    @property
    def standard_error(self):
        """Standard errors; NaN where unknown (one replicate, no light sampled, replicates not kept)."""
        return self._values[..., 1]

    @property
    def ci95_low(self):
        """Lower ends of the 95 % confidence intervals."""
        return self._values[..., 2]

    @property
    def ci95_high(self):
        """Upper ends of the 95 % confidence intervals."""
        return self._values[..., 3]

    @property
    def relative_error(self):
        """standard_error / the absolute value; NaN where the value is 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.values != 0, self.standard_error / np.abs(self.values), np.nan)

    @property
    def shape(self):
        return self._values.shape[:-1]

    @property
    def ndim(self):
        return self._values.ndim - 1

    @property
    def size(self):
        return int(np.prod(self.shape))

    @property
    def unit(self):
        """Unit: str. Raises ValueError if bands have different ones."""
        if len(set(self._units)) > 1:
            raise ValueError(f"the bands of {self.name} have different units: use light.units")
        return self._units[0]

    @property
    def units(self):
        """Unit of each band: dict, band -> str."""
        return dict(zip(self.bands, self._units * max(len(self.bands), 1)))

    def with_unit(self, unit):
        """The same numbers with another name of the unit; nothing is converted."""
        result = self._like(self._values, self._source)
        result._set_unit(unit)
        return result

    @property
    def has_replicates(self):
        """Whether sums and differences have errors."""
        return self._source is not None

    # Selection.

    @property
    def _has_rows(self):
        """Whether the first axis is not that of bands."""
        return self.ndim > (1 if self.bands else 0)

    def __getitem__(self, key):
        if isinstance(key, str):
            return self._band(key)
        if self.ndim == 0:
            raise IndexError(f"{self.name} is a single number")
        if isinstance(key, tuple):
            return self._by_axes(key)
        rows = self._rows(key)
        values = self._values[rows]
        source = self._source.take(rows) if self._source is not None and self._has_rows else None
        if not self._has_rows:  # positions of bands
            source = None if self._source is None else self._source.spread().with_band(rows)
            return Estimates(
                values,
                self.name,
                np.asarray(self._units * len(self.bands))[: len(self.bands)][rows].tolist(),
                np.asarray(self.bands)[rows].tolist() if np.ndim(rows) else (),
                source=source,
                extensive=self.extensive,
            )
        if np.ndim(rows) == 0:
            index = self._inner
        else:
            index = None if self.index is None else self.index.take(rows)
        return self._mapped(values, source, index, lambda part: part[key])

    def _by_axes(self, keys):
        """An index for each axis: an integer takes one away, and the first of two may also be several."""
        first, *others = keys
        result = self[first]
        if others and (isinstance(first, slice) or np.ndim(first)):
            if len(others) > 1 or len(self._row_shape) != 2:
                raise TypeError(f"{self.name}[{keys}]: index axis by axis, as light[2][3]")
            return result._within(others[0])
        return result[tuple(others)] if len(others) > 1 else result[others[0]] if others else result

    def _within(self, key):
        """Positions of the second axis of rows."""
        rows = self._rows(key, self.shape[1])
        source = None if self._source is None else self._source.each(lambda part: part.take(rows))
        keeps_inner = self._inner is not None and np.ndim(rows)
        index = self.index
        if index is not None:
            index = index.with_inner(self._inner.take(rows) if keeps_inner else None)
        return self._mapped(self._values[:, rows], source, index, lambda part: part._within(key))

    @property
    def _row_shape(self):
        """The shape without the axis of bands."""
        return self.shape[:-1] if self.bands else self.shape

    @property
    def _inner(self):
        """The meaning of the second axis of rows; None: it has none."""
        return getattr(self.index, "inner", None)

    def _band(self, band):
        if band not in self.bands:
            known = ", ".join(self.bands) or "none"
            near = [b for b in self.bands if b.lower() == band.lower()]
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise KeyError(f"there is no band {band!r}{hint}; there are: {known}")
        i = self.bands.index(band)
        result = self._mapped(
            self._values[..., i, :],
            None if self._source is None else self._source.with_band(i),
            self.index,
            lambda part: part[band],
        )
        result.bands = ()
        result._units = (self._units[i if len(self._units) > 1 else 0],)
        return result

    def _rows(self, key, count=None):
        """Positions of the first axis (or of one of `count`): an integer or an array of them."""
        count = self.shape[0] if count is None else count
        try:
            if isinstance(key, slice):
                return np.arange(count)[key]
            if np.ndim(key) == 0 and not isinstance(key, (bool, np.bool_)):
                return np.arange(count)[operator.index(key)]
            key = np.asarray(key)
            if key.size == 0 and key.dtype != bool:
                key = key.astype(int)
            if key.ndim != 1 or key.dtype.kind not in "biu":
                raise TypeError
            return np.arange(count)[key]
        except TypeError:
            raise TypeError(
                f"{key!r} is no position, slice, mask or band; by id or name: light.at(...)"
            ) from None
        except IndexError as error:
            if np.ndim(key) == 0:
                hint = f"; by id: light.at({int(key)})" if self.index is not None else ""
                raise IndexError(f"position {int(key)} of {count}{hint}") from None
            raise IndexError(str(error)) from None

    def at(self, key):
        """The estimates of an organ or group, or of several in the given order.

        Parameters
        ----------
        key : int, str, or sequence of them
            Id (int) or name (str) of an organ; value of a group or of a point; time.

        Raises
        ------
        KeyError
            If there is none, or if several have the name.
        """
        if self.index is None:
            raise KeyError(f"{self.name} has no organs or groups")
        if isinstance(key, (list, np.ndarray)):
            return self[np.array([self.index.find(one) for one in key], int)]
        return self[self.index.find(key)]

    def where(self, mask):
        """The estimates of a mask: the same as ``light[mask]``."""
        return self[np.asarray(mask, bool)]

    @property
    def origins(self):
        """Names of the origins whose light is known apart: tuple of str."""
        return tuple(self._origins)

    def origin(self, name):
        """Returns the part that came from an origin of a run with `origins`: Estimates.

        The values of all origins add up to those of all light, but for values that are moved to a
        physical bound. Raises KeyError if there is no such origin.
        """
        if name not in self._origins:
            known = ", ".join(self._origins) or "none; run with origins"
            raise KeyError(f"there is no origin {name!r}; there are: {known}")
        return self._origins[name]()

    # Sums.

    def sum(self, axis=None, dtype=None, out=None, *, where=None, weights=None):
        """The sum over organs, groups, sensors or points, with its error; the axis of bands stays.

        Parameters
        ----------
        axis : int or str
            None: all but that of bands; or one of them, by number or name: "organ", "point", "time".
        where : array_like of bool
            Mask of what is summed: of the axis, or of all axes.
        weights : array_like
            Factors of any sign, in the shape of a mask; a density may then be summed.

        Raises
        ------
        ValueError
            For a quantity per area, and over times, without weights.
        """
        first, shape = self._summed_axes(axis, dtype, out)
        if weights is None:
            self._check_sum(first)
            weights = np.ones(shape)
        return self._weighted(self._factors(weights, where, shape), first)

    def mean(self, axis=None, dtype=None, out=None, *, where=None):
        """The plain mean over organs, groups, sensors or points, with its error; bands stay.

        The arguments are those of `sum`.
        """
        first, shape = self._summed_axes(axis, dtype, out)
        mask = self._factors(np.ones(shape), where, shape)
        if not mask.any():
            raise ValueError(f"the mean of {self.name} over nothing")
        return self._weighted(mask / np.count_nonzero(mask), first)

    def average(self, weights="area", *, axis=None, where=None):
        """The mean weighted by area, or by an array of weights, with its error; see `sum`."""
        first, shape = self._summed_axes(axis, None, None)
        if isinstance(weights, str):
            areas = getattr(self.index, "areas", None)
            if weights != "area" or areas is None or shape[-1:] != np.shape(areas):
                raise ValueError('weights: give "area" for light of organs or groups, or an array')
            weights = areas
        weights = self._factors(weights, where, shape)
        total = weights.sum()
        if total == 0:
            raise ValueError(f"the weights of the average of {self.name} add up to 0")
        return self._weighted(weights / total, first)

    def _summed_axes(self, axis, dtype, out):
        """The first axis that is summed, and the shape of all that are."""
        if dtype is not None or out is not None:
            raise TypeError("estimates take no dtype and no out")
        if not self._has_rows:
            raise ValueError(f"{self.name} has nothing to sum over; the axis of bands is not summed")
        shape = self._row_shape
        if axis is None:
            return 0, shape
        names = [getattr(index, "axis", None) for index in (self.index, self._inner)][: len(shape)]
        axis = axis[0] if isinstance(axis, tuple) and len(axis) == 1 else axis
        if np.ndim(axis) > 0:
            raise TypeError("an axis is a number or a name; a mask is given as where=")
        axis = names.index(axis) if isinstance(axis, str) and axis in names else axis
        if axis not in range(min(len(shape), 2)):
            known = ", ".join(repr(name) if name else str(i) for i, name in enumerate(names))
            raise ValueError(f"axis {axis!r} can't be summed; give one of {known}")
        return axis, shape[axis : axis + 1]

    def _check_sum(self, first):
        """Refuses a sum that means nothing. @param first: the first axis of it"""
        if first == 0 and getattr(self.index, "axis", None) == "time":
            raise ValueError(
                f"{self.name} at several times is a rate: use series.total or series.days, give "
                'weights (seconds), or sum over axis="organ"'
            )
        if not self.extensive:
            raise ValueError(
                f"{self.name} is per area: use the flux, average(), or mean() for the plain mean"
            )

    def _factors(self, weights, where, shape):
        """Weights in the shape of the summed axes, 0 where a mask is false."""
        weights = self._in_shape(np.asarray(weights, float), shape, "weights")
        if where is None:
            return weights
        where = np.asarray(where)
        if where.dtype != bool:
            raise ValueError("where is no mask of bool")
        return np.where(self._in_shape(where, shape, "a mask"), weights, 0.0)

    def _in_shape(self, array, shape, what):
        if array.shape not in (shape, shape[1:] if len(shape) > 1 else shape):
            raise ValueError(f"{what} of the shape {array.shape} for numbers of the shape {shape}")
        return np.broadcast_to(array, shape)

    def _weighted(self, weights, first):
        """The weighted sum over as many axes as the weights have, from the first one."""
        if self._source is not None:
            source = self._source.summed(weights, first) if first else self._source.summed(weights)
            values = source.estimates()
        else:
            source, values = None, self._sum_of_unknown(weights, first)
        index = self._inner if weights.ndim == 1 and not first else None
        if first:
            index = None if self.index is None else self.index.with_inner(None)
        return self._mapped(values, source, index, lambda part: part._weighted(weights, first))

    def _sum_of_unknown(self, weights, first):
        """The sum of values whose replicates are not known."""
        axes = tuple(range(first, first + weights.ndim))
        weights = weights.reshape(*weights.shape, *[1] * (self.ndim - first - weights.ndim))
        means = np.where(weights != 0, weights * self.values, 0.0).sum(axis=axes)
        if np.all((weights == 0) | (self.standard_error == 0)):
            return np.stack([means, np.zeros_like(means), means, means], axis=-1)
        arithmetic.warn_of_unknown([self])
        return arithmetic.unknown(means)

    # Arrays and numbers.

    def __array__(self, dtype=None, copy=None):
        if copy is False:
            raise ValueError("the values of estimates are always copied")
        return np.array(self.values, dtype=dtype or float)

    def __array_ufunc__(self, ufunc, method, *inputs, **keywords):
        if method != "__call__" or keywords:
            if ufunc in (np.maximum, np.minimum):
                raise TypeError(
                    "the largest of uncertain numbers is biased upwards: use light.values.max()"
                )
            raise TypeError(f"np.{ufunc.__name__}.{method} of estimates: use light.values")
        return arithmetic.apply(ufunc, inputs, lambda x: isinstance(x, Estimates))

    def __len__(self):
        if self.ndim == 0:
            raise TypeError(f"{self.name} is a single number")
        return self.shape[0]

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __float__(self):
        if self.ndim:
            raise TypeError(f"{self.size} estimates are no number; {_NO_FLOAT}")
        return float(self.values)

    def __bool__(self):
        raise TypeError("estimates are neither true nor false; compare light.values")

    __hash__ = None

    def differs(self, other):
        """Whether the 95 % interval of the difference excludes 0: array of bool."""
        difference = self - other
        return (difference.ci95_low > 0) | (difference.ci95_high < 0)

    # Making others.

    def _like(self, values, source, *, shape=None, index=None):
        """Other numbers of the same name, unit and bands."""
        if index is None and (shape is None or shape[:1] == self.shape[:1]):
            index = self.index
        return Estimates(
            values,
            self.name,
            self._units,
            self.bands,
            index=index,
            source=source,
            extensive=self.extensive,
        )

    def _mapped(self, values, source, index, to_part):
        """A selection or sum, also of the parts by origin."""
        origins = {
            name: (lambda part=part: to_part(part())) for name, part in self._origins.items()
        }
        return Estimates(
            values,
            self.name,
            self._units,
            self.bands,
            index=index,
            source=source,
            origins=origins,
            extensive=self.extensive,
        )

    def _set_unit(self, unit):
        self._units = (unit,) * len(self._units)

    def _set_units(self, units):
        self._units = tuple(units)

    def __reduce__(self):
        return _restored, (
            np.array(self._values),
            self.name,
            self._units,
            self.bands,
            self.index,
            None if self._source is None else self._source.spread(),
            {name: part() for name, part in self._origins.items()},
            self.extensive,
        )

    # Text.

    def __format__(self, spec):
        if self.ndim:
            raise TypeError(f"{self.size} estimates can't be formatted as one; {_NO_FLOAT}")
        text = pair(float(self.values), float(self.standard_error), spec)
        return f"{text} {shown(self.unit)}".rstrip()

    def __str__(self):
        return repr(self)

    def __repr__(self):
        if self.ndim == 0:
            return format(self, "")
        of = f" {', '.join(self.bands)}" if self.bands else ""
        unit = ", ".join(dict.fromkeys(shown(unit) for unit in self._units))
        axes = [getattr(index, "axis", None) for index in (self.index, self._inner)]
        axes = [f"{count} {axis}s" for count, axis in zip(self._row_shape, axes) if axis]
        count = " x ".join(axes) if axes else "x".join(map(str, self.shape))
        flat = self._values.reshape(-1, 4)
        first = ", ".join(pair(*numbers[:2]) for numbers in flat[:3])
        more = ", ..." if len(flat) > 3 else ""
        total = ""
        is_of_runs = hasattr(self.index, "inner")
        if self._has_rows and self.extensive and not (self.bands or is_of_runs) and self.has_replicates:
            total = f"; sum {pair(*self.sum()._values[:2])}"
        return f"<{self.name}{of}{f' [{unit}]' if unit else ''}, {count}: {first}{more}{total}>"

    def _repr_html_(self):
        from ._html import estimates_html

        return estimates_html(self)

    def to_pandas(self):
        """A pandas.DataFrame with the columns value and standard_error, or one pair for each band.

        Its index are ids of organs, values of groups, values of the points of a sweep, or times.
        """
        import pandas

        if self.ndim == 0 or (len(self._row_shape) > 1 and self._inner is None):
            raise ValueError(f"{self.name} of the shape {self.shape} makes no table")
        columns = {}
        for band in self.bands if self._has_rows and self.bands else ("",):
            own = self._band(band) if band else self
            columns[band or "value"] = own.values.ravel()
            columns[f"{band}_se" if band else "standard_error"] = own.standard_error.ravel()
        keys = None if self.index is None else self.index.to_pandas()
        if self.bands and not self._has_rows:
            keys = pandas.Index(self.bands)
        frame = pandas.DataFrame(columns, index=keys)
        frame.attrs["units"] = dict.fromkeys(columns, self._units[0]) if not self.bands else self.units
        return frame

    def to_pint(self, registry=None):
        """The values and their standard errors as two quantities of pint.

        Parameters
        ----------
        registry : pint.UnitRegistry
            Default: the one of the application.

        Returns
        -------
        tuple
            Two pint.Quantity, each of the shape of the estimates.

        Raises
        ------
        ValueError
            If the bands have different units: choose one, ``light["PAR"].to_pint()``.
        ImportError
            If pint is missing.
        """
        from ._exchange import to_pint

        return to_pint(np.array(self.values), np.array(self.standard_error), self.unit, registry)


def _restored(values, name, units, bands, index, spread, origins, extensive):
    parts = {origin: (lambda part=part: part) for origin, part in origins.items()}
    return Estimates(
        values, name, units, bands, index=index, source=spread, origins=parts, extensive=extensive
    )
