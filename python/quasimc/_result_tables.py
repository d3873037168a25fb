"""Tables and data sets of results."""

from __future__ import annotations

from ._light import estimate_columns, label_columns
from ._optional import needed


class ResultTables:
    """Part of `Result`."""

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ.

        The index is the organ's id; the columns are those of the CSV files: name, labels, area,
        ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``. A label with the name of
        another column becomes ``label_<key>``. Units are in ``frame.attrs["units"]``.
        """
        pandas = needed("pandas")

        columns = self._all_columns()
        labels = label_columns(self.organs.labels, columns)
        columns = {"name": self.organs.names, **labels, "area": self.organs.areas, **columns}
        frame = pandas.DataFrame(columns, index=pandas.Index(self.organs.ids, name="id"))
        frame.attrs["units"] = self._column_units()
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
        variables. The light of groups is ``group_absorbed_flux``, ... along ``group``, that of origins
        ``absorbed_flux_by_origin``, ... along ``origin``, ratios of bands are ``light_ratio`` along
        ``ratio``. A detector is a variable with its name and the dimension <name>_bin instead of
        organ; if the name is used already, it is ``detector_<name>``. Sensors have the variables of
        `Sensors.to_xarray` with the name of their set in front: ``bench_incident_upper``, along
        ``bench_point``, or ``bench_j`` and ``bench_i``.
        """
        from ._datasets import result_dataset

        return result_dataset(self)
