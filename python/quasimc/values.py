"""Values that one assigns to a scene: ground, cell, site, time, options; sources are values too.

They never change; ``replace`` makes others. Their keys are those of the sections of a run file
(docs/reference/run-file.md), and a scene checks what they say when it is built.
"""

from __future__ import annotations

import datetime
import os
from collections.abc import Mapping

from . import _core
from ._keys import check_site, check_time_keys, keyword_error, near
from ._meshes import input_error, plain

#: Keys of paths, which are kept with the folder that was the current one.
_PATHS = ("file", "weather", "spectrum")


class Value:
    """Keys with their values; two are equal if all of these are."""

    __slots__ = ("_keys",)

    def __init__(self, **keys):
        given = {key: plain(value) for key, value in keys.items() if value is not None}
        for key in _PATHS:
            if key in given:
                given[key] = os.fspath(given[key])
        object.__setattr__(self, "_keys", given)

    @classmethod
    def _of(cls, table):
        """The value of a section of a run file."""
        value = cls.__new__(cls)
        Value.__init__(value, **table)
        return value

    def table(self):
        """The keys that were given, as in a run file: dict."""
        return dict(self._keys)

    def replace(self, **keys):
        """Another value: some keys are changed; None removes one."""
        return type(self)(**{**self._keys, **keys})

    def __getattr__(self, key):
        if key.startswith("_") or key not in type(self).__init__.__code__.co_varnames:
            raise AttributeError(f"{type(self).__name__} has no {key!r}")
        return self._keys.get(key)

    def __setattr__(self, key, value):
        name = type(self).__name__
        raise AttributeError(f"a {name} does not change: assign a new one, replace({key}={value!r})")

    def __reduce__(self):
        return type(self)._of, (self._keys,)

    def __eq__(self, other):
        return type(self) is type(other) and self._keys == other._keys

    __hash__ = None

    def __repr__(self):
        keys = ", ".join(f"{key}={value!r}" for key, value in self._keys.items())
        return f"{type(self).__name__}({keys})"


class Keyed(Value):
    """A value with keys of any name, of which those that were given can be read."""

    __slots__ = ()

    def __getattr__(self, key):
        if key.startswith("_") or key not in self._keys:
            kind, known = type(self).__name__, ", ".join(self._keys) or "nothing"
            raise AttributeError(f"this {kind} has no {key!r}; it has {known}")
        return self._keys[key]


class Ground(Value):
    """A ground: horizontal, or a surface from a file.

    Parameters
    ----------
    material : str
    height : float
        Length unit; default 0.
    x, y, z : (low, high)
        Extent along the horizontal axes; default, for each: the cell, or that of the organs.
    name : str
        Default "ground".
    measured : bool
        Whether its light is asked for; default True.
    file, format, transform
        A surface instead, as of `Scene.add_file`.
    """

    __slots__ = ()

    def __init__(
        self, material, *, height=None, x=None, y=None, z=None, name=None, measured=None, file=None,
        format=None, transform=None,
    ):  # fmt: skip
        super().__init__(
            material=material, height=height, x=x, y=y, z=z, name=name, measured=measured, file=file,
            format=format, transform=transform,
        )  # fmt: skip


class Cell(Value):
    """A periodic cell: the scene repeats along the axes that are given.

    Parameters
    ----------
    x, y, z : (low, high)
        Length unit; two horizontal axes at most.
    file : path
        A pattern of Caribu instead.
    """

    __slots__ = ()

    def __init__(self, x=None, y=None, z=None, *, file=None):
        super().__init__(x=x, y=y, z=z, file=file)


class Site(Value):
    """A site on the Earth, for the position of the sun.

    Parameters
    ----------
    latitude_deg : float
        -90 to 90, north positive.
    longitude_deg : float
        -180 to 180, east positive.
    elevation_m : float
        Above sea level; default 0.
    pressure_hpa, temperature_c : float
        Annual means, for refraction; default: the standard atmosphere, 12.

    Raises
    ------
    InputError
        If a value is outside its domain.
    """

    __slots__ = ()

    def __init__(
        self, latitude_deg, longitude_deg, *, elevation_m=None, pressure_hpa=None, temperature_c=None
    ):
        super().__init__(
            latitude_deg=latitude_deg, longitude_deg=longitude_deg, elevation_m=elevation_m,
            pressure_hpa=pressure_hpa, temperature_c=temperature_c,
        )  # fmt: skip
        check_site(self._keys)


class Time(Keyed):
    """Time steps and their daylight: the keys of ``[time]`` (docs/reference/run-file.md#time).

    `day`, `days`, `times` and `weather` are short ways to the usual ones. A list of `datetime` or a
    pandas index may be given as `times`. Raises KeywordError for a name that is no key; values are checked
    when a run begins.

    Examples
    --------
    >>> quasimc.Time(day="2024-06-21", utc_offset_hours=1, hours=[10, 14])
    Time(day='2024-06-21', utc_offset_hours=1, hours=[10, 14])
    """

    __slots__ = ()

    def __init__(self, **keys):
        check_time_keys(keys, "Time")
        super().__init__(**{key: _as_text(value) for key, value in keys.items()})


class RunOptions(Keyed):
    """Options of the runs of a scene: the keywords of `Scene.run`, of which each overrides its own here.

    Raises KeywordError for a name that is no option; values are checked when a run begins.

    Examples
    --------
    >>> quasimc.RunOptions(paths=4096, method="ray_bundles")
    RunOptions(paths=4096, method='ray_bundles')
    """

    __slots__ = ()

    def __init__(self, **keys):
        check_options(keys, "RunOptions")
        super().__init__(**keys)


#: Keywords that another call has.
_ELSEWHERE = {
    "time": "days and seasons are scene.series(quasimc.day(...))",
    "keep_times": 'sums alone are scene.series(..., keep="sums")',
}


def check_options(keys, call):
    """Refuses keywords of a call that are no options."""
    known = [option["key"] for option in _core.options()]
    for key in keys:
        if key not in known:
            hint = near(key, [*known, "progress", "keep"], "quasimc.options() lists them")
            raise keyword_error(call, key, _ELSEWHERE.get(key, hint))


def checked_time(value):
    """The time steps of a call."""
    if isinstance(value, Time):
        return value
    hint = "quasimc.Time(**keys)" if isinstance(value, Mapping) else "quasimc.day(date, ...)"
    raise input_error("time", f"{value!r} is not a Time", "", f"give {hint}")


def _as_text(value):
    """Dates and times as texts of a run file."""
    if isinstance(value, datetime.date):  # and datetime
        return value.isoformat()
    if hasattr(value, "to_pydatetime"):  # a pandas index, or a time stamp
        return _as_text(value.to_pydatetime())
    if isinstance(value, (list, tuple)) or getattr(value, "dtype", None) == object:
        return [_as_text(each) for each in value]
    return value


def _dated(call, utc_offset_hours, keys, **dates):
    """The time steps of dates, which need the offset of their clock."""
    check_time_keys(keys, call)
    if utc_offset_hours is None:
        raise TypeError(f"{call}() needs utc_offset_hours, the offset of the clock from UTC")
    return Time(**dates, utc_offset_hours=utc_offset_hours, **keys)


def day(date, *, utc_offset_hours=None, **keys):
    """The time steps of one day.

    Parameters
    ----------
    date : str or date
        "2024-06-21".
    utc_offset_hours : float
        Offset of the clock from UTC; required.
    **keys
        hours, step_minutes and others of `Time`; without an amount of light the sky is clear.

    Returns
    -------
    Time
    """
    return _dated("day", utc_offset_hours, keys, day=date)


def days(start, end, *, utc_offset_hours=None, **keys):
    """The time steps of all days from the first to the last, both included; see `day`."""
    return _dated("days", utc_offset_hours, keys, **{"from": start, "to": end})


def times(sequence, **keys):
    """Instants, or time steps of duration_minutes.

    Parameters
    ----------
    sequence : list of str or datetime, or a pandas index
        Without an offset from UTC they need `utc_offset_hours`.
    **keys
        Others of `Time`: duration_minutes, and readings of sensors, one for each time.

    Returns
    -------
    Time
    """
    check_time_keys(keys, "times")
    return Time(times=sequence, **keys)


def weather(path, *, start=None, end=None, **keys):
    """The records of a weather file (docs/reference/weather.md).

    Parameters
    ----------
    path : str or path
        EPW or CSV.
    start, end : str or date
        First and last day; default: all.
    **keys
        Others of `Time`: columns, gaps, utc_offset_hours, ...

    Returns
    -------
    Time
    """
    check_time_keys(keys, "weather")
    return Time(weather=path, **{"from": start, "to": end}, **keys)
