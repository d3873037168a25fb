"""Exposure to the sky: light under a turtle of unit energy."""

from __future__ import annotations

from .CaribuScene import CaribuScene
from .light import diffuse_source


def caribu_star(scene, directions=1, output_by_triangle=False, domain=None, convUnit=0.01):
    """Exposure of the parts of a scene to 1, 16 or 46 directions of a standard overcast sky.

    Returns
    -------
    star, exposed_area : dict
        pid -> Ei, and Ei times the area [m2]; lists by triangles if asked for.
    """
    traced = CaribuScene(scene, light=diffuse_source(directions), pattern=domain)
    traced.conv_unit = convUnit
    raw, aggregated = traced.run(direct=True, infinite=domain is not None, simplify=True)
    if not output_by_triangle:
        star, areas = aggregated["Ei"], aggregated["area"]
        return star, {pid: star[pid] * areas[pid] for pid in star}
    star, areas = raw["Ei"], raw["area"]
    return star, {pid: [e * a for e, a in zip(star[pid], areas[pid])] for pid in star}
