"""The diffuse part of the light of an hour.

Spitters, Toussaint and Goudriaan (1986), "Separating the diffuse and direct component of global
radiation and its implications for modeling canopy photosynthesis", Agricultural and Forest
Meteorology 38, 217-229.
"""

from __future__ import annotations

import math

#: Irradiance of the sun outside of the air, W m-2, as in the paper.
SOLAR_CONSTANT = 1370.0


def declination(DOY):
    """Of the sun on a day of the year, radians."""
    return -math.radians(23.45) * math.cos(2 * math.pi * (DOY + 10) / 365)


def sin_elevation(DOY, heureTU, latitude):
    """Sine of the sun's elevation; the hour is true solar time, the latitude in degrees."""
    down, phi = declination(DOY), math.radians(latitude)
    angle = math.radians(15 * (heureTU - 12))
    return math.sin(phi) * math.sin(down) + math.cos(phi) * math.cos(down) * math.cos(angle)


def RdRsH(Rg, DOY, heureTU, latitude):
    """The fraction of global radiation that is diffuse, 0 to 1; 1 while the sun is down.

    Parameters
    ----------
    Rg : float
        Global radiation on the horizontal, W m-2.
    DOY, heureTU : float
        Day of the year, and hour: true solar time.
    latitude : float
        Degrees.
    """
    sine = sin_elevation(DOY, heureTU, latitude)
    if sine <= 0:
        return 1.0
    outside = SOLAR_CONSTANT * (1 + 0.033 * math.cos(2 * math.pi * DOY / 365)) * sine
    through = Rg / outside
    clear = 0.847 - 1.61 * sine + 1.04 * sine**2
    if through <= 0.22:
        return 1.0
    if through <= 0.35:
        return 1 - 6.4 * (through - 0.22) ** 2
    if through <= (1.47 - clear) / 1.66:
        return 1.47 - 1.66 * through
    return clear
