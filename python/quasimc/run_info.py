"""Data of a run beside the light of organs."""

from __future__ import annotations

import numpy as np

from .estimates import Estimates


class RunInfo:
    """How a result was computed.

    Attributes
    ----------
    method, reason : str
        Method that was used, and the reason of an automatic choice.
    paths, replicates, rays : int
        Paths of each replicate, number of replicates, rays of all replicates.
    stop : str
        Why the run ended: "finished", "target_reached", "time_limit", "path_limit", "interrupted"
        (Ctrl-C: the result contains the completed paths) or "no_light".
    fraction_at_target : float
        Fraction of the organs (or groups, sensors) that reached the target error; 0 without a
        target.
    preparation_seconds, solve_seconds, solve_cpu_seconds : float
        Wall time of the preparation and of the solution, and CPU time of all threads.
    escaped_by_difference : bool
        Whether escaped light in `Result.budget` is the remainder of the budget.
    rounds : list of dict
        State after each round of a run with a target error or `max_paths`: paths (per replicate,
        of all rounds that it adds to; pilot rounds are replaced), seconds (since the run began),
        median_error and worst_error (relative standard errors over organs and bands),
        fraction_at_target. Empty for one round.
    audit : dict or None
        The audit: p_value, agrees, paths, replicates; None without one.
    sources : list of str
        Descriptions of the sources.
    """

    def __init__(self, core, sources):
        self.__dict__.update(core.facts)
        self.audit = core.audit
        self.sources = list(sources)

    def __repr__(self):
        return (
            f"<{self.method.replace('_', ' ')}, {self.paths:,} paths x {self.replicates}, "
            f"{self.rays:,} rays, {self.solve_seconds:.3g} s; {self.stop}>"
        )


class Parts(dict):
    """Light of the whole scene by its part, name -> Estimates of shape (bands,)."""

    def __init__(self, rows, bands, units, sources):
        """@param sources: dict, name -> source of estimates; parts without an error need none"""
        super().__init__()
        for name in rows[0] if rows else ():
            values = np.array([_numbers(row[name]) for row in rows])
            self[name] = Estimates(values, name, units, bands, source=sources.get(name))
        self._bands = bands

    def __missing__(self, key):
        if key in self._bands and self:
            first = next(iter(self))
            raise KeyError(f"the part comes first: [{first!r}][{key!r}]")
        raise KeyError(f"there is no part {key!r}; there are: {', '.join(self) or 'none'}")


def _numbers(value):
    """An estimate as four numbers; one that has no error is exact."""
    return value if isinstance(value, tuple) else (value, 0.0, value, value)
