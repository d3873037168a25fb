"""Lights: lists of (energy on the horizontal, direction of travel)."""

from __future__ import annotations

import math

import numpy as np


def vecteur_direction(elevation, azimuth):
    """Towards a point of the sky: elevation and azimuth in degrees, azimuth from X+ to Y+."""
    el, az = math.radians(elevation), math.radians(azimuth)
    return (math.cos(el) * math.cos(az), math.cos(el) * math.sin(az), math.sin(el))


def light_sources(elevation, azimuth, irradiance, orientation=0):
    """Lights from points of the sky.

    Parameters
    ----------
    elevation, azimuth : float or sequence
        Degrees; azimuth from north, clockwise.
    irradiance : float or sequence
        On the horizontal.
    orientation : float
        From X+ to north, clockwise; degrees.

    Returns
    -------
    list of (irradiance, (dx, dy, dz))
    """
    columns = [np.atleast_1d(np.asarray(x, dtype=float)) for x in (elevation, azimuth, irradiance)]
    lights = []
    for el, az, energy in zip(*np.broadcast_arrays(*columns)):
        x, y, z = vecteur_direction(el, -(az + orientation))
        lights.append((float(energy), (-x, -y, -z)))
    return lights


def light_source(energy, elevation, azimuth):
    """One light; azimuth from X+ to Y+, degrees: list of one (energy, (dx, dy, dz))."""
    x, y, z = vecteur_direction(elevation, azimuth)
    return [(float(energy), (-x, -y, -z))]


def _turtle_directions(sectors):
    """Elevations and azimuths of the sectors of a turtle, degrees.

    The 16 are the upper vertices of an icosahedron and of its dual dodecahedron; the 46 have on
    each edge of the icosahedron two more, 20.84 degrees from its ends (den Dulk 1989).
    """
    ring = math.degrees(math.atan(0.5))  # elevation of the lower vertices of the icosahedron
    high = 52.6226318593503
    low = 10.812316963571
    fifths = [72.0 * i for i in range(5)]
    sixteen = [(90.0, 0.0)]
    sixteen += [(ring, a) for a in fifths]
    sixteen += [(high, a + 36) for a in fifths] + [(low, a + 36) for a in fifths]
    if str(sectors) == "16":
        return sixteen
    if str(sectors) != "46":
        return [(90.0, 0.0)]
    top = [np.array(vecteur_direction(el, az)) for el, az in sixteen[:6]]
    vertices = top + [-v for v in top]
    between = []
    for i, a in enumerate(vertices):
        for b in vertices[:i] + vertices[i + 1 :]:
            if a @ b > 0.4:  # an edge
                side = (b - (a @ b) * a) / np.linalg.norm(b - (a @ b) * a)
                angle = math.radians(20.84)
                p = math.cos(angle) * a + math.sin(angle) * side
                if p[2] > 1e-9:
                    azimuth = math.degrees(math.atan2(p[1], p[0])) % 360
                    between.append((math.degrees(math.asin(p[2])), azimuth))
    return sixteen + sorted(between)


def turtle(sectors="46", format="soc", energy=1.0):
    """A sky in sectors of equal size.

    Parameters
    ----------
    sectors : str
        "46", "16" or "1".
    format : str
        "soc" (standard overcast) or "uoc" (uniform).
    energy : float
        On the horizontal, of all of them together.

    Returns
    -------
    energy, emission, direction, elevation, azimuth : tuples
        Energy on the horizontal, and across the direction of travel; the directions; degrees,
        azimuth from X+ to Y+.
    """
    directions = _turtle_directions(sectors)
    elevation = tuple(el for el, _ in directions)
    azimuth = tuple(az for _, az in directions)
    sines = np.sin(np.radians(elevation))
    radiance = (1 + 2 * sines) / 3 if format == "soc" else np.ones_like(sines)
    weights = radiance * sines
    horizontal = energy * weights / weights.sum()
    direction = tuple(
        tuple(-x for x in vecteur_direction(el, az)) for el, az in directions
    )
    return (
        tuple(horizontal.tolist()),
        tuple((horizontal / sines).tolist()),
        direction,
        elevation,
        azimuth,
    )


def diffuse_source(directions=46, format="soc", energy=1.0):
    """The lights of a sky in 1, 16 or 46 sectors: list of (energy, direction)."""
    horizontal, _, direction, _, _ = turtle(str(directions), format, energy)
    return list(zip(horizontal, direction))


def emission_inv(elevation, energy):
    """Energy across the direction of travel of light whose energy is on the horizontal."""
    return energy / abs(math.sin(math.radians(elevation)))
