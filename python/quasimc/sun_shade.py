"""The light of the sunlit and of the shaded part of organs."""

from __future__ import annotations

from . import _core
from ._optional import needed
from .estimates import Estimates


class SunShade:
    """The light of the sunlit and of the shaded part of organs or groups, of a run with sun_shade="apart".

    ``parts["absorbed_flux_density_sunlit"]["PAR"].values`` is an array with a value for each organ or
    group; ``parts["sunlit_fraction_upper"].values`` has no bands. The light of a part is per area of
    this part; nan where there is none. In sums over time, "sunlit_hours_upper" replaces
    "sunlit_fraction_upper", "sunlit_hours" is of either side, direct light is summed, and the light
    of parts is the mean over area and time, in the unit of the band.
    """

    def __init__(self, values, index, organs, hours=None):
        """Of core values of shape (rows, quantities, bands, 4); `hours` of sums, shape (rows, 4)."""
        self._values = values
        self._index = index
        self._of = organs
        self._hours = hours
        self._rows = {
            row["name"] if hours is None else row["of_sums"]: (i, row)
            for i, row in enumerate(_core.sun_shade_quantities())
        }

    def keys(self):
        """Names of the quantities."""
        return [*self._rows, *(() if self._hours is None else ("sunlit_hours",))]

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def __getitem__(self, quantity):
        if self._hours is not None and quantity == "sunlit_hours":
            return self._estimates(self._hours, quantity, "h")
        if quantity not in self._rows:
            known = ", ".join(self.keys())
            raise KeyError(f"there is no quantity {quantity!r}; there are: {known}")
        number, row = self._rows[quantity]
        values = self._values[:, number]
        if not row["has_bands"]:
            return self._estimates(values[:, 0], quantity, "" if self._hours is None else "h")
        if self._hours is None or not row["is_summed"]:
            return self._estimates(values, quantity, tuple(self._of.units), self._of.bands)
        units = tuple(_core.summed_unit(unit) for unit in self._of.units)
        return self._estimates(values, quantity, units, self._of.bands)

    def _estimates(self, values, quantity, units, bands=()):
        return Estimates(values, quantity, units, bands, index=self._index, extensive=False)

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ or group, with the columns of the CSV files."""
        pandas = needed("pandas")

        columns = {}
        for name in self.keys():
            estimates = self[name]
            of_bands = {f"{name}_{band}": estimates[band] for band in estimates.bands}
            for column, own in (of_bands or {name: estimates}).items():
                columns[column] = own.values
                columns[f"{column}_se"] = own.standard_error
                columns[f"{column}_ci95_high"] = own.ci95_high
        return pandas.DataFrame(columns)


def parts_of(core, index, organs, first=0):
    """The SunShade of a core result, of its groups (from the `first` on) or of sums.

    Raises KeyError if there is none.
    """
    if core is None:
        raise KeyError('there is no light of sunlit and shaded parts: run with sun_shade="apart"')
    rows = slice(first, first + len(index))
    hours = core.get("hours")
    return SunShade(core["values"][rows], index, organs, None if hours is None else hours[rows])
