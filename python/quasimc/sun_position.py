"""Position of the sun."""

from __future__ import annotations

import math

from . import _core


class SunPosition:
    """Position of the sun at a site.

    Attributes
    ----------
    azimuth_deg : float
        Clockwise from north, 0 to 360.
    elevation_deg : float
        Above the horizon, with refraction.
    true_elevation_deg : float
        Without refraction.
    zenith_deg : float
        90 - elevation_deg.
    distance_au : float
        Distance of Earth and sun, astronomical units.
    declination_deg : float
    equation_of_time_min : float
        Apparent minus mean solar time.
    """

    __slots__ = (
        "azimuth_deg",
        "elevation_deg",
        "true_elevation_deg",
        "zenith_deg",
        "distance_au",
        "declination_deg",
        "equation_of_time_min",
    )

    def __init__(self, position):
        for name in self.__slots__:
            setattr(self, name, getattr(position, name))

    @property
    def vector(self):
        """Unit vector towards the sun: x east, y north, z up; a tuple of 3 floats."""
        azimuth, elevation = math.radians(self.azimuth_deg), math.radians(self.elevation_deg)
        flat = math.cos(elevation)
        return (flat * math.sin(azimuth), flat * math.cos(azimuth), math.sin(elevation))

    def __repr__(self):
        return (
            f"SunPosition(azimuth_deg={self.azimuth_deg:.4f}, "
            f"elevation_deg={self.elevation_deg:.4f})"
        )


def _time_text(time):
    return time if isinstance(time, str) else time.isoformat()


def _site(latitude_deg, longitude_deg, elevation_m, pressure_hpa, temperature_c):
    return _core.Site(latitude_deg, longitude_deg, elevation_m, pressure_hpa, temperature_c)


def sun_position(
    latitude_deg,
    longitude_deg,
    time,
    *,
    elevation_m=0.0,
    pressure_hpa=None,
    temperature_c=12.0,
    delta_t_s=None,
):
    """Position of the sun by the solar position algorithm of NREL (Reda and Andreas 2004).

    Parameters
    ----------
    latitude_deg : float
        -90 to 90, north positive.
    longitude_deg : float
        -180 to 180, east positive.
    time : str or datetime.datetime
        With its time zone: "2024-06-21T12:00+02:00".
    elevation_m : float
        Above the sea.
    pressure_hpa, temperature_c : float
        Annual means, for refraction; default: standard atmosphere, 12 degrees.
    delta_t_s : float
        Terrestrial minus universal time; default: by year.

    Returns
    -------
    SunPosition
    """
    site = _site(latitude_deg, longitude_deg, elevation_m, pressure_hpa, temperature_c)
    return SunPosition(_core.sun_position(site, _time_text(time), delta_t_s))


def sun_day(latitude_deg, longitude_deg, date, *, elevation_m=0.0):
    """Sunrise, transit and sunset.

    Parameters
    ----------
    latitude_deg, longitude_deg, elevation_m : float
        As of `sun_position`.
    date : str or datetime.datetime
        A time of the day, with its time zone.

    Returns
    -------
    dict
        kind ("ordinary", "polar_day", "polar_night"), transit, sunrise and sunset (ISO 8601
        texts, or None), transit_elevation_deg.
    """
    site = _site(latitude_deg, longitude_deg, elevation_m, None, 12.0)
    return dict(_core.sun_day(site, _time_text(date)))
