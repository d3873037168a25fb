"""Pictures of results, by matplotlib."""

from __future__ import annotations

import numpy as np

#: More triangles than these are drawn as a sample of the organs.
MOST_TRIANGLES = 200_000


def _drawn_organs(result, include_ground):
    count = len(result.organs) - (1 if result.organs.has_ground and not include_ground else 0)
    return range(max(count, 1))


def _triangles(result, organs):
    """All triangles with the place of the organ of each; (n, 3, 3) and (n,)."""
    step = max(1, -(-result.organs.triangle_count // MOST_TRIANGLES))
    parts = [(i, result.organs.triangles(i)) for i in list(organs)[::step]]
    numbers = np.repeat([i for i, _ in parts], [len(t) for _, t in parts])
    return np.concatenate([t for _, t in parts]), numbers


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
        Of projection "3d"; default: a new one.
    cmap : str
        Of colours.
    vmin, vmax : float
        Values at the ends of the colours; default: those of the organs drawn.
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

    estimates = result[quantity]
    if estimates.bands:
        estimates = estimates[band or estimates.bands[0]]
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
        label = f"{estimates.name} [{estimates.unit}]" if estimates.unit else estimates.name
        ax.figure.colorbar(colours, ax=ax, label=label, shrink=0.7)
    return ax


def _set_limits(ax, points):
    """The same scale along all axes."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, max((high - low).max() / 2, 1e-12)
    for set_limits, centre in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), middle):
        set_limits(centre - half, centre + half)
