"""Names of keywords, checked at the call: those of a run file (docs/reference/run-file.md)."""

from __future__ import annotations

import difflib

from . import _core
from ._meshes import input_error
from .errors import InputError, KeywordError

_POSITION = ("azimuth_deg", "elevation_deg")
_ALL_SOURCES = ("type", "name", "on_hours")
#: Keys of ``[[source]]`` by type, and those of lamps.
SOURCE_KEYS = {
    "directional": ("direction", *_POSITION, "irradiance_facing", "irradiance_horizontal"),
    "sun": ("time", "delta_t_s", *_POSITION, "disk", "irradiance_facing", "irradiance_horizontal"),
    "sky": (
        "model", "irradiance_horizontal", "time", "delta_t_s", *_POSITION, "cie_type", "direct_normal",
        "diffuse_horizontal", "turbidity", "file", "format", "values",
    ),
    "uniform_sky": ("irradiance_horizontal",),
}  # fmt: skip
LAMP_KEYS = (
    "position", "aim", "along", "length", "width", "radius", "from", "to", "cone_deg", "soft_from_deg",
    "exponent", "file", "opening", "power", "photon_flux", "luminous_flux", "at",
)  # fmt: skip

#: Keys of ``[time]``.
TIME_KEYS = (
    "times", "duration_minutes", "day", "from", "to", "hours", "step_minutes", "utc_offset_hours",
    "sun_step_minutes", "cumulative_sky", "global", "direct_horizontal", "beam_normal", "diffuse",
    "weather", "weather_format", "columns", "stamp", "year", "missing_values", "gaps", "unit",
    "diffuse_fraction", "linke_turbidity", "spectrum", "sky", "overcast_sky", "cie_type", "turbidity",
)  # fmt: skip

#: Keys of ``[[table]]`` that `save` takes.
TABLE_KEYS = (
    "rows", "per", "form", "where", "quantities", "bands", "origins", "statistics", "digits",
)  # fmt: skip

_CLOCK = "utc_offset_hours=2 is the offset of the clock from UTC"
#: Names of other programs.
_ELSEWHERE = {"timezone": _CLOCK, "tz": _CLOCK}


def keyword_error(call, key, hint=""):
    """The error of a keyword that a call does not have. @param hint: what to write instead, or "" """
    text = f"{call}() has no keyword {key!r}" + (f"; {hint}" if hint else "")
    return KeywordError(text, [{"where": f"{call}()", "problem": text, "why": "", "suggestion": ""}])


def near(key, known, otherwise=""):
    """"did you mean 'x'?" for a misspelled name."""
    found = difflib.get_close_matches(str(key), [str(each) for each in known], 1)
    return f"did you mean {found[0]!r}?" if found else otherwise


def check_time_keys(keys, call):
    """Refuses keywords that are no keys of ``[time]``. Raises KeywordError."""
    for key in keys:
        if key not in TIME_KEYS:
            hint = _ELSEWHERE.get(key) or near(key, TIME_KEYS, f"it has {', '.join(TIME_KEYS)}")
            raise keyword_error(call, key, hint)


def check_source(keys, call):
    """Refuses an unknown type, and keywords that sources of the type do not have. Raises InputError."""
    type, types = keys["type"], dict(_core.sources())
    if type not in types:
        raise input_error("Source", f"there is no type {type!r}", "", near(type, types, f"use {', '.join(types)}"))
    known = SOURCE_KEYS.get(type, LAMP_KEYS)
    for key in keys:
        if key not in known and key not in _ALL_SOURCES:
            raise keyword_error(call, key, near(key, known, f"it has {', '.join(known)}"))


def check_site(table):
    """Refuses a site that is not on the Earth. Raises InputError."""
    try:
        _core.Frame(_core.Document({"bands": ["PAR"], "site": table}, "Site", ""))
    except InputError as error:
        problems = [line.rpartition("Scene.site: ")[2] for line in str(error).splitlines()]
        raise input_error("Site", "; ".join(problems)) from None
