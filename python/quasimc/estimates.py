"""Estimates with standard errors and confidence intervals."""

from __future__ import annotations

import numpy as np


class Estimates:
    """Means with standard errors and 95 % confidence intervals: numpy arrays of one shape.

    With several bands, the last axis is the band; ``estimates["PAR"]`` selects one. Intervals contain the
    mean and end at physical bounds (docs/theory/statistics.md).

    Attributes
    ----------
    name : str
        Name of the quantity.
    unit : str, or tuple of str
        Unit of the band, or of each band.
    bands : tuple of str
        Names of the bands; empty for one band or none.
    """

    __slots__ = ("_values", "_origins", "name", "unit", "bands")

    def __init__(self, values, name, unit, bands=(), origins=None):
        self._values = values
        self._origins = origins or {}
        self.name = name
        self.unit = unit
        self.bands = tuple(bands)

    def origin(self, name):
        """Returns the part that came from an origin of a run with `origins`: Estimates.

        The means of all origins add up to those of all light, but for means that are moved to a
        physical bound. Raises KeyError if there is no such origin.
        """
        if name not in self._origins:
            known = ", ".join(self._origins) or "none; run with origins"
            raise KeyError(f"there is no origin {name!r}; there are: {known}")
        return Estimates(self._origins[name], f"{self.name}_from_{name}", self.unit, self.bands)

    @property
    def mean(self):
        """Means."""
        return self._values[..., 0]

    @property
    def standard_error(self):
        """Standard errors of the means; NaN where unknown (one replicate, or no light sampled)."""
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
        """standard_error / mean; NaN where the mean is 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.mean != 0, self.standard_error / np.abs(self.mean), np.nan)

    def __getitem__(self, band):
        if band not in self.bands:
            known = ", ".join(self.bands) or "none"
            raise KeyError(f"there is no band {band!r}; there are: {known}")
        i = self.bands.index(band)
        origins = {name: values[..., i, :] for name, values in self._origins.items()}
        return Estimates(self._values[..., i, :], self.name, self.unit[i], origins=origins)

    def __len__(self):
        return len(self._values)

    def __repr__(self):
        of = f"[{', '.join(self.bands)}]" if self.bands else ""
        shape = "x".join(map(str, self.mean.shape)) or "one"
        return f"<Estimates {self.name}{of} of {shape}, {self.unit}>"


class DetectorResult(Estimates):
    """The flux in the bins of a detector: ``result.detectors["up"]["PAR"].mean`` has shape (bins,).

    Attributes
    ----------
    type : str
    quantity : str
        The quantity by which light is sorted, with its unit.
    bins : list of str
        Names of the bins.
    """

    __slots__ = ("type", "quantity", "bins")

    def __init__(self, seen, units, bands):
        super().__init__(seen["values"], seen["name"], units, bands)
        self.type, self.quantity, self.bins = seen["type"], seen["quantity"], seen["bins"]

    def to_xarray(self):
        """An xarray.DataArray with the dimensions bin, band and statistic."""
        import xarray

        coordinates = {
            "bin": ("bin", self.bins, {"long_name": self.quantity}),
            "band": list(self.bands),
            "statistic": ["mean", "standard_error", "ci95_low", "ci95_high"],
        }
        units = self.unit[0] if len(set(self.unit)) == 1 else ", ".join(self.unit)
        return xarray.DataArray(
            self._values, coordinates, ("bin", "band", "statistic"), self.name, {"units": units}
        )


class Estimate:
    """One estimate: mean, standard_error, ci95_low, ci95_high (floats) and unit (str)."""

    __slots__ = ("mean", "standard_error", "ci95_low", "ci95_high", "unit")

    def __init__(self, numbers, unit):
        self.mean, self.standard_error, self.ci95_low, self.ci95_high = (float(x) for x in numbers)
        self.unit = unit

    def __repr__(self):
        return f"{self.mean:.6g} +- {self.standard_error:.2g} {self.unit}".rstrip()
