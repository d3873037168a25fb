"""The sun of a day and an hour."""

from __future__ import annotations

import math
from typing import NamedTuple

from .spitters_horaire import declination, sin_elevation


class Sun(NamedTuple):
    """The sun as a cell of `GenSky` is given: energy on the horizontal, and radians."""

    energy: float
    azimuth: float
    zenith: float

    @property
    def azim(self):
        """The azimuth, from X+ (north) to Y+ (west), radians."""
        return self.azimuth

    @property
    def elev(self):
        """The elevation above the horizon, radians."""
        return math.pi / 2 - self.zenith


class Gensun:
    """Calling it gives the `Sun`."""

    def __call__(self, Rsun=1.0, DOY=1, heureTU=12, lat=0.0):
        """The sun, as a cell of `GenSky` is given.

        Parameters
        ----------
        Rsun : float
            Energy on the horizontal; nothing while the sun is down.
        DOY, heureTU : float
            Day of the year, and hour: true solar time.
        lat : float
            Latitude, degrees.

        Returns
        -------
        Sun
            Unpacked: energy, azimuth, zenith. Azimuth from X+ to Y+, where X+ is north and Y+
            is west, as in `light_sources`.
        """
        sine = sin_elevation(DOY, heureTU, lat)
        down, latitude = declination(DOY), math.radians(lat)
        angle = math.radians(15 * (heureTU - 12))
        west = math.cos(down) * math.sin(angle)
        north = math.sin(down) * math.cos(latitude) - math.cos(down) * math.sin(latitude) * math.cos(
            angle
        )
        zenith = math.atan2(math.hypot(west, north), sine)
        return Sun(Rsun if sine > 0 else 0.0, math.atan2(west, north), zenith)
