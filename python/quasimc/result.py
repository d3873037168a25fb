"""Results: the light of every organ, with its errors."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from . import _core
from .estimates import Estimate, Estimates

#: Short names of quantities.
SHORT_NAMES = {"absorbed": "absorbed_flux"}


def quantities():
    """The quantities of a result, with a line on each: dict of str."""
    return {name: summary for name, (summary, _) in _core.quantities().items()}


def _quantity_name(name):
    name = SHORT_NAMES.get(name, name)
    if name not in _core.quantities():
        known = ", ".join(_core.quantities())
        raise KeyError(f"there is no quantity {name!r}; there are: {known}, sunlit_fraction")
    return name


class _Light:
    """Light by quantity and band, of organs or groups.

    ``light["absorbed_flux"]["PAR"]`` are the `Estimates` of a quantity in a band, and
    ``light["absorbed_flux"]`` those of all bands, on the last axis. "absorbed" is short for
    "absorbed_flux".
    """

    def __init__(self, values, sunlit, organs, time=None):
        self._values = values
        self._sunlit = sunlit
        self._of = organs
        self._time = time

    def _unit(self, quantity, band_unit):
        if self._time is None:
            return _core.unit_of(quantity, band_unit, self._of.length_unit)
        # Summed over time: the unit of the rate is that of light alone, then times the area.
        return _core.unit_of(quantity, _core.summed_unit(band_unit)[0], self._of.length_unit)

    def __getitem__(self, quantity):
        if quantity == "sunlit_fraction" and self._time is None:
            return Estimates(self._sunlit, "sunlit_fraction", "")
        name = _quantity_name(quantity)
        number = list(_core.quantities()).index(name)
        units = tuple(self._unit(name, unit) for unit in self._of.units)
        return Estimates(self._values[:, number], name, units, self._of.bands)

    def keys(self):
        """Names of quantities."""
        has_sunlit = self._time is None and len(self._sunlit) > 0
        return [*_core.quantities(), *(["sunlit_fraction"] if has_sunlit else [])]

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def _columns(self, prefix=()):
        """Columns as those of the CSV files: name -> array."""
        columns = dict(prefix)
        for band in self._of.bands:
            for quantity in _core.quantities():
                estimates = self[quantity][band]
                columns[f"{quantity}_{band}"] = estimates.mean
                columns[f"{quantity}_{band}_se"] = estimates.standard_error
                columns[f"{quantity}_{band}_high"] = estimates.high
        return columns


class Selection(_Light):
    """The light of some organs, in the order asked; indexed as a result.

    Attributes
    ----------
    ids : list of int
    """

    def __init__(self, result, ids):
        self.ids = [int(organ) for organ in ids]
        places = [result.organs.index_of(organ) for organ in self.ids]
        sunlit = result._sunlit[places] if len(result._sunlit) else result._sunlit
        super().__init__(result._values[places], sunlit, result.organs)


class Groups(_Light):
    """Sums over organs (`groups`, `layers` of a run), with the errors of the sums.

    The first group is that of all organs. Indexed as a result, and

    Attributes
    ----------
    groups : list of dict
        Of each group: by, value, organs (places in the result), area; of a layer low, high,
        plant_area_index and cumulative_plant_area_index.
    """

    def __init__(self, core, organs):
        super().__init__(core["values"], core["sunlit_fraction"], organs)
        self.groups = core["groups"]

    def to_pandas(self):
        """A pandas.DataFrame with a row for each group."""
        import pandas

        names = ("by", "value", "area", "low", "high", "plant_area_index")
        first = {name: [group[name] for group in self.groups] for name in names}
        first["organs"] = [len(group["organs"]) for group in self.groups]
        return pandas.DataFrame(self._columns(first.items()))


class Result(_Light):
    """The light of every organ.

    ``result["absorbed_flux"]["PAR"].mean`` is an array with a number for each organ, in the order
    of ``result.organs``; ``.standard_error``, ``.low`` and ``.high`` (95 %) go with it. The
    quantities are those of `quasimc.quantities()`, and "sunlit_fraction".

    Attributes
    ----------
    organs : Organs
        What the numbers are of: ids, names, labels, areas.
    method, reason : str
        How light was followed, and why so.
    paths, replicates, rays : int
        Paths of each replicate; replicates; rays of all of them.
    stop : str
        Why no more was traced: "paths_done", "target_reached", "time_is_up", "path_limit",
        "interrupted" (by Ctrl-C: the numbers are of the paths that were done), "no_light".
    fraction_at_target : float
        Of the organs, where there was a target error.
    build_seconds, trace_seconds, trace_cpu_seconds : float
    warnings : list of str
    sources : list of str
        In words.
    """

    def __init__(self, core, organs, warnings=(), sources=(), ratio_names=()):
        super().__init__(core.values, core.sunlit_fraction, organs)
        self._core = core
        self.organs = organs
        self.warnings = list(warnings)
        self.sources = list(sources)
        self._ratio_names = list(ratio_names)
        for name, value in core.facts.items():
            setattr(self, name, value)

    @property
    def bands(self):
        """Names of the bands."""
        return self.organs.bands

    @cached_property
    def ratios(self):
        """Of each of the ratios that were asked for ("R:FR") the Estimates of the organs: dict."""
        values = self._core.ratios
        return {
            name: Estimates(values[:, i], f"ratio {name}", "")
            for i, name in enumerate(self._ratio_names)
        }

    @cached_property
    def groups(self):
        """Sums over organs: Groups, that of all organs first."""
        return Groups(self._core.groups, self.organs)

    @cached_property
    def budget(self):
        """Where the light of each band went, flux: band -> dict of Estimate."""
        return self._by_band(self._core.budget, ("closure_error",), "absorbed_flux")

    @cached_property
    def canopy(self):
        """Fractions of the light that falls on the horizontal: band -> dict of Estimate.

        Empty without a ground or a cell that repeats along both axes.
        """
        return self._by_band(self._core.canopy, ("incident",), None)

    @property
    def detectors(self):
        """What the detectors saw: list of dict with name, type, quantity, bins and values.

        values: (bins, bands, 4), flux: mean, standard error, low and high.
        """
        return self._core.detectors

    @property
    def audit(self):
        """Of the audit, if there was one: dict with chance, agrees, paths, replicates; or None."""
        return self._core.audit

    def _by_band(self, rows, numbers, quantity):
        result = {}
        for band, unit, row in zip(self.bands, self.organs.units, rows):
            of = "" if quantity is None else self._unit(quantity, unit)
            result[band] = {
                key: value if key in numbers else Estimate(value, of)
                for key, value in row.items()
            }
        return result

    def select(self, ids):
        """The light of the organs of these ids, in their order: a Selection.

        Raises KeyError if one is not there.
        """
        return Selection(self, ids)

    def to_pandas(self):
        """A pandas.DataFrame with a row for each organ.

        The index is the organ's id; the columns are those of the CSV files: name, labels, area,
        ``<quantity>_<band>`` with ``_se`` and ``_high``. Units are in ``frame.attrs["units"]``.
        """
        import pandas

        first = {"name": self.organs.names, **self._label_columns(), "area": self.organs.areas}
        columns = self._columns(first.items())
        if len(self._sunlit):
            columns.update(_estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
        for name, estimates in self.ratios.items():
            columns.update(_estimate_columns(f"ratio_{name}", estimates))
        frame = pandas.DataFrame(columns, index=pandas.Index(self.organs.ids, name="id"))
        frame.attrs["units"] = {
            f"{quantity}_{band}": self[quantity][band].unit
            for quantity in _core.quantities()
            for band in self.bands
        }
        return frame

    def _label_columns(self):
        taken = {"id", "name", "area"}
        return {
            f"label_{key}" if key in taken else key: values
            for key, values in self.organs.labels.items()
        }

    def to_xarray(self):
        """An xarray.Dataset with the dimensions organ, band and statistic.

        statistic: mean, standard_error, low, high. Units are attributes of the variables.
        """
        import xarray

        variables = {}
        for i, quantity in enumerate(_core.quantities()):
            units = self[quantity].unit
            attributes = {"units": units[0] if len(set(units)) == 1 else ", ".join(units)}
            dimensions = ("organ", "band", "statistic")
            variables[quantity] = (dimensions, self._values[:, i], attributes)
        if len(self._sunlit):
            variables["sunlit_fraction"] = (("organ", "statistic"), self._sunlit, {"units": "1"})
        coordinates = {
            "organ": self.organs.ids,
            "band": list(self.bands),
            "statistic": ["mean", "standard_error", "low", "high"],
            "name": ("organ", np.asarray(self.organs.names)),
            "area": ("organ", self.organs.areas, {"units": f"{self.organs.length_unit}2"}),
        }
        for key, values in self._label_columns().items():
            coordinates[key] = ("organ", np.asarray(values))
        return xarray.Dataset(variables, coordinates, {"method": self.method})

    def plot(self, quantity="absorbed_flux_density", band=None, **options):
        """A picture of the scene, each organ coloured by a quantity; see `quasimc.plotting.plot`.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from .plotting import plot

        return plot(self, quantity, band, **options)

    def __repr__(self):
        return (
            f"<Result: {len(self.organs)} organs, bands {', '.join(self.bands)}; {self.method}, "
            f"{self.paths} paths x {self.replicates} replicates, {self.stop}>"
        )

    def _repr_html_(self):
        from ._html import result_html

        return result_html(self)


class Series:
    """The light of the times of ``[time]``, and its sums over days.

    ``len(series)`` times; ``series[i]`` is the `Result` of one.

    Attributes
    ----------
    organs : Organs
    times : list of dict
        Of each: time ("2024-06-21T12:00+02:00"), seconds, sun_azimuth_deg, sun_elevation_deg,
        direct and diffuse (W m-2 on the horizontal, full spectrum).
    days : dict
        Date -> `Sums`; days of which times are missing are left out.
    total : Sums
        Over all times.
    stop : str
        As of a result: "paths_done", "time_is_up" or "interrupted".
    """

    def __init__(self, core, organs, warnings=(), sources=(), ratio_names=()):
        self._core = core
        self.organs = organs
        self.warnings = list(warnings)
        self.sources = list(sources)
        self._ratio_names = list(ratio_names)
        self.times = core.times
        for name, value in core.facts.items():
            setattr(self, name, value)

    @cached_property
    def _results(self):
        return [
            Result(core, self.organs, self.warnings, self.sources, self._ratio_names)
            for core in self._core.results
        ]

    @cached_property
    def days(self):
        return {
            day["date"]: Sums(day["values"], day["seconds"], self.organs)
            for day in self._core.days
        }

    @cached_property
    def total(self):
        return Sums(self._core.total, self.total_seconds, self.organs)

    def __len__(self):
        return len(self.times)

    def __getitem__(self, index):
        if not self._results and self.times:
            raise KeyError("the times were not kept (keep_times=False)")
        return self._results[index]

    def __iter__(self):
        return iter(self._results)

    def to_pandas(self):
        """A pandas.DataFrame with a row for each time and organ, indexed by both."""
        import pandas

        names = [moment["time"] for moment in self.times]
        return pandas.concat([r.to_pandas() for r in self], keys=names, names=["time", "id"])

    def __repr__(self):
        return f"<Series: {len(self)} times, {len(self.organs)} organs, {self.stop}>"


class Sums(_Light):
    """Light summed over the times of a day, or of all days; indexed as a result.

    Units are those of rates times time: J m-2 for W m-2, mol m-2 for umol m-2 s-1.

    Attributes
    ----------
    seconds : float
        Of the times that were summed.
    """

    def __init__(self, values, seconds, organs):
        factors = np.array([_core.summed_unit(unit)[1] for unit in organs.units])
        super().__init__(values * factors[:, None], None, organs, time="sum")
        self.seconds = seconds

    def to_pandas(self):
        """A pandas.DataFrame with a row for each organ, indexed by id."""
        import pandas

        first = {"name": self._of.names, "area": self._of.areas}
        index = pandas.Index(self._of.ids, name="id")
        return pandas.DataFrame(self._columns(first.items()), index=index)


def _estimate_columns(name, estimates):
    return {
        name: estimates.mean,
        f"{name}_se": estimates.standard_error,
        f"{name}_high": estimates.high,
    }
