"""Light by quantity and band, of organs or groups."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from . import _core
from ._combination import Combination
from .estimates import Estimates


def quantities():
    """Quantities of a result: dict, name -> one-line description."""
    return {name: summary for name, (summary, _) in _core.quantities().items()}


class Light(Mapping):
    """Light by quantity and band.

    ``light["absorbed_flux"]["PAR"]`` are the `Estimates` of a quantity in one band;
    ``light["absorbed_flux"]`` those of all bands (last axis). Of a run with `origins`,
    ``light["absorbed_flux"]["PAR"].origin("sun")`` is the part that came from one of them.
    """

    def __init__(
        self, values, index, organs, *, sunlit=None, rows=None, replicates=None, origins=None,
        is_summed=False,
    ):  # fmt: skip
        self._values = values  # (rows, quantities, bands, 4)
        self._index = index
        self._organs = organs
        self._sunlit = sunlit  # (rows, 4); None or empty: no source is directional
        self._rows = rows  # the organs of each row, for sums with errors
        self._replicates = replicates  # of the core; None: not kept
        self._origins = origins or {}  # name -> (values, replicates)
        self._is_summed = is_summed  # over time

    @property
    def bands(self):
        """Names of the bands."""
        return self._organs.bands

    @property
    def origins(self):
        """Names of the origins whose light is known apart: tuple of str."""
        return tuple(self._origins)

    def _unit(self, quantity, band_unit):
        # Summed over time: the unit of the rate is that of light alone, then times the area.
        unit = _core.summed_unit(band_unit) if self._is_summed else band_unit
        return _core.unit_of(quantity, unit, self._organs.length_unit)

    @property
    def _has_sunlit(self):
        return self._sunlit is not None and len(self._sunlit) > 0

    def _names(self):
        return [*_core.quantities(), *(["sunlit_fraction"] if self._has_sunlit else [])]

    def keys(self):
        """Names of the quantities; with directional sources also sunlit_fraction (not for sums)."""
        return self._names()

    def __iter__(self):
        return iter(self._names())

    def __len__(self):
        return len(self._names())

    def __eq__(self, other):
        return self is other

    __hash__ = None

    def __getitem__(self, quantity):
        if quantity not in self._names():
            known = ", ".join(self._names())
            hint = "; did you mean 'absorbed_flux'?" if quantity == "absorbed" else ""
            raise KeyError(f"there is no quantity {quantity!r}{hint}; there are: {known}")
        if quantity == "sunlit_fraction":
            source = self._source(self._replicates, Combination.SUNLIT, False)
            return Estimates(
                self._sunlit, quantity, "", index=self._index, source=source, extensive=False
            )
        origins = {
            name: (lambda name=name, of=of: self._estimates(quantity, *of, name=f"{quantity}_from_{name}"))
            for name, of in self._origins.items()
        }
        return self._estimates(quantity, self._values, self._replicates, origins)

    def _estimates(self, quantity, values, replicates, origins=None, name=None):
        number = list(_core.quantities()).index(quantity)
        is_flux = _core.quantities()[quantity][1]
        return Estimates(
            values[:, number],
            name or quantity,
            tuple(self._unit(quantity, unit) for unit in self._organs.units),
            self.bands,
            index=self._index,
            source=self._source(replicates, number, is_flux),
            origins=origins,
            extensive=is_flux,
        )

    def _source(self, replicates, number, is_flux):
        """What sums of a quantity are made of; None if it is not known."""
        if replicates is None or self._rows is None:
            return None
        if is_flux:
            return replicates.source(number, self._rows)
        areas = self._index.areas
        return replicates.source(number, self._rows.scaled(1 / np.where(areas > 0, areas, 1)))

    def _columns(self):
        """Columns of light as those of the CSV files: name -> array."""
        columns = {}
        for band in self.bands:
            for quantity in _core.quantities():
                columns.update(estimate_columns(f"{quantity}_{band}", self[quantity][band]))
        for origin in self.origins:
            for band in self.bands:
                for quantity in _core.quantities():
                    estimates = self[quantity].origin(origin)[band]
                    columns.update(estimate_columns(f"{quantity}_{band}_from_{origin}", estimates))
        return columns

    def _column_units(self):
        """Units of the quantities of a table: dict, "<quantity>_<band>" -> str."""
        bands = list(zip(self.bands, self._organs.units))
        return {
            f"{quantity}_{band}": self._unit(quantity, unit)
            for quantity in _core.quantities()
            for band, unit in bands
        }


def origins_of(core, replicates, select):
    """Values and replicates of each origin, by name. @param select: picks values of its dict"""
    return {
        name: (select(light), None if replicates is None else replicates.origin(name))
        for name, light in core.items()
    }


def ratio_estimates(values, names, index):
    """Ratios of bands: dict, name -> Estimates."""
    return {
        name: Estimates(values[:, i], f"ratio {name}", "", index=index, extensive=False)
        for i, name in enumerate(names)
    }


def estimate_columns(name, estimates):
    """The columns of one quantity, as those of the CSV files."""
    return {
        name: estimates.values,
        f"{name}_se": estimates.standard_error,
        f"{name}_ci95_high": estimates.ci95_high,
    }


def label_columns(labels, others):
    """Labels by the names of their columns, which no other column has."""
    taken = {"id", "name", "area", *others}
    columns = {}
    for key, values in labels.items():
        name = key
        while name in taken or (name != key and name in labels):
            name = f"label_{name}"
        columns[name] = values
    return columns
