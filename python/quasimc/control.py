"""Lamps that are switched and dimmed by the light at sensors."""

from __future__ import annotations

import numpy as np

from ._optional import needed
from .estimates import Estimates


class Control:
    """What a ``[[control]]`` made of its lamps, by time and by day.

    ``series.control["hps *"].light.values`` is the light at the sensors of the control at each time.

    Attributes
    ----------
    sources, sensors, band : str
        Pattern of its lamps; set of sensors, of whose upper sides the mean is taken; band.
    lamp_count : int
    factor : numpy.ndarray
        (times,): factor on the light of the lamps, mean over the time, 0 to 1.
    on : numpy.ndarray
        (times,): part of the time in which they are on, dimmed or not.
    kwh : numpy.ndarray
        (times,): electrical energy.
    is_near_threshold : numpy.ndarray of bool
        (times,): whether daylight is within two standard errors of on_below.
    daylight, lamps, light : Estimates
        (times,): daylight at the sensors, that of the lamps, and all light, in the unit of the band.
    days : dict
        Date -> `ControlDay`.
    """

    def __init__(self, own, times):
        self.sources, self.sensors, self.band = own["sources"], own["sensors"], own["band"]
        self.lamp_count = own["lamp_count"]
        self.factor = np.array(own["factor"])
        self.on = np.array(own["on"])
        self.kwh = np.array(own["kwh"])
        self.is_near_threshold = np.array(own["is_near_threshold"], dtype=bool)
        self.daylight, self.lamps, self.light = (
            Estimates(np.array(own[name]).reshape(-1, 4), name, own["unit"], extensive=False)
            for name in ("daylight", "lamps", "light")
        )
        self.days = {date: ControlDay(day, own["sum_unit"]) for date, day in own["days"].items()}
        self._times = times

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each time."""
        pandas = needed("pandas")

        columns = {"factor": self.factor, "on": self.on, "kwh": self.kwh}
        for name in ("daylight", "lamps", "light"):
            light = getattr(self, name)
            columns[name], columns[f"{name}_se"] = light.values, light.standard_error
        return pandas.DataFrame(columns, index=pandas.Index(self._times, name="time"))

    def __repr__(self):
        hours = sum(day.hours_on for day in self.days.values())
        kwh = sum(day.kwh for day in self.days.values())
        return f"<Control {self.sources!r}: {self.lamp_count} lamps, on {hours:.1f} h, {kwh:.3g} kWh>"


class ControlledLight(Control):
    """Lamps under control after a run without it (`Series.controlled`), and the light with them.

    ``controlled["absorbed_flux"]`` are the `Estimates` of a quantity at all times, of shape (times,
    organs, bands). An instant's light is linear in the flux of the lamps: all light times `factor`, and
    that of all other origins times 1 - `factor`. Errors are for the given factors; where several
    origins are dimmed or off in part, they need the replicates: ``keep="replicates"``.
    """

    def __init__(self, own, times, series):
        super().__init__(own, times)
        self._series = series
        self._origin = own["origin"]

    def __getitem__(self, quantity):
        factors = dict(zip(self._times, self.factor))
        lights = self._series._lights(quantity)
        return self._series._stacked(
            [self._dimmed(light, factors[step["time"]]) for light, step in zip(lights, self._series.times)]
        )

    def _dimmed(self, light, factor):
        """The light of a time, whose lamps are dimmed. One part alone keeps its interval."""
        if factor == 1 or not light.origins or _is_dark(light.origin(self._origin)):
            return light
        others = [light.origin(name) for name in light.origins if name != self._origin]
        others = [part for part in others if not _is_dark(part)]
        if not others:
            return light * factor
        parts = [part * (1 - factor) for part in others]
        return sum(parts[1:], parts[0]) if factor == 0 else sum(parts, light * factor)


def _is_dark(light):
    """Whether light is certainly 0."""
    return not np.any(light.values) and not np.any(light.standard_error) and not np.any(light.ci95_high)


class ControlDay:
    """A day of lamps under control.

    Attributes
    ----------
    hours_on, kwh, hours_near_threshold : float
    lamps, light : Estimates
        Sums over the day at the sensors, without axes: light of the lamps, and all light; mol m-2 or
        J m-2.
    """

    def __init__(self, own, unit):
        self.hours_on, self.kwh = own["hours_on"], own["kwh"]
        self.hours_near_threshold = own["hours_near_threshold"]
        self.lamps, self.light = (
            Estimates(np.array(own[name]), name, unit, extensive=False) for name in ("lamps", "light")
        )
