"""Runs of a scene over values of its keys."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence

import numpy as np

from ._index import RunIndex
from ._keys import near
from ._meshes import input_error
from ._optional import needed
from ._stacked_light import StackedLight
from ._written import combined
from .result import Result
from .values import Value

#: Keys whose values are assigned to a scene: the first part of a name.
_PARTS = ("materials", "ground", "cell", "site")
_NAMES = (
    'names are "materials.NAME.KEY", "sources.NAME.KEY", "ground.KEY", "cell.KEY", "site.KEY", '
    "and those of options"
)


class Sweep(Sequence):
    """The results of a sweep: ``len(sweep)`` points, ``sweep[i]`` is the `Result` of one.

    Files of the program may hold a sweep over days: ``sweep[i]`` is then a `Series`.

    ``sweep["absorbed_flux"]`` are the `Estimates` of all points, of shape (points, organs, bands).
    All points have the same random numbers (unless `seed` is swept), so differences and sums of their
    light have the errors of pairs of replicates: ``light[1] - light[0]``.

    Attributes
    ----------
    points : list of dict
        For each point: the swept names and their values.
    """

    def __init__(self, points, results, written=None):
        self.points = points
        self._results = results
        self._written = written  # what it was computed from; None: unknown

    @property
    def _runs(self):
        rows = [tuple(point.values()) for point in self.points]
        names = list(self.points[0])
        return RunIndex("point", names, rows if len(names) > 1 else [row[0] for row in rows])

    def __len__(self):
        return len(self._results)

    def __getitem__(self, index):
        if isinstance(index, str):
            return StackedLight(self._instants(), self._runs)[index]
        return self._results[index]

    def _instants(self):
        """The results. Raises ValueError if they are those of a sweep over series."""
        if any(not isinstance(point, Result) for point in self._results):
            raise ValueError("the points are series: take one alone, sweep[0], or its sums")
        return self._results

    @property
    def organs(self):
        """The organs of the first point: Organs."""
        return self._results[0].organs

    @property
    def budget(self):
        """Energy budget: mapping, part -> Estimates of shape (points, bands); see `Result.budget`."""
        return StackedLight([result.budget for result in self._instants()], self._runs)

    @property
    def canopy(self):
        """Fractions of the light on the canopy, of shape (points, bands); see `Result.canopy`."""
        return StackedLight([result.canopy for result in self._instants()], self._runs)

    @property
    def ground(self):
        """The light on the ground, of shape (points, bands); None if a point has no ground."""
        lights = [result.ground for result in self._instants()]
        return None if None in lights else StackedLight(lights, self._runs)

    def sum(self, quantity, weights=None):
        """The sum of the light of all points, with the error of the sum.

        Parameters
        ----------
        quantity : str
        weights : sequence of float
            One for each point ("30 days like this one"); default: all 1.

        Returns
        -------
        Estimates
            In the unit of the quantity; for other units of the weights use `Estimates.with_unit`.

        Raises
        ------
        ValueError
            If the number of weights is not that of the points, or points have different organs.
        """
        weights = np.ones(len(self)) if weights is None else np.asarray(weights, float)
        if weights.shape != (len(self),):
            raise ValueError(f"{weights.size} weights for {len(self)} points; give one for each")
        return self[quantity].sum(axis="point", weights=weights)

    def save(self, path, **table):
        """Writes the sweep to a file, in the format of its ending.

        ".json": all but replicates, for `quasimc.open` and the program; ".csv": the table of points and
        organs; ".nc": NetCDF.

        Parameters
        ----------
        path : str or path
        **table
            For ".csv", another table, with the keys of ``[[table]]`` (docs/reference/csv.md): rows
            ("groups", "sensors", ...), per ("day", "period"), form, where, quantities, bands, origins,
            statistics, digits.

        Returns
        -------
        pathlib.Path

        Raises
        ------
        InputError
            If the ending is unknown, or a point is not in the form of ``[sweep]`` of a run file, which
            sets single keys: a whole `Ground` or list of sources is not.
        FileNotFoundError
            If the folder does not exist.
        """
        from ._store import save

        return save(self, path, table)

    def __reduce__(self):
        from ._store import state_of

        return state_of(self)

    def to_pandas(self):
        """Returns a pandas.DataFrame: a row for each point and organ, indexed by swept values and id."""
        pandas = needed("pandas")

        runs = self._runs
        tables = [result.to_pandas() for result in self]
        frame = pandas.concat(tables, keys=list(runs.to_pandas()), names=[*runs.names, "id"])
        frame.attrs = tables[0].attrs
        return frame

    def to_xarray(self):
        """Returns an xarray.Dataset with the variables of `Result.to_xarray` along the swept keys.

        Each key is a dimension with its values, called as in NetCDF files: ``material_leaf_reflectance``.
        Of points that are not all combinations of values (combine="zip") the dimension is ``point``, and
        keys are coordinates along it. Values that are lists are text.

        Raises ValueError if the points have different organs.
        """
        from ._datasets import sweep_dataset

        return sweep_dataset(self)

    def __repr__(self):
        names = ", ".join(self.points[0]) if self.points else ""
        return f"<Sweep: {len(self)} points of {names}>"


def points_of(values, combine):
    """The points of a sweep: list of dict. The first name varies slowest."""
    if not isinstance(values, Mapping) or not values:
        raise input_error("sweep", "there is nothing to sweep", "", 'give {"materials.leaf.reflectance": [...]}')
    lists = {name: list(each) for name, each in values.items()}
    if combine not in ("product", "zip"):
        raise ValueError(f'combine is {combine!r}; give "product" or "zip"')
    lengths = {name: len(each) for name, each in lists.items()}
    if combine == "zip" and len(set(lengths.values())) > 1:
        raise input_error("sweep", f"the lists have different lengths: {lengths}", "", 'or combine="product"')
    points = combined(lists, combine)
    if not points:
        raise input_error("sweep", "a list is empty", "there is no point", "give at least one value")
    return points


def scene_at(scene, point, options):
    """A scene with the values of a point, the sources of its run, and its options.

    It is a copy only if the point has values of the scene: the others share what was built.
    """
    if any(name.partition(".")[0] in _PARTS for name in point):
        scene = copy.copy(scene)
    sources, options = None, dict(options)
    for name, value in point.items():
        part, _, rest = name.partition(".")
        if part == "sources":
            sources = _with_source(scene, sources, rest, value) if rest else value
        elif part not in _PARTS:
            if rest:
                hint = near(part, (*_PARTS, "sources"))
                raise input_error("sweep", f"there is no {name!r}", _NAMES, hint)
            options[name] = value  # refused by run(), if it is none
        elif part == "materials":
            material, _, key = rest.rpartition(".")
            scene.materials[material].set(**{key: value})
        else:
            _assign(scene, part, rest, value)
    return scene, sources, options


def _with_source(scene, sources, rest, value):
    """The sources of a scene, where a key of one has another value. @param rest: its name and the key"""
    name, _, key = rest.rpartition(".")
    position = scene.sources.names.index(scene.sources[name].name)
    sources = list(scene.sources) if sources is None else sources
    sources[position] = sources[position].replace(**{key: value})
    return sources


def _assign(scene, part, key, value):
    """Assigns a whole value ("ground"), or one of its keys ("ground.material")."""
    old = getattr(scene, part)
    if not key:
        setattr(scene, part, value)
    elif isinstance(old, Value):
        setattr(scene, part, old.replace(**{key: value}))
    else:
        raise input_error("sweep", f"the scene has no {part}", "", f"assign scene.{part} first")
