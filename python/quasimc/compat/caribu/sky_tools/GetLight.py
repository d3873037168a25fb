"""The lights of a sky as text."""

from __future__ import annotations

import math


def GetLight(sky):
    """One line "energy dx dy dz" for each cell of `GenSky`."""
    lines = []
    for energy, azimuth, zenith in sky:
        across = math.sin(zenith)
        x, y, z = across * math.cos(azimuth), across * math.sin(azimuth), math.cos(zenith)
        lines.append(f"{energy!r} {-x!r} {-y!r} {-z!r}")
    return "\n".join(lines)
