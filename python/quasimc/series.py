"""Results of time series, and their sums over days."""

from __future__ import annotations

import json
from functools import cached_property

import numpy as np

from . import _core
from ._index import OrganIndex, RunIndex, time_index
from ._light import Light, label_columns, origins_of
from ._meshes import plain
from ._optional import needed
from ._rows import Rows
from ._stacked_light import stacked
from ._time_sum import TimeLights
from .control import Control
from .groups import Groups
from .result import Result
from .sensors import sensors_by_name
from .sun_shade import parts_of


class Series:
    """The light of many time steps, and daily sums.

    ``len(series)`` is the number of time steps; ``series[i]`` is the `Result` of one, and
    ``series["absorbed_flux"]`` are the `Estimates` of all, of shape (times, organs, bands). With
    keep="sums" there are only sums: ``series[i]``, iteration and `to_pandas` raise KeyError.

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
        Sum over all time steps. Of instants, which have no duration, there are no sums: `total` and
        `days` raise ValueError.
    stop : str
        "finished", "time_limit" or "interrupted".
    time_steps, completed, computed : int
        Number of time steps; of those that were completed; of those that were computed (the
        others are at night or scaled).
    audit_p_value : float
        Smallest p-value of the audits, corrected for their number.
    """

    def __init__(self, core, organs, warnings=(), sources=(), ratio_names=(), written=None):
        self._core = core
        self._written = written  # what it was computed from; None: unknown
        self.organs = organs
        self.warnings = list(warnings)
        self.sources = list(sources)
        self._ratio_names = list(ratio_names)
        self.times = core.times
        for name, value in core.facts.items():
            setattr(self, name, value)

    @cached_property
    def _results(self):
        others = self.organs, self.warnings, self.sources, self._ratio_names
        return [
            Result(core, *others, replicates)
            for core, replicates in zip(self._core.results, self._core.replicates)
        ]

    def _check_duration(self):
        """Refuses sums over instants: they would be 0."""
        if self.completed and not self.total_seconds:
            raise ValueError(
                "the times are instants, so that sums over them would be 0; give a duration: "
                "quasimc.times(..., duration_minutes=60)"
            )

    @cached_property
    def days(self):
        self._check_duration()
        return Days(
            (
                day["date"],
                Sums(
                    day["values"], day["seconds"], self.organs, day["groups"], day["origins"],
                    day["sensors"], day["sun_shade"], self._lights_of(day["weights"]),
                ),
            )
            for day in self._core.days
        )

    @cached_property
    def total(self):
        self._check_duration()
        return Sums(
            self._core.total, self.total_seconds, self.organs, self._core.total_groups,
            self._core.total_origins, self._core.total_sensors, self._core.total_sun_shade,
            self._lights_of(self._core.total_weights),
        )

    def _lights_of(self, weights):
        """The light that a sum over time is made of, of all and of origins apart: a pair, or None."""
        rows, weights = weights
        results = [self._results[row] for row in rows]
        if not results or not all(result.has_replicates for result in results):
            return None
        parts = [result._parts for result in results]
        return (
            TimeLights([result._replicates for result in results], weights),
            None if None in parts else TimeLights(parts, weights),
        )

    @cached_property
    def control(self):
        """Lamps under control (`Scene.add_control`): a dict, pattern of the lamps -> `Control`."""
        times = self._core.step_times
        return {own["sources"]: Control(own, times) for own in self._core.control}

    def controlled(self, sources, sensors, **keys):
        """Has lamps switched and dimmed after the run: only the light at the sensors is computed.

        The decisions are those of a run with `Scene.add_control`, whose arguments these are. The series
        must have been run without control, with the lamps as an origin of their own.

        Parameters
        ----------
        sources : str
            Pattern of the names of lamps.
        sensors : str
            Name of flat sensors of the scene.
        **keys
            on_below, daily_target, set_point, dim_min, electrical_power_w, band.

        Returns
        -------
        ControlledLight

        Raises
        ------
        InputError
            If the rules, the lamps or the sensors are invalid.
        ValueError
            If the run had a control, or no origin is the light of these lamps alone.

        Examples
        --------
        >>> series = scene.series(day, origins=["sun", "sky", "hps *"])  # doctest: +SKIP
        >>> series.controlled("hps *", "bench", on_below=150).kwh.sum()  # doctest: +SKIP
        """
        from .control import ControlledLight

        if self._core.control:
            raise ValueError("the lamps of this run were under control already: run without add_control")
        document = self._written.document(self.organs)
        rule = plain({"sources": sources, "sensors": sensors, **keys})
        table = {**document.table(), "control": [rule]}
        own = _core.controlled(_core.Document(table, document.name, document.folder))
        if not own["origin"]:
            raise ValueError(
                f"no origin is the light of {sources!r} alone: run with "
                f'origins=["sun", "sky", {json.dumps(sources)}]'
            )
        return ControlledLight(own, self._core.step_times, self)

    def __len__(self):
        return len(self.times)

    def _results_of_times(self):
        """The results of the time steps. Raises KeyError if they were not kept."""
        if not self._results and self.times:
            raise KeyError('the time steps were not kept (keep="sums")')
        return self._results

    def __getitem__(self, index):
        if not isinstance(index, str):
            return self._results_of_times()[index]
        return self._stacked(self._lights(index))

    def _lights(self, quantity):
        """The light of each time step; of those that are scaled from others with the replicates of these."""
        results = self._results_of_times()
        if not results:
            raise ValueError("there is no time step")
        lights = [result[quantity] for result in results]
        if quantity in _core.quantities():
            for row, (other, factor) in enumerate(self._core.scaled_from):
                if factor > 0:
                    lights[row] = lights[row]._with_source_of(lights[other], factor)
        return lights

    def _stacked(self, lights):
        """The light of all time steps as one, from that of each."""
        return stacked(lights, RunIndex("time", ["time"], self._time_names()))

    def _time_names(self):
        return [step["time"] for step in self.times]

    def __iter__(self):
        return iter(self._results_of_times())

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each time step and organ, indexed by both.

        Times are a pandas.DatetimeIndex with the offset from UTC of the first; nights have rows as well.
        ``reset_index()`` makes columns of "time" and "id", for pivot and to_csv(index=False).

        Raises KeyError if the time steps were not kept (keep="sums"); `days` and `total` have
        tables of their own.
        """
        pandas = needed("pandas")

        tables = [result.to_pandas() for result in self._results_of_times()]
        frame = pandas.concat(tables, keys=time_index(self._time_names()), names=["time", "id"])
        frame.attrs = tables[0].attrs
        return frame

    def to_xarray(self):
        """Returns an xarray.Dataset with the variables of `Result.to_xarray` along ``time``, and of days.

        Times are the beginnings of the time steps in UTC; ``time_text`` has them in local time. Sums
        over days are ``absorbed_flux_day_sum``, ``bench_incident_upper_day_sum``, ... along ``day``, as
        in NetCDF files. With keep="sums" there are only these; of instants there are none. What a time
        step lacks, such as sunlit fractions at night, is NaN.
        """
        from ._datasets import series_dataset

        return series_dataset(self)

    @property
    def plot(self):
        """Plots by matplotlib: SeriesPlots, with course."""
        from .plotting import SeriesPlots

        return SeriesPlots(self)

    def save(self, path, **table):
        """Writes the series to a file, in the format of its ending.

        ".json": all but replicates, for `quasimc.open` and the program; ".csv": the table of organs and
        times; ".nc": NetCDF; ".vtp", ".glb", ".ply": the scene with the sum over all times. Time steps
        at night, whose light is 0, are not written.

        Parameters
        ----------
        path : str or path
        **table
            For ".csv", another table, with the keys of ``[[table]]`` (docs/reference/csv.md): rows
            ("groups", "sensors", ...), per ("day", "period"), form, where, quantities, bands, origins,
            statistics, digits.

        Returns
        -------
        pathlib.Path

        Raises
        ------
        InputError
            If the ending is unknown.
        FileNotFoundError
            If the folder does not exist.
        KeyError
            If the time steps of a table were not kept (keep="sums").
        """
        from ._store import save

        return save(self, path, table)

    def __reduce__(self):
        from ._store import state_of

        return state_of(self)

    def __repr__(self):
        return f"<Series: {len(self)} times, {len(self.organs)} organs, {self.stop}>"


class Days(dict):
    """Sums by date."""

    def __missing__(self, date):
        known = f"{next(iter(self))} to {list(self)[-1]}" if self else "none"
        raise KeyError(f"there is no day {date!r}; there are: {known}")


class Sums(Light):
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
        self, values, seconds, organs, groups=None, origins=None, sensors=None, sun_shade=None,
        lights=None,
    ):  # fmt: skip
        count = len(organs)
        whole, parts = lights or (None, None)
        super().__init__(
            values[:count],
            OrganIndex(organs),
            organs,
            rows=Rows.of_organs(np.arange(count)),
            replicates=whole,
            origins=origins_of(origins or {}, parts, lambda light: light["values"][:count]),
            is_summed=True,
        )
        self.seconds = seconds
        self.sensors = sensors_by_name(sensors, organs, is_sum=True)
        self.groups = (
            None
            if groups is None
            else Groups(
                groups, organs, replicates=whole, parts=parts, origins=origins, is_summed=True
            )
        )
        self._parts = sun_shade

    @property
    def sun_shade(self):
        """Light of the sunlit and the shaded part of organs, with sun_shade="apart": SunShade."""
        return parts_of(self._parts, self._index, self._organs)

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ, indexed by id; columns as for a result.

        Units, which are those of sums over time, are in ``frame.attrs["units"]``.
        """
        pandas = needed("pandas")

        columns = self._columns()
        organs = self._organs
        labels = label_columns(organs.labels, columns)
        columns = {"name": organs.names, **labels, "area": organs.areas, **columns}
        frame = pandas.DataFrame(columns, index=pandas.Index(organs.ids, name="id"))
        frame.attrs["units"] = self._column_units()
        return frame
