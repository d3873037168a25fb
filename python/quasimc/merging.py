"""Parts of a run, for many processes or machines."""

from __future__ import annotations

from . import _core
from .organs import Organs
from .result import Result
from .run_info import RunInfo


class Part:
    """An exact share of a run, which can be pickled; `merge` makes the result of all.

    Attributes
    ----------
    index, count : int
        Which of how many, from 0.
    """

    def __init__(self, index, count, sums, method, document, warnings, written):
        self.index = index
        self.count = count
        self._sums = sums
        self._method = method  # and the reason
        self._document = document  # arguments of a Document
        self._warnings = warnings
        self._written = written

    def __repr__(self):
        return f"<Part {self.index} of {self.count}>"


def merge(parts):
    """The result of all parts of a run, bit for bit that of `Scene.run`.

    Parameters
    ----------
    parts : iterable of Part
        Each of them once, in any order.

    Returns
    -------
    Result

    Raises
    ------
    ValueError
        If a part is missing or given twice, or they belong to different runs.
    """
    parts = sorted(parts, key=lambda part: part.index)
    if not parts:
        raise ValueError("there are no parts to merge")
    first = parts[0]
    given = [part.index for part in parts]
    if {part.count for part in parts} != {first.count} or given != list(range(first.count)):
        raise ValueError(f"parts {given} of {first.count} are given; each is needed once")
    scene, core, sources, ratios, replicates = _core.restored(
        _core.Document(*first._document), [part._sums for part in parts]
    )
    result = Result(
        core, Organs(scene), first._warnings, sources, ratios, replicates, first._written
    )
    result.run = RunInfo(core, sources)
    result.run.method, result.run.reason = first._method
    return result
