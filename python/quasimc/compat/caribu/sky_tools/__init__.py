"""Skies and suns as texts of lights."""

from . import GenSky, Gensun, GetLight, GetLightsSun, spitters_horaire, turtle

__all__ = ["GenSky", "Gensun", "GetLight", "GetLightsSun", "spitters_horaire", "turtle"]
