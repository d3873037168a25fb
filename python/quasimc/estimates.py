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

    The first axis is that of organs (or groups, bins, ...), the last one that of bands.
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
    index : OrganIndex, GroupIndex or None
        The meaning of the first axis; ``index.keys`` are ids of organs, or values of groups.
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
        is_one = np.ndim(rows) == 0
        index = None if self.index is None or is_one else self.index.take(rows)
        return self._mapped(values, source, index, lambda part: part[key])

    def _by_axes(self, keys):
        """An index for each axis; all but the last are integers, for each takes one axis away."""
        if not all(np.ndim(key) == 0 and not isinstance(key, slice) for key in keys[:-1]):
            raise TypeError(f"{self.name}[{keys}]: index axis by axis, as light[2][3]")
        result = self
        for key in keys:
            result = result[key]
        return result

    def _flat(self):
        """Several axes of rows, as of a grid of sensors, as one."""
        kept = 1 if self.bands else 0
        rows = -1 if self.size else 0
        values = self._values.reshape(rows, *self.shape[self.ndim - kept:], 4)
        return self._mapped(values, None, None, lambda part: part._flat())

    @property
    def _is_grid(self):
        return self.ndim - (1 if self.bands else 0) > 1

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

    def _rows(self, key):
        """Positions of the first axis: an integer or an array of them."""
        count = self.shape[0]
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
            Id (int) or name (str) of an organ; value of a group.

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
        """The sum over organs, groups or sensors, with its error; the axis of bands stays.

        Parameters
        ----------
        axis : int or str
            None: all but that of bands; 0 or its name: the first one.
        where : array_like of bool
            Mask of what is summed.
        weights : array_like
            (n,), factors of any sign; a density may then be summed.

        Raises
        ------
        ValueError
            For a quantity per area without weights.
        """
        self._check_axis(axis, dtype, out)
        if self._is_grid and axis is None:
            where, weights = (None if one is None else np.ravel(one) for one in (where, weights))
            return self._flat().sum(where=where, weights=weights)
        if weights is None and not self.extensive:
            raise ValueError(
                f"{self.name} is per area: use the flux, average(), or mean() for the plain mean"
            )
        return self._weighted(np.ones(self.shape[0]) if weights is None else weights, where, "sum")

    def mean(self, axis=None, dtype=None, out=None, *, where=None):
        """The plain mean over organs, groups or sensors, with its error; the axis of bands stays."""
        self._check_axis(axis, dtype, out)
        if self._is_grid and axis is None:
            return self._flat().mean(where=None if where is None else np.ravel(where))
        mask = np.ones(self.shape[0], bool) if where is None else np.asarray(where, bool)
        count = np.count_nonzero(mask)
        if not count:
            raise ValueError(f"the mean of {self.name} over nothing")
        return self._weighted(mask / count, None, "mean")

    def average(self, weights="area", *, where=None):
        """The mean weighted by area, or by an array (n,) of weights, with its error."""
        self._check_axis(None, None, None)
        if isinstance(weights, str):
            if weights != "area" or self.index is None:
                raise ValueError('weights: give "area" for light of organs or groups, or an array')
            weights = self.index.areas
        weights = np.asarray(weights, float)
        if where is not None:
            weights = np.where(np.asarray(where, bool), weights, 0)
        total = weights.sum()
        if total == 0:
            raise ValueError(f"the weights of the average of {self.name} add up to 0")
        return self._weighted(weights / total, None, "average")

    def _check_axis(self, axis, dtype, out):
        if dtype is not None or out is not None:
            raise TypeError("estimates take no dtype and no out")
        if not self._has_rows:
            raise ValueError(f"{self.name} has nothing to sum over; the axis of bands is not summed")
        name = getattr(self.index, "axis", None)
        if axis is not None and axis not in (0, name) and axis != (0,):
            raise ValueError(f"axis {axis!r} can't be summed: only the first, {name or 0!r}")

    def _weighted(self, weights, where, word):
        weights = np.asarray(weights, float)
        if weights.shape != self.shape[:1]:
            raise ValueError(f"weights of the shape {weights.shape} for {self.shape[0]} numbers")
        if where is not None:
            where = np.asarray(where)
            if where.dtype != bool or where.shape != weights.shape:
                raise ValueError(f"where is no mask of {len(weights)} bool")
            weights = np.where(where, weights, 0.0)
        if self._source is not None:
            source = self._source.summed(weights)
            values = source.estimates()
        else:
            source, values = None, self._sum_of_unknown(weights)
        return self._mapped(values, source, None, lambda part: part._weighted(weights, None, word))

    def _sum_of_unknown(self, weights):
        """The sum of values whose replicates are not known."""
        used = np.flatnonzero(weights)
        means = np.tensordot(weights[used], self.values[used], 1)
        if np.all(self.standard_error[used] == 0):
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
        axis = getattr(self.index, "axis", None)
        count = f"{self.shape[0]} {axis}s" if axis else "x".join(map(str, self.shape))
        flat = self._values.reshape(-1, 4)
        first = ", ".join(pair(*numbers[:2]) for numbers in flat[:3])
        more = ", ..." if len(flat) > 3 else ""
        total = ""
        if self._has_rows and self.extensive and not self.bands and self.has_replicates:
            total = f"; sum {pair(*self.sum()._values[:2])}"
        return f"<{self.name}{of}{f' [{unit}]' if unit else ''}, {count}: {first}{more}{total}>"

    def _repr_html_(self):
        from ._html import estimates_html

        return estimates_html(self)

    def to_pandas(self):
        """A pandas.DataFrame with the columns value and standard_error, or one pair for each band."""
        import pandas

        if self.ndim == 0 or self.ndim > 2:
            raise ValueError(f"{self.name} of the shape {self.shape} makes no table")
        columns = {}
        for band in self.bands if self.ndim == 2 else ("",):
            own = self._band(band) if band else self
            columns[band or "value"] = own.values
            columns[f"{band}_se" if band else "standard_error"] = own.standard_error
        keys = self.bands if self.bands and self.ndim == 1 else getattr(self.index, "keys", None)
        name = None if self.index is None else self.index.axis
        frame = pandas.DataFrame(columns, index=keys if keys is None else pandas.Index(keys, name=name))
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
