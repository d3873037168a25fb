"""Gap fractions of a canopy, as seen from positions in it."""

from __future__ import annotations

import numpy as np

from . import _core
from .estimates import Estimates

#: Rings of the LAI-2000 (LI-COR), degrees from the zenith.
LAI_2000_RINGS = (0, 13, 28, 43, 58, 74)


class GapIndices:
    """What follows from gaps: `Estimates` with a first axis of positions, or of none for all together.

    Attributes
    ----------
    gap, clumping : Estimates
        (..., rings): gap fraction of a ring, and its clumping index (Lang and Xiang 1986).
    sky_transmittance, effective_plant_area_index, plant_area_index, clumping_index : Estimates
        (...): see docs/reference/gap-fraction.md.
    """

    def __init__(self, arrays, is_one):
        for name, values in arrays.items():
            estimates = Estimates(values[0] if is_one else values, name, "", extensive=False)
            setattr(self, name, estimates)

    def __repr__(self):
        return f"<GapIndices: plant area index {self.plant_area_index}, clumping {self.clumping_index}>"


class GapFraction:
    """Gap fractions, see `Scene.gap_fraction`.

    Attributes
    ----------
    gap : Estimates
        (positions, rings, sectors): fraction of the directions in which nothing blocks the view.
    rings_deg : numpy.ndarray
        Bounds of the rings, degrees from the zenith. Sectors begin at north, clockwise.
    by_position, all : GapIndices
        Indices of each position, and of all together.
    closed_bins : int
        Sectors without a gap, each of which counts as half a ray.
    """

    def __init__(self, core, rings_deg):
        self.gap = Estimates(core["gaps"], "gap_fraction", "", extensive=False)
        self.rings_deg = np.asarray(rings_deg, float)
        self.by_position = GapIndices(core["by_position"], is_one=False)
        self.all = GapIndices(core["all"], is_one=True)
        self.closed_bins = core["closed_bins"]

    def __repr__(self):
        return f"<GapFraction: {self.gap.shape[0]} positions; plant area index {self.all.plant_area_index}>"


def measure(built, positions, rings_deg, keys):
    """The gap fractions of a built scene."""
    points = np.asarray(positions, float)
    if points.shape[-1:] != (3,):
        raise ValueError(f"positions have the shape {points.shape}: give (3,) or (..., 3)")
    keys = {**keys, "rings_deg": list(map(float, rings_deg))}
    return GapFraction(_core.gap_fractions(built, points.reshape(-1, 3).tolist(), keys), rings_deg)
