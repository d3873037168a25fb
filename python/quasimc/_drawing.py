"""What plots by matplotlib share: which organs they show, labels, axes and fits."""

from __future__ import annotations

import numpy as np

from ._optional import needed
from ._units import shown

#: Points with error bars that do not hide one another.
POINTS = {"fmt": ".", "markersize": 5, "elinewidth": 0.8, "alpha": 0.6}

#: More triangles than these are drawn as a sample of the organs.
MOST_TRIANGLES = 200_000


def drawn_organs(result, include_ground):
    count = len(result.organs) + (1 if result.organs.has_ground and include_ground else 0)
    return range(max(count, 1))


def triangles_of(result, organs):
    """All triangles with the index of the organ of each; (n, 3, 3) and (n,)."""
    step = max(1, -(-result.organs.triangle_count // MOST_TRIANGLES))
    parts = [(i, result.organs.triangles(i)) for i in list(organs)[::step]]
    numbers = np.repeat([i for i, _ in parts], [len(t) for _, t in parts])
    return np.concatenate([t for _, t in parts]), numbers


def estimates_of(result, quantity, band):
    """The estimates of the organs; default: the first band."""
    estimates = result[quantity]
    return estimates[band or estimates.bands[0]] if estimates.bands else estimates


def label_of(estimates, band=None):
    """The label of an axis: "incident upper, NIR [W m⁻²]"."""
    name = estimates.name.replace("_", " ") + (f", {band}" if band else "")
    return f"{name} [{shown(estimates.unit)}]" if estimates.unit else name


def band_of(result, quantity, band):
    return (band or result.bands[0]) if result[quantity].bands else None


def set_limits(ax, points):
    """The same scale along all axes."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, max((high - low).max() / 2, 1e-12)
    for set_limits, centre in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), middle):
        set_limits(centre - half, centre + half)


def new_axes():
    pyplot = needed("matplotlib.pyplot")

    ax = pyplot.figure(layout="constrained").add_subplot()
    ax.grid(alpha=0.3, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def organs_from_the_top(result):
    """Places of the organs with an area, but not of the ground, and heights of their middles."""
    up = 1 if result.organs._scene.up == "y" else 2
    heights = np.full(len(result.organs), np.nan)
    for organ in drawn_organs(result, include_ground=False):
        a, b, c = np.moveaxis(result.organs.triangles(organ), 1, 0)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        if areas.sum() > 0:
            heights[organ] = np.average((a + b + c)[:, up] / 3, weights=areas)
    organs = np.argsort(-heights, kind="stable")[: np.isfinite(heights).sum()]
    if not len(organs):
        raise ValueError("the result has no organ with an area")
    return organs, heights[organs]


def errors_of(estimates, organs):
    """How far the 95 % interval of each organ reaches below and above its mean."""
    mean = estimates.values
    return np.stack([mean - estimates.ci95_low, estimates.ci95_high - mean])[:, organs].clip(0)


def fit_exponential(x, y):
    """Returns A and rate of the least-squares fit A exp(-rate x).

    Gauss-Newton with step halving. None if there is no fit: fewer than three different x, or values that are
    not finite.
    """
    x, y = np.asarray(x, float), np.asarray(y, float)
    if not (np.isfinite(x).all() and np.isfinite(y).all()) or len(np.unique(x)) < 3:
        return None
    curve = np.array([y.mean(), 0.0])
    least = np.sum((y - curve[0]) ** 2)
    for _ in range(200):
        falls = np.exp(-curve[1] * x)
        slopes = np.stack([falls, -curve[0] * x * falls], axis=1)
        step = np.linalg.lstsq(slopes, y - curve[0] * falls, rcond=None)[0]
        for part in 0.5 ** np.arange(30):
            tried = curve + part * step
            with np.errstate(over="ignore"):
                deviations = np.sum((y - tried[0] * np.exp(-tried[1] * x)) ** 2)
            if deviations < least:
                break
        else:
            break
        curve, least = tried, deviations
    return tuple(curve)


def draw_fit(ax, x, y, name, points, project):
    """The fitted curve, if there is one, in the colour of its points; project: (x, y) on the picture."""
    fit = fit_exponential(x, y)
    if fit is not None:
        curve_x = np.linspace(np.min(x), np.max(x), 200)
        curve_y = fit[0] * np.exp(-fit[1] * curve_x)
        label = f"{fit[0]:.3g} exp({-fit[1]:.3g} {name})"
        curve = project(curve_x, curve_y)
        ax.plot(*curve, color=points.get_color(), linewidth=2.5, zorder=3, label=label)
