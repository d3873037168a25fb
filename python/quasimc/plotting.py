"""Plots of results with matplotlib."""

from __future__ import annotations

import datetime

import numpy as np

from ._drawing import (
    POINTS, band_of, draw_fit, drawn_organs, errors_of, estimates_of, fit_exponential, label_of,
    new_axes, organs_from_the_top, set_limits, triangles_of,
)  # fmt: skip
from ._optional import needed
from ._units import shown
from .errors import InputError

__all__ = ["Plots", "SeriesPlots", "fit_exponential"]


class Plots:
    """The plots of a result: ``result.plot.profile()``.

    Each takes ``ax=``, axes of matplotlib to draw on (default: new ones), and returns its axes.
    """

    def __init__(self, result):
        self._result = result

    def __call__(self, *_, **__):
        raise TypeError("`result.plot()` is now `result.plot.scene()`")

    def scene(
        self, quantity="absorbed_flux_density", band=None, *, ax=None, cmap="viridis", vmin=None,
        vmax=None, include_ground=False, colorbar=True,
    ):  # fmt: skip
        """Draws the organs of a result, coloured by a quantity.

        Parameters
        ----------
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
        pyplot = needed("matplotlib.pyplot")
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        result = self._result
        estimates = estimates_of(result, quantity, band)
        organs = drawn_organs(result, include_ground)
        triangles, numbers = triangles_of(result, organs)
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
        set_limits(ax, triangles.reshape(-1, 3))
        if colorbar:
            label = label_of(estimates, band_of(result, quantity, band))
            ax.figure.colorbar(colours, ax=ax, label=label, shrink=0.7)
        return ax

    def profile(self, quantity="absorbed_flux_density", band=None, *, ax=None, layers=20, fit=True):
        """Draws the light of each organ against its height, with 95 % intervals.

        A line shows means of layers weighted by area.

        Parameters
        ----------
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
        result = self._result
        ax = ax or new_axes()
        estimates = estimates_of(result, quantity, band)
        organs, heights = organs_from_the_top(result)
        light = estimates.values[organs]
        points = ax.errorbar(light, heights, xerr=errors_of(estimates, organs), **POINTS)
        areas, edges = np.histogram(heights, layers, weights=result.organs.areas[organs])
        sums, _ = np.histogram(heights, edges, weights=result.organs.areas[organs] * light)
        filled = areas > 0
        middles = (edges[1:] + edges[:-1]) / 2
        ax.plot(sums[filled] / areas[filled], middles[filled], "o-", label="means of layers")
        if fit:
            draw_fit(ax, heights[0] - heights, light, "d", points[0], lambda d, y: (y, heights[0] - d))
        ax.set_xlabel(label_of(estimates, band_of(result, quantity, band)))
        ax.set_ylabel(f"height [{result.organs.length_unit}]")
        ax.legend(frameon=False)
        return ax

    def histogram(self, quantity="absorbed_flux_density", band=None, *, ax=None, bins=20, where=None):
        """Draws the area of organs against their light, as shares of the whole area.

        Parameters
        ----------
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
        result = self._result
        ax = ax or new_axes()
        estimates = estimates_of(result, quantity, band)
        light, areas = estimates.values, result.organs.areas
        used = np.isfinite(light) & (areas > 0)
        used &= True if where is None else np.asarray(where, bool)
        if not used.any():
            raise ValueError("the result has no organ with an area")
        shares = areas[used] / areas[used].sum()
        ax.hist(light[used], bins, weights=100 * shares, alpha=0.8)
        mean = float(light[used] @ shares)
        ax.axvline(mean, color="black", linewidth=1, label=f"mean {mean:.4g}")
        ax.set_xlabel(label_of(estimates, band_of(result, quantity, band)))
        ax.set_ylabel("area of organs [%]")
        ax.legend(frameon=False)
        return ax

    def light_by_index(
        self, quantity="absorbed_flux_density", band=None, *, variance=False, ax=None, label="organs",
        fit=True,
    ):  # fmt: skip
        """Draws the light of each organ against its number n, counted from the top, with 95 % intervals.

        Parameters
        ----------
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
        result = self._result
        ax = ax or new_axes()
        estimates = estimates_of(result, quantity, band)
        organs, _ = organs_from_the_top(result)
        numbers = np.arange(1, len(organs) + 1)
        if variance:
            values, errors = result.run.replicates * estimates.standard_error[organs] ** 2, None
            name = estimates.name.replace("_", " ")
            ax.set_ylabel(f"variance of {name} [({shown(estimates.unit)})\u00b2]")
        else:
            values, errors = estimates.values[organs], errors_of(estimates, organs)
            ax.set_ylabel(label_of(estimates, band_of(result, quantity, band)))
        label = f"{label}: mean {values.mean():.4g}"
        points = ax.errorbar(numbers, values, yerr=errors, label=label, **POINTS)
        if fit:
            draw_fit(ax, numbers, values, "n", points[0], lambda n, y: (n, y))
        ax.set_xlabel("organ n, counted from the top")
        ax.legend(frameon=False)
        return ax

    def convergence(self, *, ax=None):
        """Draws the median and the worst relative error of organs after each round against its paths.

        Parameters
        ----------
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
        result = self._result
        rounds = result.run.rounds
        if not rounds:
            raise ValueError("the run had one round of paths: run with target_error or max_paths")
        ax = ax or new_axes()
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


class SeriesPlots:
    """The plots of a series: ``series.plot.course()``."""

    def __init__(self, series):
        self._series = series

    def course(self, quantity="absorbed_flux", band=None, *, by=None, ax=None):
        """Draws the light of groups over time, each as a line with its 95 % interval as a band.

        Parameters
        ----------
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
        dates = needed("matplotlib.dates")
        series = self._series
        ax = ax or new_axes()
        first = series[0].groups
        rows = [i for i, group in enumerate(first.groups) if group["by"] == (by or "all")]
        if not rows:
            known = ", ".join(dict.fromkeys(group["by"] for group in first.groups))
            text = f"by: the run has no groups {by!r}; run with groups=[...] (there are: {known})"
            raise InputError(text, [])
        times = [datetime.datetime.fromisoformat(step["time"]) for step in series.times]
        light = [estimates_of(result.groups, quantity, band)._values[rows] for result in series]
        for i, numbers in enumerate(np.moveaxis(np.array(light), 1, 0)):
            value, _, low, high = numbers.T
            (line,) = ax.plot(times, value, label=first.groups[rows[i]]["value"] or "all organs")
            ax.fill_between(times, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
        zone, locator = times[0].tzinfo, dates.AutoDateLocator(tz=times[0].tzinfo)
        ax.xaxis.set_major_locator(locator)
        ax.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator, tz=zone))
        ax.set_ylabel(label_of(estimates_of(first, quantity, band), band_of(first, quantity, band)))
        ax.legend(frameon=False, title=by)
        return ax
