"""Estimates: arrays of numbers with standard errors and confidence intervals."""

from __future__ import annotations

import numpy as np

from . import _arithmetic as arithmetic
from ._format import pair
from ._optional import needed
from ._selection import Selectable
from ._sums import Summable
from ._units import shown

_NO_FLOAT = "take light.sum(), light.mean() or light[0]"


class Estimates(Selectable, Summable, np.lib.mixins.NDArrayOperatorsMixin):
    """Numbers with standard errors and 95 % confidence intervals, which behave as an array.

    The first axis is that of organs (or groups, bins, ...), the last one that of bands; light of a
    sweep or a series has its points or times before the organs.
    ``light["PAR"]`` selects a band, ``light[3]``, ``light[1:4]`` and ``light[mask]`` select by position,
    and `at` selects by id or name. Sums and arithmetic keep the errors: they are computed replicate by
    replicate, never added in quadrature, and replicate r of one is paired with replicate r of the other.
    A sum of arithmetic has the error of the arithmetic of sums: ``(a - b).sum()`` that of
    ``a.sum() - b.sum()``. Estimates know the run that they are from, also after pickling: what they share
    counts once, so that ``light[mask].sum() + light[~mask].sum()`` has the error of ``light.sum()``, and
    ``light - light`` is 0 without an error. ``np.asarray(light)`` are the values alone.

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

    __slots__ = ("_numbers", "_source", "_origins", "_units", "name", "bands", "index", "extensive")

    def __init__(
        self, values, name, unit, bands=(), *, index=None, source=None, origins=None, extensive=True
    ):
        self._numbers = values  # None: those of the source, when they are needed
        self._source = source  # see `_spread`; None: replicates are not known
        self._origins = origins or {}  # name -> function that returns Estimates
        self._units = (unit,) if isinstance(unit, str) else tuple(unit)
        self.name = name
        self.bands = tuple(bands)
        self.index = index
        self.extensive = extensive

    # Values and errors.

    @property
    def _values(self):
        """(..., 4): mean, standard error, ends of the interval."""
        if self._numbers is None:
            self._numbers = self._source.estimates()
        return self._numbers

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
        return self._source.means.shape if self._numbers is None else self._numbers.shape[:-1]

    @property
    def ndim(self):
        return len(self.shape)

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
        result = self._mapped(self._values, self._source, self.index, lambda part: part.with_unit(unit))
        result._set_unit(unit)
        return result

    @property
    def has_replicates(self):
        """Whether sums and differences have errors."""
        return self._source is not None

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
            raise TypeError(f"{self.size} estimates are not a single number; {_NO_FLOAT}")
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
            values, self.name, self._units, self.bands,
            index=index, source=source, extensive=self.extensive,
        )  # fmt: skip

    def _with_source_of(self, other, factor):
        """The same numbers, which are others times a factor above 0, with their replicates."""
        if self is other or not hasattr(other._source, "scaled"):
            return self
        result = self._like(self._values, other._source.scaled(factor))
        result._origins = {
            name: lambda name=name: self.origin(name)._with_source_of(other.origin(name), factor)
            for name in self.origins
        }
        return result

    def _mapped(self, values, source, index, to_part):
        """A selection or sum, also of the parts by origin."""
        origins = {
            name: (lambda part=part: to_part(part())) for name, part in self._origins.items()
        }
        result = self._like(values, source)
        result.index, result._origins = index, origins
        return result

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
            self._source,
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
        pandas = needed("pandas")

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


def _restored(values, name, units, bands, index, source, origins, extensive):
    parts = {origin: (lambda part=part: part) for origin, part in origins.items()}
    return Estimates(
        values, name, units, bands, index=index, source=source, origins=parts, extensive=extensive
    )
