"""Runs of a scene over values of its keys."""

from __future__ import annotations

import copy
import itertools
from collections.abc import Mapping, Sequence
from functools import reduce
from operator import add

from ._meshes import input_error
from .values import Value

#: Keys whose values are assigned to a scene: the first part of a name.
_PARTS = ("materials", "ground", "cell", "site")


class Sweep(Sequence):
    """The results of a sweep: ``len(sweep)`` points, ``sweep[i]`` is the `Result` of one.

    All points have the same random numbers (unless `seed` is swept), so differences and sums of their
    light have the errors of pairs of replicates: ``sweep[1]["absorbed_flux"] - sweep[0]["absorbed_flux"]``.

    Attributes
    ----------
    points : list of dict
        For each point: the swept names and their values.
    """

    def __init__(self, points, results):
        self.points = points
        self._results = results

    def __len__(self):
        return len(self._results)

    def __getitem__(self, index):
        if isinstance(index, str):
            raise TypeError(f"a Sweep has a result for each point: use sweep[0][{index!r}]")
        return self._results[index]

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
        weights = [1.0] * len(self) if weights is None else [float(weight) for weight in weights]
        if len(weights) != len(self):
            raise ValueError(f"{len(weights)} weights for {len(self)} points; give one for each")
        return reduce(add, (weight * result[quantity] for weight, result in zip(weights, self)))

    def to_pandas(self):
        """Returns a pandas.DataFrame: a row for each point and organ, with columns of the swept names."""
        import pandas

        tables = []
        for point, result in zip(self.points, self):
            table = result.to_pandas()
            for position, (name, value) in enumerate(point.items()):
                table.insert(position, name, str(value) if isinstance(value, (list, dict)) else value)
            tables.append(table)
        return pandas.concat(tables)

    def __repr__(self):
        names = ", ".join(self.points[0]) if self.points else ""
        return f"<Sweep: {len(self)} points of {names}>"


def points_of(values, combine):
    """The points of a sweep: list of dict. The first name varies slowest."""
    if not isinstance(values, Mapping) or not values:
        raise input_error("sweep", "there is nothing to sweep", "", 'give {"materials.leaf.reflectance": [...]}')
    lists = {name: list(each) for name, each in values.items()}
    if combine == "product":
        rows = itertools.product(*lists.values())
    elif combine == "zip":
        lengths = {name: len(each) for name, each in lists.items()}
        if len(set(lengths.values())) > 1:
            raise input_error("sweep", f"the lists have different lengths: {lengths}", "", 'or combine="product"')
        rows = zip(*lists.values())
    else:
        raise ValueError(f'combine is {combine!r}; give "product" or "zip"')
    points = [dict(zip(lists, row)) for row in rows]
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
            options[name] = value  # refused by run(), if it is none
        elif part == "materials":
            material, _, key = rest.rpartition(".")
            setattr(scene.materials[material], key, value)
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
