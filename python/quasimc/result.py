"""Results: the light of every organ, with its errors."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from . import _core
from .estimates import DetectorResult, Estimate, Estimates
from .parts import parts_of
from .sensors import sensors_by_name

#: Short names of quantities.
SHORT_NAMES = {"absorbed": "absorbed_flux"}


def quantities():
    """Quantities of a result: dict, name -> one-line description."""
    return {name: summary for name, (summary, _) in _core.quantities().items()}


class _Light:
    """Light by quantity and band, of organs or groups.

    ``light["absorbed_flux"]["PAR"]`` are the `Estimates` of a quantity in one band;
    ``light["absorbed_flux"]`` those of all bands (last axis). "absorbed" is short for
    "absorbed_flux". Of a run with `origins`, ``light["absorbed_flux"]["PAR"].origin("sun")`` is the
    part that came from one of them.
    """

    def __init__(self, values, sunlit, organs, time=None, origins=None):
        self._values = values
        self._origins = origins or {}
        self._sunlit = sunlit
        self._of = organs
        self._time = time

    def _unit(self, quantity, band_unit):
        if self._time is None:
            return _core.unit_of(quantity, band_unit, self._of.length_unit)
        # Summed over time: the unit of the rate is that of light alone, then times the area.
        return _core.unit_of(quantity, _core.summed_unit(band_unit)[0], self._of.length_unit)

    def __getitem__(self, quantity):
        name = SHORT_NAMES.get(quantity, quantity)
        if name not in self.keys():
            known = ", ".join(self.keys())
            raise KeyError(f"there is no quantity {quantity!r}; there are: {known}")
        if name == "sunlit_fraction":
            return Estimates(self._sunlit, name, "")
        number = list(_core.quantities()).index(name)
        units = tuple(self._unit(name, unit) for unit in self._of.units)
        origins = {of: values[:, number] for of, values in self._origins.items()}
        return Estimates(self._values[:, number], name, units, self._of.bands, origins)

    @property
    def origins(self):
        """Names of the origins whose light is known apart: tuple of str."""
        return tuple(self._origins)

    def keys(self):
        """Names of the quantities; with directional sources also sunlit_fraction (not for sums)."""
        has_sunlit = self._time is None and len(self._sunlit) > 0
        return [*_core.quantities(), *(["sunlit_fraction"] if has_sunlit else [])]

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def _columns(self):
        """Columns of light as those of the CSV files: name -> array."""
        columns = {}
        for band in self._of.bands:
            for quantity in _core.quantities():
                estimates = self[quantity][band]
                columns.update(_estimate_columns(f"{quantity}_{band}", estimates))
        for origin in self.origins:
            for band in self._of.bands:
                for quantity in _core.quantities():
                    estimates = self[quantity][band].origin(origin)
                    columns.update(_estimate_columns(f"{quantity}_{band}_from_{origin}", estimates))
        return columns


class Selection(_Light):
    """The light of some organs, in the given order; indexed like a result.

    Attributes
    ----------
    ids : list of int
    """

    def __init__(self, result, ids):
        indices = [result.organs.index_of(organ) for organ in ids]
        self.ids = result.organs.ids[indices].tolist()
        sunlit = result._sunlit[indices] if len(result._sunlit) else result._sunlit
        origins = {name: values[indices] for name, values in result._origins.items()}
        super().__init__(result._values[indices], sunlit, result.organs, origins=origins)


class Groups(_Light):
    """Sums over organs (`groups`, `layers` of a run), with the errors of the sums.

    The first group is all organs. Indexed like a result, and by "fraction_incident" (absorbed flux over
    the light on the horizontal) and "fraction_absorbed" (over that of all measured organs).

    Attributes
    ----------
    groups : list of dict
        For each group: by, value, labels (dict), organs (indices in the result), area; for layers also
        height_min, height_max, plant_area_index and cumulative_plant_area_index.
    """

    #: Fractions of other light, in the order of the core.
    _SHARES = ("fraction_incident", "fraction_absorbed")

    def __init__(self, core, organs, ratio_names=(), factors=None, origins=None):
        factors, time = (1, None) if factors is None else (factors, "sum")
        parts = {
            name: light["groups"]["values"] * factors for name, light in (origins or {}).items()
        }
        super().__init__(core["values"] * factors, core["sunlit_fraction"], organs, time, parts)
        self.groups = core["groups"]
        self._sunlit_area = core["sunlit_area"]
        self._ratios = core["ratios"]
        self._ratio_names = list(ratio_names)
        self._shares = core.get("shares")
        self._parts = core.get("sun_shade")

    @property
    def sun_shade(self):
        """Light of the sunlit and the shaded part of groups, with sun_shade="apart": SunShade."""
        return parts_of(self._parts, self._of)

    def keys(self):
        """Names of the quantities."""
        return [*super().keys(), *(() if self._shares is None else self._SHARES)]

    def __getitem__(self, quantity):
        if self._shares is None or quantity not in self._SHARES:
            return super().__getitem__(quantity)
        units = ("",) * len(self._of.bands)
        shares = self._shares[:, self._SHARES.index(quantity)]
        return Estimates(shares, quantity, units, self._of.bands)

    @property
    def ratios(self):
        """Ratios of bands by group: dict, "R:FR" -> Estimates of shape (groups,)."""
        return _ratio_estimates(self._ratios, self._ratio_names)

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each group and the columns of the CSV files.

        by, value, organs (their number), area, height_min, height_max, plant_area_index,
        cumulative_plant_area_index, ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``,
        sunlit_fraction and sunlit_area where there are directional sources, ``ratio_<ratio>``,
        ``fraction_incident_<band>`` and ``fraction_absorbed_<band>``. The fractions of the canopy are
        in `Result.canopy`.
        """
        import pandas

        columns = {name: [group[name] for group in self.groups] for name in ("by", "value")}
        columns["organs"] = [len(group["organs"]) for group in self.groups]
        for name in (
            "area", "height_min", "height_max", "plant_area_index", "cumulative_plant_area_index"
        ):
            columns[name] = [group[name] for group in self.groups]
        columns.update(self._columns())
        if "sunlit_fraction" in self.keys():
            area = Estimates(self._sunlit_area, "sunlit_area", f"{self._of.length_unit}2")
            columns.update(_estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
            columns.update(_estimate_columns("sunlit_area", area))
        for name, estimates in self.ratios.items():
            columns.update(_estimate_columns(f"ratio_{name}", estimates))
        for band in self._of.bands if self._shares is not None else ():
            for name in self._SHARES:
                columns.update(_estimate_columns(f"{name}_{band}", self[name][band]))
        return pandas.DataFrame(columns)


class Result(_Light):
    """The light of every organ.

    ``result["absorbed_flux"]["PAR"].mean`` is an array of shape (organs,) in the order of
    ``result.organs``, with ``.standard_error``, ``.ci95_low`` and ``.ci95_high`` of the same shape.
    Quantities are listed by `quasimc.quantities()`; with directional sources there is also
    "sunlit_fraction".

    Attributes
    ----------
    organs : Organs
        Ids, names, labels and areas.
    method, reason : str
        Method that was used, and the reason of an automatic choice.
    paths, replicates, rays : int
        Paths of each replicate, number of replicates, rays of all replicates.
    stop : str
        Why the run ended: "finished", "target_reached", "time_limit", "path_limit", "interrupted"
        (Ctrl-C: the result contains the completed paths) or "no_light".
    fraction_at_target : float
        Fraction of the organs (or groups, sensors) that reached the target error; 0 without a
        target.
    preparation_seconds, solve_seconds, solve_cpu_seconds : float
        Wall time of the preparation and of the solution, and CPU time of all threads.
    escaped_by_difference : bool
        Whether escaped light in `budget` is the remainder of the budget.
    rounds : list of dict
        State after each round of a run with a target error or `max_paths`: paths (per replicate,
        of all rounds that it adds to; pilot rounds are replaced), seconds (since the run began),
        median_error and worst_error (relative standard errors over organs and bands),
        fraction_at_target. Empty for one round.
    warnings : list of str
    sources : list of str
        Descriptions of the sources.
    """

    def __init__(self, core, organs, warnings=(), sources=(), ratio_names=()):
        origins = {name: light["values"] for name, light in core.origins.items()}
        super().__init__(core.values, core.sunlit_fraction, organs, origins=origins)
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
        """Ratios of bands by organ: dict, "R:FR" -> Estimates of shape (organs,)."""
        return _ratio_estimates(self._core.ratios, self._ratio_names)

    @cached_property
    def groups(self):
        """Sums over organs: Groups; the first is all organs."""
        return Groups(
            self._core.groups, self.organs, self._ratio_names, origins=self._core.origins
        )

    @cached_property
    def budget(self):
        """Energy budget: dict, band -> dict of Estimate (flux).

        "closure_error" is a float: the fraction of the emitted light that is not accounted for
        (rounding).
        """
        return self._by_band(self._core.budget, ("closure_error",), "absorbed_flux")

    @cached_property
    def canopy(self):
        """Canopy fractions of the light on the horizontal: dict, band -> dict of Estimate.

        "incident" is a float: the flux on the horizontal area.

        Empty without a ground or a cell that is periodic along both axes.
        """
        return self._by_band(self._core.canopy, ("incident",), None)

    @cached_property
    def sensors(self):
        """Light on sensors: dict, name of a set -> `Sensors`, in the order in which they were added."""
        return sensors_by_name(self._core.sensors, self.organs)

    @cached_property
    def detectors(self):
        """Detectors: dict, name -> DetectorResult, in the order in which they were added."""
        units = tuple(self._unit("absorbed_flux", unit) for unit in self.organs.units)
        return {
            seen["name"]: DetectorResult(seen, units, self.bands) for seen in self._core.detectors
        }

    @cached_property
    def sun_shade(self):
        """Light of the sunlit and the shaded part of organs, with sun_shade="apart": SunShade."""
        return parts_of(self._core.sun_shade, self.organs)

    @property
    def audit(self):
        """The audit: dict with p_value, agrees, paths, replicates; None without an audit."""
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
        """Returns the light of organs given by id or name, as a Selection in that order.

        Raises KeyError if an organ does not exist, or several organs have the name.
        """
        return Selection(self, ids)

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ.

        The index is the organ's id; the columns are those of the CSV files: name, labels, area,
        ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``. A label with the name of
        another column becomes ``label_<key>``. Units are in ``frame.attrs["units"]``.
        """
        import pandas

        columns = self._columns()
        if len(self._sunlit):
            columns.update(_estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
        for name, estimates in self.ratios.items():
            columns.update(_estimate_columns(f"ratio_{name}", estimates))
        labels = _label_columns(self.organs.labels, columns)
        columns = {"name": self.organs.names, **labels, "area": self.organs.areas, **columns}
        frame = pandas.DataFrame(columns, index=pandas.Index(self.organs.ids, name="id"))
        frame.attrs["units"] = {
            f"{quantity}_{band}": self[quantity][band].unit
            for quantity in _core.quantities()
            for band in self.bands
        }
        return frame

    def to_xarray(self):
        """Returns an xarray.Dataset with the dimensions organ, band and statistic.

        Statistics are mean, standard_error, ci95_low, ci95_high. Units are attributes of the
        variables. A detector is a variable with its name and the dimension <name>_bin instead of
        organ; if the name is used already, it is ``detector_<name>``.
        """
        import xarray

        variables, dimensions = {}, ("organ", "band", "statistic")
        for i, quantity in enumerate(_core.quantities()):
            units = self[quantity].unit
            attributes = {"units": units[0] if len(set(units)) == 1 else ", ".join(units)}
            variables[quantity] = (dimensions, self._values[:, i], attributes)
        if len(self._sunlit):
            variables["sunlit_fraction"] = (("organ", "statistic"), self._sunlit, {"units": "1"})
        coordinates = {
            "organ": self.organs.ids,
            "band": list(self.bands),
            "statistic": ["mean", "standard_error", "ci95_low", "ci95_high"],
            "name": ("organ", np.asarray(self.organs.names)),
            "area": ("organ", self.organs.areas, {"units": f"{self.organs.length_unit}2"}),
        }
        for key, values in _label_columns(self.organs.labels, [*variables, *dimensions]).items():
            coordinates[key] = ("organ", np.asarray(values))
        taken = [*variables, *coordinates]
        for name, detector in _detector_variables(self.detectors, taken).items():
            variables[name] = detector.to_xarray().rename(bin=f"{name}_bin")
        return xarray.Dataset(variables, coordinates, {"method": self.method})

    def plot(self, quantity="absorbed_flux_density", band=None, **options):
        """Draws the scene with organs coloured by a quantity; see `quasimc.plotting.plot`.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from .plotting import plot

        return plot(self, quantity, band, **options)

    def plot_profile(self, quantity="absorbed_flux_density", band=None, **options):
        """Plots light against height with a fitted curve; see `quasimc.plotting.plot_profile`.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from .plotting import plot_profile

        return plot_profile(self, quantity, band, **options)

    def plot_organs(self, quantity="absorbed_flux_density", band=None, **options):
        """Plots light by organ with a fitted curve; see `quasimc.plotting.plot_organs`.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from .plotting import plot_organs

        return plot_organs(self, quantity, band, **options)

    def __repr__(self):
        return (
            f"<Result: {len(self.organs)} organs, bands {', '.join(self.bands)}; {self.method}, "
            f"{self.paths} paths x {self.replicates} replicates, {self.stop}>"
        )

    def _repr_html_(self):
        from ._html import result_html

        return result_html(self)


class Series:
    """The light of the time steps of ``[time]``, and daily sums.

    ``len(series)`` is the number of time steps; ``series[i]`` is the `Result` of one. With
    keep_times=False there are only sums: ``series[i]``, iteration and `to_pandas` raise KeyError.

    Attributes
    ----------
    organs : Organs
    times : list of dict
        For each time step: time ("2024-06-21T12:00+02:00"), seconds (duration), sun_azimuth_deg,
        sun_elevation_deg, direct and diffuse (W m-2 on the horizontal, full spectrum).
    days : dict
        Date -> `Sums`. Incomplete days of a stopped run are left out. Gaps of a weather file
        (``gaps = "skip"``) are not time steps: their days are summed over the other time steps
        (`Sums.seconds`).
    total : Sums
        Sum over all time steps.
    stop : str
        "finished", "time_limit" or "interrupted".
    time_steps, completed, computed : int
        Number of time steps; of those that were completed; of those that were computed (the
        others are at night or scaled).
    audit_p_value : float
        Smallest p-value of the audits, corrected for their number.
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
            day["date"]: Sums(
                day["values"], day["seconds"], self.organs, day["groups"], day["origins"],
                day["sensors"], day["sun_shade"],
            )
            for day in self._core.days
        }

    @cached_property
    def total(self):
        return Sums(
            self._core.total, self.total_seconds, self.organs, self._core.total_groups,
            self._core.total_origins, self._core.total_sensors, self._core.total_sun_shade,
        )

    def __len__(self):
        return len(self.times)

    def _kept(self):
        """The results of the time steps. Raises KeyError if they were not kept."""
        if not self._results and self.times:
            raise KeyError("the time steps were not kept (keep_times=False)")
        return self._results

    def __getitem__(self, index):
        if isinstance(index, str):
            raise TypeError(
                f"a Series has a result for each time step: use series[0][{index!r}] or "
                f"series.total[{index!r}]"
            )
        return self._kept()[index]

    def __iter__(self):
        return iter(self._kept())

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each time step and organ, indexed by both.

        Raises KeyError if the time steps were not kept (keep_times=False); `days` and `total` have
        tables of their own.
        """
        import pandas

        names = [moment["time"] for moment in self.times]
        tables = [result.to_pandas() for result in self._kept()]
        return pandas.concat(tables, keys=names, names=["time", "id"])

    def __repr__(self):
        return f"<Series: {len(self)} times, {len(self.organs)} organs, {self.stop}>"


class Sums(_Light):
    """Light summed over a day, or over all days; indexed like a result.

    Units are multiplied by time: J m-2 for W m-2, mol m-2 for umol m-2 s-1.

    Attributes
    ----------
    seconds : float
        Duration of the time steps that were summed.
    groups : Groups
        Sums over organs with their errors, as for a result.
    sensors : dict
        Name of a set -> `Sensors`.
    """

    def __init__(
        self, values, seconds, organs, groups=None, origins=None, sensors=None, sun_shade=None
    ):
        factors = np.array([_core.summed_unit(unit)[1] for unit in organs.units])[:, None]
        parts = {name: light["values"] * factors for name, light in (origins or {}).items()}
        super().__init__(values * factors, None, organs, time="sum", origins=parts)
        self.seconds = seconds
        self.sensors = sensors_by_name(sensors, organs, is_sum=True)
        self.groups = (
            None
            if groups is None
            else Groups(groups, organs, factors=factors, origins=origins)
        )
        self._parts = sun_shade

    @property
    def sun_shade(self):
        """Light of the sunlit and the shaded part of organs, with sun_shade="apart": SunShade."""
        return parts_of(self._parts, self._of)

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ, indexed by id; columns as for a result."""
        import pandas

        columns = self._columns()
        labels = _label_columns(self._of.labels, columns)
        columns = {"name": self._of.names, **labels, "area": self._of.areas, **columns}
        return pandas.DataFrame(columns, index=pandas.Index(self._of.ids, name="id"))


def _ratio_estimates(values, names):
    return {
        name: Estimates(values[:, i], f"ratio {name}", "") for i, name in enumerate(names)
    }


def _label_columns(labels, others):
    """Labels by the names of their columns, which no other column has."""
    taken = {"id", "name", "area", *others}
    columns = {}
    for key, values in labels.items():
        name = key
        while name in taken or (name != key and name in labels):
            name = f"label_{name}"
        columns[name] = values
    return columns


def _detector_variables(detectors, others):
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


def _estimate_columns(name, estimates):
    return {
        name: estimates.mean,
        f"{name}_se": estimates.standard_error,
        f"{name}_ci95_high": estimates.ci95_high,
    }
