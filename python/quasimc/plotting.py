"""Plots of results with matplotlib."""

from __future__ import annotations

import datetime

import numpy as np

from ._units import shown
from .errors import InputError

#: Points with error bars that do not hide one another.
_POINTS = {"fmt": ".", "markersize": 5, "elinewidth": 0.8, "alpha": 0.6}

#: More triangles than these are drawn as a sample of the organs.
MOST_TRIANGLES = 200_000


def _drawn_organs(result, include_ground):
    count = len(result.organs) + (1 if result.organs.has_ground and include_ground else 0)
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


def _label(estimates, band=None):
    """The label of an axis: "incident upper, NIR [W m⁻²]"."""
    name = estimates.name.replace("_", " ") + (f", {band}" if band else "")
    return f"{name} [{shown(estimates.unit)}]" if estimates.unit else name


def _band_of(result, quantity, band):
    return (band or result.bands[0]) if result[quantity].bands else None


class Plots:
    """The plots of a result: ``result.plot.profile()``.

    Each takes ``ax=``, axes of matplotlib to draw on (default: new ones), and returns its axes.
    """

    def __init__(self, result):
        self._result = result

    def __call__(self, *_, **__):
        raise TypeError("`result.plot()` is now `result.plot.scene()`")

    def scene(self, quantity="absorbed_flux_density", band=None, **options):
        """Draws the organs coloured by a quantity; see `quasimc.plotting.scene`."""
        return scene(self._result, quantity, band, **options)

    def profile(self, quantity="absorbed_flux_density", band=None, **options):
        """Draws light against height; see `quasimc.plotting.profile`."""
        return profile(self._result, quantity, band, **options)

    def histogram(self, quantity="absorbed_flux_density", band=None, **options):
        """Draws how the area is distributed over the light; see `quasimc.plotting.histogram`."""
        return histogram(self._result, quantity, band, **options)

    def light_by_index(self, quantity="absorbed_flux_density", band=None, **options):
        """Draws light by organ, counted from the top; see `quasimc.plotting.light_by_index`."""
        return light_by_index(self._result, quantity, band, **options)

    def convergence(self, **options):
        """Draws errors against paths; see `quasimc.plotting.convergence`."""
        return convergence(self._result, **options)


class SeriesPlots:
    """The plots of a series: ``series.plot.course()``."""

    def __init__(self, series):
        self._series = series

    def course(self, quantity="absorbed_flux", band=None, **options):
        """Draws the light of groups over time; see `quasimc.plotting.course`."""
        return course(self._series, quantity, band, **options)


def scene(
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
    values = estimates.values
    if len(organs) > len(values):
        ground = result.ground[quantity]
        values = np.append(values, (ground[band or ground.bands[0]] if ground.bands else ground).values)
    colours = ScalarMappable(
        Normalize(
            np.nanmin(values) if vmin is None else vmin, np.nanmax(values) if vmax is None else vmax
        ),
        cmap,
    )
    if ax is None:
        ax = pyplot.figure().add_subplot(projection="3d")
    faces = colours.to_rgba(values[numbers])
    ax.add_collection3d(Poly3DCollection(triangles, facecolors=faces))
    _set_limits(ax, triangles.reshape(-1, 3))
    if colorbar:
        label = _label(estimates, _band_of(result, quantity, band))
        ax.figure.colorbar(colours, ax=ax, label=label, shrink=0.7)
    return ax


def _set_limits(ax, points):
    """The same scale along all axes."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, max((high - low).max() / 2, 1e-12)
    for set_limits, centre in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), middle):
        set_limits(centre - half, centre + half)


def profile(result, quantity="absorbed_flux_density", band=None, *, ax=None, layers=20, fit=True):
    """Draws the light of each organ against its height, with 95 % intervals.

    A line shows means of layers weighted by area.

    Parameters
    ----------
    result : Result
    quantity, band : str
        As of `scene`.
    ax : matplotlib.axes.Axes
        Default: new ones.
    layers : int
        Number of layers of equal height.
    fit : bool
        Draw the least-squares fit A exp(-rate depth), where depth is below the highest organ.

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = ax or _new_axes()
    estimates = _estimates(result, quantity, band)
    organs, heights = _organs_from_the_top(result)
    light = estimates.values[organs]
    points = ax.errorbar(light, heights, xerr=_errors(estimates, organs), **_POINTS)
    areas, edges = np.histogram(heights, layers, weights=result.organs.areas[organs])
    sums, _ = np.histogram(heights, edges, weights=result.organs.areas[organs] * light)
    filled = areas > 0
    middles = (edges[1:] + edges[:-1]) / 2
    ax.plot(sums[filled] / areas[filled], middles[filled], "o-", label="means of layers")
    if fit:
        _draw_fit(ax, heights[0] - heights, light, "d", points[0], lambda d, y: (y, heights[0] - d))
    ax.set_xlabel(_label(estimates, _band_of(result, quantity, band)))
    ax.set_ylabel(f"height [{result.organs.length_unit}]")
    ax.legend(frameon=False)
    return ax


def histogram(result, quantity="absorbed_flux_density", band=None, *, ax=None, bins=20, where=None):
    """Draws the area of organs against their light, as shares of the whole area.

    Parameters
    ----------
    result : Result
    quantity, band : str
        As of `scene`.
    ax : matplotlib.axes.Axes
        Default: new ones.
    bins : int or sequence
        As of numpy.histogram.
    where : array_like of bool
        Mask of organs.

    Returns
    -------
    matplotlib.axes.Axes
        A line marks the mean weighted by area.
    """
    ax = ax or _new_axes()
    estimates = _estimates(result, quantity, band)
    light, areas = estimates.values, result.organs.areas
    used = np.isfinite(light) & (areas > 0)
    used &= True if where is None else np.asarray(where, bool)
    if not used.any():
        raise ValueError("the result has no organ with an area")
    shares = areas[used] / areas[used].sum()
    ax.hist(light[used], bins, weights=100 * shares, alpha=0.8)
    mean = float(light[used] @ shares)
    ax.axvline(mean, color="black", linewidth=1, label=f"mean {mean:.4g}")
    ax.set_xlabel(_label(estimates, _band_of(result, quantity, band)))
    ax.set_ylabel("area of organs [%]")
    ax.legend(frameon=False)
    return ax


def light_by_index(
    result,
    quantity="absorbed_flux_density",
    band=None,
    *,
    variance=False,
    ax=None,
    label="organs",
    fit=True,
):
    """Draws the light of each organ against its number n, counted from the top, with 95 % intervals.

    Parameters
    ----------
    result : Result
    quantity, band : str
        As of `scene`.
    variance : bool
        Plot the variance between replicates instead of the light.
    ax : matplotlib.axes.Axes
        Default: new axes. Pass those of another result of the scene to compare.
    label : str
        Name of the points in the legend.
    fit : bool
        Draw the least-squares fit A exp(-rate n).

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = ax or _new_axes()
    estimates = _estimates(result, quantity, band)
    organs, _ = _organs_from_the_top(result)
    numbers = np.arange(1, len(organs) + 1)
    if variance:
        values, errors = result.run.replicates * estimates.standard_error[organs] ** 2, None
        name = estimates.name.replace("_", " ")
        ax.set_ylabel(f"variance of {name} [({shown(estimates.unit)})\u00b2]")
    else:
        values, errors = estimates.values[organs], _errors(estimates, organs)
        ax.set_ylabel(_label(estimates, _band_of(result, quantity, band)))
    label = f"{label}: mean {values.mean():.4g}"
    points = ax.errorbar(numbers, values, yerr=errors, label=label, **_POINTS)
    if fit:
        _draw_fit(ax, numbers, values, "n", points[0], lambda n, y: (n, y))
    ax.set_xlabel("organ n, counted from the top")
    ax.legend(frameon=False)
    return ax


def convergence(result, *, ax=None):
    """Draws the median and the worst relative error of organs after each round against its paths.

    Parameters
    ----------
    result : Result
        Of a run with target_error or max_paths, which has several rounds.
    ax : matplotlib.axes.Axes
        Default: new ones.

    Returns
    -------
    matplotlib.axes.Axes
        Both axes are logarithmic. A dashed line falls as 1/sqrt(paths).

    Raises
    ------
    ValueError
        If the run had one round.
    """
    rounds = result.run.rounds
    if not rounds:
        raise ValueError("the run had one round of paths: run with target_error or max_paths")
    ax = ax or _new_axes()
    paths = np.array([known["paths"] for known in rounds], float)
    for key, name in (("worst_error", "worst organ"), ("median_error", "median organ")):
        errors = np.array([known[key] for known in rounds], float)
        ax.plot(paths, 100 * errors, "o-", markersize=4, label=name)
    first = 100 * rounds[0]["median_error"]
    ax.plot(paths, first * np.sqrt(paths[0] / paths), "--", color="grey", label="1/sqrt(paths)")
    ax.set_xscale("log", base=2)
    ax.set_yscale("log")
    ax.set_xlabel("paths of a replicate")
    ax.set_ylabel("relative standard error [%]")
    ax.legend(frameon=False)
    return ax


def course(series, quantity="absorbed_flux", band=None, *, by=None, ax=None):
    """Draws the light of groups over time, each as a line with its 95 % interval as a band.

    Parameters
    ----------
    series : Series
        With the results of its times.
    quantity, band : str
        As of `scene`.
    by : str
        Groups of the run (`groups`): a label, or a name; default: all organs together.
    ax : matplotlib.axes.Axes
        Default: new ones.

    Returns
    -------
    matplotlib.axes.Axes
        Hours are those of the times' own zone.

    Raises
    ------
    InputError
        If the run had no such groups.
    """
    ax = ax or _new_axes()
    first = series[0].groups
    rows = [i for i, group in enumerate(first.groups) if group["by"] == (by or "all")]
    if not rows:
        known = ", ".join(dict.fromkeys(group["by"] for group in first.groups))
        text = f"by: the run has no groups {by!r}; run with groups=[...] (there are: {known})"
        raise InputError(text, [])
    times = [datetime.datetime.fromisoformat(step["time"]) for step in series.times]
    light = [_estimates(result.groups, quantity, band)._values[rows] for result in series]
    for i, numbers in enumerate(np.moveaxis(np.array(light), 1, 0)):
        value, _, low, high = numbers.T
        (line,) = ax.plot(times, value, label=first.groups[rows[i]]["value"] or "all organs")
        ax.fill_between(times, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter

    zone, locator = times[0].tzinfo, AutoDateLocator(tz=times[0].tzinfo)
    ax.xaxis.set_major_locator(locator)
    ax.xaxis.set_major_formatter(ConciseDateFormatter(locator, tz=zone))
    ax.set_ylabel(_label(_estimates(first, quantity, band), _band_of(first, quantity, band)))
    ax.legend(frameon=False, title=by)
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

    ax = pyplot.figure(layout="constrained").add_subplot()
    ax.grid(alpha=0.3, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    return ax


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
    mean = estimates.values
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
