"""Detectors."""

from __future__ import annotations

from ._optional import needed
from .estimates import Estimates


class DetectorResult(Estimates):
    """The flux in the bins of a detector: ``result.detectors["up"]["PAR"]`` has the shape (bins,).

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
        xarray = needed("xarray")

        coordinates = {
            "bin": ("bin", self.bins, {"long_name": self.quantity}),
            "band": list(self.bands),
            "statistic": ["mean", "standard_error", "ci95_low", "ci95_high"],
        }
        units = ", ".join(dict.fromkeys(self._units))
        return xarray.DataArray(
            self._values, coordinates, ("bin", "band", "statistic"), self.name, {"units": units}
        )


def detector_variables(detectors, others):
    """Detectors by the names of their variables: nothing else is named so, or as their bins."""
    taken = set(others)
    variables = {}
    for key, detector in detectors.items():
        name = key
        while not taken.isdisjoint({name, f"{name}_bin"}) or (name != key and name in detectors):
            name = f"detector_{name}"
        taken |= {name, f"{name}_bin"}
        variables[name] = detector
    return variables
