"""Skies as texts of lights."""

from . import GenSky, GetLight, turtle

__all__ = ["GenSky", "GetLight", "turtle"]
