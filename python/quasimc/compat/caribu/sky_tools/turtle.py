"""The turtle, with directions towards the light along the horizontal."""

from __future__ import annotations

from ..light import turtle as _turtle


def turtle(sectors="46", format="soc", energy=1.0):
    """As `light.turtle`, but for the sign of dx and dy."""
    horizontal, emission, direction, elevation, azimuth = _turtle(sectors, format, energy)
    opposite = tuple((-x, -y, z) for x, y, z in direction)
    return horizontal, emission, opposite, elevation, azimuth
