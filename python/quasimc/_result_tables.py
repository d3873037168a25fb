"""Tables and data sets of results."""

from __future__ import annotations

import numpy as np

from . import _core
from ._light import estimate_columns, label_columns
from .detectors import detector_variables
from .sensors import free_sensor_variables


class ResultTables:
    """Part of `Result`."""

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ.

        The index is the organ's id; the columns are those of the CSV files: name, labels, area,
        ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``. A label with the name of
        another column becomes ``label_<key>``. Units are in ``frame.attrs["units"]``.
        """
        import pandas

        columns = self._all_columns()
        labels = label_columns(self.organs.labels, columns)
        columns = {"name": self.organs.names, **labels, "area": self.organs.areas, **columns}
        frame = pandas.DataFrame(columns, index=pandas.Index(self.organs.ids, name="id"))
        frame.attrs["units"] = {
            f"{quantity}_{band}": self[quantity][band].unit
            for quantity in _core.quantities()
            for band in self.bands
        }
        return frame

    def to_pyvista(self):
        """Returns a pyvista.PolyData: the triangles of the organs with their light.

        Cells have the arrays "organ" (ids), "name", ``label_<key>``, and the columns of `to_pandas`:
        ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``, equal for all triangles of an organ.
        Coordinates are in the axes and the length unit of the scene. The ground is not among them.

        Raises ImportError if pyvista is missing, and ValueError if the triangles were not stored.
        """
        from ._exchange import to_pyvista

        return to_pyvista(self.organs, self._all_columns())

    def _all_columns(self):
        columns = self._columns()
        if self._has_sunlit:
            columns.update(estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
        for name, estimates in self.ratios.items():
            columns.update(estimate_columns(f"ratio_{name}", estimates))
        return columns

    def to_xarray(self):
        """Returns an xarray.Dataset with the dimensions organ, band and statistic.

        Statistics are mean, standard_error, ci95_low, ci95_high. Units are attributes of the
        variables. A detector is a variable with its name and the dimension <name>_bin instead of
        organ; if the name is used already, it is ``detector_<name>``. Sensors have the variables of
        `Sensors.to_xarray` with the name of their set in front: ``bench_incident_upper``, along
        ``bench_point``, or ``bench_j`` and ``bench_i``.
        """
        import xarray

        variables, dimensions = {}, ("organ", "band", "statistic")
        for i, quantity in enumerate(_core.quantities()):
            attributes = {"units": ", ".join(dict.fromkeys(self[quantity]._units))}
            variables[quantity] = (dimensions, self._values[:, i], attributes)
        if self._has_sunlit:
            variables["sunlit_fraction"] = (("organ", "statistic"), self._sunlit, {"units": "1"})
        coordinates = {
            "organ": self.organs.ids,
            "band": list(self.bands),
            "statistic": ["mean", "standard_error", "ci95_low", "ci95_high"],
            "name": ("organ", np.asarray(self.organs.names)),
            "area": ("organ", self.organs.areas, {"units": f"{self.organs.length_unit}2"}),
        }
        for key, values in label_columns(self.organs.labels, [*variables, *dimensions]).items():
            coordinates[key] = ("organ", np.asarray(values))
        taken = [*variables, *coordinates]
        for name, detector in detector_variables(self.detectors, taken).items():
            variables[name] = detector.to_xarray().rename(bin=f"{name}_bin")
        for sensors in self.sensors.values():
            more, points = free_sensor_variables(sensors, {*variables, *coordinates})
            variables |= more
            coordinates |= points
        return xarray.Dataset(variables, coordinates, {"method": self.run.method})
