"""Plots of results with matplotlib."""

from __future__ import annotations

import numpy as np

#: More triangles than these are drawn as a sample of the organs.
MOST_TRIANGLES = 200_000


def _drawn_organs(result, include_ground):
    count = len(result.organs) - (1 if result.organs.has_ground and not include_ground else 0)
    return range(max(count, 1))


def _triangles(result, organs):
    """All triangles with the index of the organ of each; (n, 3, 3) and (n,)."""
    step = max(1, -(-result.organs.triangle_count // MOST_TRIANGLES))
    parts = [(i, result.organs.triangles(i)) for i in list(organs)[::step]]
    numbers = np.repeat([i for i, _ in parts], [len(t) for _, t in parts])
    return np.concatenate([t for _, t in parts]), numbers


def _estimates(result, quantity, band):
    """The estimates of the organs; default: the first band."""
    estimates = result[quantity]
    return estimates[band or estimates.bands[0]] if estimates.bands else estimates


def _label(estimates):
    return f"{estimates.name} [{estimates.unit}]" if estimates.unit else estimates.name


def plot(
    result,
    quantity="absorbed_flux_density",
    band=None,
    *,
    ax=None,
    cmap="viridis",
    vmin=None,
    vmax=None,
    include_ground=False,
    colorbar=True,
):
    """Draws the organs of a result, coloured by a quantity.

    Parameters
    ----------
    result : Result
    quantity : str
        One of `quasimc.quantities()`, or "sunlit_fraction".
    band : str
        Default: the first.
    ax : matplotlib.axes.Axes
        With projection "3d"; default: new axes.
    cmap : str
        Colormap.
    vmin, vmax : float
        Values at the ends of the colormap; default: range of the organs drawn.
    include_ground : bool
    colorbar : bool

    Returns
    -------
    matplotlib.axes.Axes
    """
    import matplotlib.pyplot as pyplot
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    estimates = _estimates(result, quantity, band)
    organs = _drawn_organs(result, include_ground)
    triangles, numbers = _triangles(result, organs)
    if result.organs._scene.up == "y":
        triangles = triangles[..., [2, 0, 1]]
    values = estimates.mean[list(organs)]
    colours = ScalarMappable(
        Normalize(
            np.nanmin(values) if vmin is None else vmin, np.nanmax(values) if vmax is None else vmax
        ),
        cmap,
    )
    if ax is None:
        ax = pyplot.figure().add_subplot(projection="3d")
    faces = colours.to_rgba(estimates.mean[numbers])
    ax.add_collection3d(Poly3DCollection(triangles, facecolors=faces))
    _set_limits(ax, triangles.reshape(-1, 3))
    ax.set_title(f"{estimates.name} {band or ''}".strip())
    if colorbar:
        ax.figure.colorbar(colours, ax=ax, label=_label(estimates), shrink=0.7)
    return ax


def _set_limits(ax, points):
    """The same scale along all axes."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, max((high - low).max() / 2, 1e-12)
    for set_limits, centre in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), middle):
        set_limits(centre - half, centre + half)


def plot_profile(result, quantity="absorbed_flux_density", band=None, *, ax=None, layers=20):
    """Draws the light of each organ against its height, with 95 % intervals.

    Lines show area-weighted means of layers and the least-squares fit A exp(-rate depth), where depth is below
    the highest organ. The ground is left out.

    Parameters
    ----------
    result : Result
    quantity, band : str
        As of `plot`.
    ax : matplotlib.axes.Axes
        Default: new ones.
    layers : int
        Number of layers of equal height.

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = ax or _new_axes()
    estimates = _estimates(result, quantity, band)
    organs, heights = _organs_from_the_top(result)
    light = estimates.mean[organs]
    points = ax.errorbar(light, heights, xerr=_errors(estimates, organs), fmt=".", alpha=0.5)
    areas, edges = np.histogram(heights, layers, weights=result.organs.areas[organs])
    sums, _ = np.histogram(heights, edges, weights=result.organs.areas[organs] * light)
    filled = areas > 0
    middles = (edges[1:] + edges[:-1]) / 2
    ax.plot(sums[filled] / areas[filled], middles[filled], "o-", label="means of layers")
    _draw_fit(ax, heights[0] - heights, light, "d", points[0], lambda d, y: (y, heights[0] - d))
    ax.set_xlabel(_label(estimates))
    ax.set_ylabel(f"height [{result.organs.length_unit}]")
    ax.legend()
    return ax


def plot_organs(
    result,
    quantity="absorbed_flux_density",
    band=None,
    *,
    variance=False,
    ax=None,
    label="organs",
):
    """Draws the light of each organ against its number n, counted from the top.

    Shows 95 % intervals and the least-squares fit A exp(-rate n). The ground is left out.

    Parameters
    ----------
    result : Result
    quantity, band : str
        As of `plot`.
    variance : bool
        Plot the variance between replicates instead of the light.
    ax : matplotlib.axes.Axes
        Default: new axes. Pass those of another result of the scene to compare.
    label : str
        Name of the points in the legend.

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = ax or _new_axes()
    estimates = _estimates(result, quantity, band)
    organs, _ = _organs_from_the_top(result)
    numbers = np.arange(1, len(organs) + 1)
    if variance:
        values, errors = result.replicates * estimates.standard_error[organs] ** 2, None
        ax.set_ylabel(f"variance of {estimates.name} [({estimates.unit})\u00b2]")
    else:
        values, errors = estimates.mean[organs], _errors(estimates, organs)
        ax.set_ylabel(_label(estimates))
    label = f"{label}: mean {values.mean():.4g}"
    points = ax.errorbar(numbers, values, yerr=errors, fmt=".", alpha=0.5, label=label)
    _draw_fit(ax, numbers, values, "n", points[0], lambda n, y: (n, y))
    ax.set_xlabel("organ n, counted from the top")
    ax.legend()
    return ax


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


def _new_axes():
    import matplotlib.pyplot as pyplot

    return pyplot.figure().add_subplot()


def _organs_from_the_top(result):
    """Places of the organs with an area, but not of the ground, and heights of their middles."""
    up = 1 if result.organs._scene.up == "y" else 2
    heights = np.full(len(result.organs), np.nan)
    for organ in _drawn_organs(result, include_ground=False):
        a, b, c = np.moveaxis(result.organs.triangles(organ), 1, 0)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        if areas.sum() > 0:
            heights[organ] = np.average((a + b + c)[:, up] / 3, weights=areas)
    organs = np.argsort(-heights, kind="stable")[: np.isfinite(heights).sum()]
    if not len(organs):
        raise ValueError("the result has no organ with an area")
    return organs, heights[organs]


def _errors(estimates, organs):
    """How far the 95 % interval of each organ reaches below and above its mean."""
    mean = estimates.mean
    return np.stack([mean - estimates.ci95_low, estimates.ci95_high - mean])[:, organs].clip(0)


def _draw_fit(ax, x, y, name, points, project):
    """The fitted curve, if there is one, in the colour of its points; project: (x, y) on the picture."""
    fit = fit_exponential(x, y)
    if fit is not None:
        curve_x = np.linspace(np.min(x), np.max(x), 200)
        curve_y = fit[0] * np.exp(-fit[1] * curve_x)
        label = f"{fit[0]:.3g} exp({-fit[1]:.3g} {name})"
        curve = project(curve_x, curve_y)
        ax.plot(*curve, color=points.get_color(), linewidth=2.5, zorder=3, label=label)
