"""The light of the sun as text."""

from __future__ import annotations

from .GetLight import GetLight


def GetLightsSun(sun):
    """The line "energy dx dy dz" of the sun of `Gensun`."""
    return GetLight([sun])
