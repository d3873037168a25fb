"""A sky in cells of azimuth and zenith angle."""

from __future__ import annotations

import math


class GenSky:
    """Calling it gives the cells: list of (energy on the horizontal, azimuth, zenith), radians."""

    def __call__(self, energy=1.0, kind="soc", nazimuth=4, nzenith=5):
        """Cells of equal angles, with the light of each by its integral.

        Parameters
        ----------
        energy : float
            On the horizontal, of all cells together.
        kind : str
            "soc" (standard overcast) or "uoc" (uniform).
        nazimuth, nzenith : int
            How many.
        """
        share = self._share(str(kind).lower())
        edges = [math.pi / 2 * i / nzenith for i in range(nzenith + 1)]
        cells = []
        for low, high in zip(edges, edges[1:]):
            of_ring = energy * (share(high) - share(low))
            for i in range(nazimuth):
                azimuth = 2 * math.pi * (i + 0.5) / nazimuth
                cells.append((of_ring / nazimuth, azimuth, (low + high) / 2))
        return cells

    @staticmethod
    def _share(kind):
        """The part of the light on the horizontal that comes from within a zenith angle.

        Radiance 1, or (1 + 2 cos z) / 3, times cos z sin z, integrated from 0.
        """
        if kind == "uoc":
            return lambda z: math.sin(z) ** 2
        if kind == "soc":
            return lambda z: (3 * math.sin(z) ** 2 + 4 * (1 - math.cos(z) ** 3)) / 7
        raise ValueError(f"the sky {kind!r} is unknown: use soc or uoc")
