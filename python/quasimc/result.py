"""Results: the light of every organ, with its errors."""

from __future__ import annotations

import os
from functools import cached_property

import numpy as np

from . import _core
from ._combination import Combination
from ._first_order import FirstOrder
from ._format import number
from ._index import GroupIndex, OrganIndex
from ._light import Light, origins_of, ratio_estimates
from ._lights import Lights
from ._result_tables import ResultTables
from ._result_views import ResultViews
from ._rows import Rows
from ._spread import Spread
from .detectors import DetectorResult
from .estimates import Estimates
from .groups import Groups, group_rows
from .run_info import Parts, RunInfo
from .sensors import sensors_by_name
from .sun_shade import parts_of


#: Fractions of the light on the horizontal: what they are of.
_FRACTIONS = {
    "reflectance": "reflected", "transmittance": "transmitted", "absorptance": "absorbed_by_organs",
    "ground_absorptance": "absorbed_by_ground",
}  # fmt: skip


def fractions_of(totals):
    """The fractions of a canopy: dict, name -> source. Without a ground those of the ground are NaN."""
    incident = totals["incident"]
    nan = np.full(incident.means.shape, np.nan)
    unknown = Spread.of_values(nan, nan, incident.replicates)
    has_ground = "transmitted" in totals
    with np.errstate(divide="ignore", invalid="ignore"):
        return {
            name: FirstOrder.of(np.divide, lambda x, y: (1 / y, -x / y**2), [totals[part], incident])
            if has_ground or name == "absorptance"
            else unknown
            for name, part in _FRACTIONS.items()
        }


class GroundLight(Light):
    """The light on the ground: ``result.ground["absorbed_flux"]["PAR"]`` is one number."""

    def __getitem__(self, quantity):
        return super().__getitem__(quantity)[0]


class Result(ResultTables, ResultViews, Light):
    """The light of every organ.

    ``result["absorbed_flux"]["PAR"]`` are the `Estimates` of the organs, in the order of
    ``result.organs``: an array with standard errors. Quantities are listed by
    `quasimc.quantities()`; with directional sources there is also "sunlit_fraction".

    Attributes
    ----------
    organs : Organs
        Ids, names, labels and areas.
    run : RunInfo
        Method, paths, time and other data of the run.
    warnings : list of str
    """

    def __init__(
        self, core, organs, warnings=(), sources=(), ratio_names=(), replicates=None, written=None,
        identity=None,
    ):  # fmt: skip
        count = len(organs)
        self._identity = identity or os.urandom(16).hex()  # of the replicates, also in other processes
        kept = None if replicates is None else Lights(replicates, self._identity, len(organs.bands))
        parts, whole = (kept, kept.whole()) if kept is not None and core.origins else (None, kept)
        super().__init__(
            core.values[:count],
            OrganIndex(organs),
            organs,
            sunlit=core.sunlit_fraction[:count],
            rows=Rows.of_organs(np.arange(count)),
            replicates=whole,
            origins=origins_of(core.origins, parts, lambda light: light["values"][:count]),
        )
        self._core = core
        self._sensor_light = core.sensors
        self._sums = replicates
        self._written = written  # what it was computed from; None: not a scene's run
        self._parts = parts
        self._ratio_names = list(ratio_names)
        self.organs = organs
        self.warnings = list(warnings)
        self.run = RunInfo(core, sources)

    def __getattr__(self, name):
        old = {
            "select": "at",
            "sources": "run.sources",
            "plot_profile": "plot.profile",
            "plot_organs": "plot.light_by_index",
        }
        if name in old or (name in self.__dict__.get("run", type("", (), {})()).__dict__):
            raise AttributeError(f"`{name}` is now `{old.get(name, f'run.{name}')}`")
        raise AttributeError(f"'Result' object has no attribute {name!r}")

    @property
    def has_replicates(self):
        """Whether sums over organs and differences of results have errors."""
        return self._replicates is not None

    @cached_property
    def ground(self):
        """The light on the ground: GroundLight; None without one."""
        if not self.organs.has_ground:
            return None
        last = len(self.organs)
        return GroundLight(
            self._core.values[last:],
            GroupIndex(["ground"], self.organs._scene.areas[last:]),
            self.organs,
            sunlit=self._core.sunlit_fraction[last:],
            rows=Rows.of_organs(np.array([last])),
            replicates=self._replicates,
            origins=origins_of(
                self._core.origins, self._parts, lambda light: light["values"][last:]
            ),
        )

    @cached_property
    def ratios(self):
        """Ratios of bands by organ: dict, "R:FR" -> Estimates of shape (organs,)."""
        values = self._core.ratios[: len(self.organs)]
        return ratio_estimates(values, self._ratio_names, self._index)

    @cached_property
    def groups(self):
        """The groups of the run (`groups`, `layers`): Groups; the first is all organs."""
        return Groups(
            self._core.groups,
            self.organs,
            self._ratio_names,
            replicates=self._replicates,
            parts=self._parts,
            origins=self._core.origins,
        )

    @cached_property
    def _totals(self):
        """The light of the whole scene replicate by replicate: dict, name -> Spread; empty: not kept."""
        if self._replicates is None:
            return {}
        totals = self._replicates.core.totals()
        return {name: Spread.of_replicates(*numbers) for name, numbers in totals.items()}

    @cached_property
    def budget(self):
        """Energy budget: dict, part -> Estimates of shape (bands,), flux; they know their replicates.

        "closure_error" is the fraction of the emitted light that is not accounted for (rounding).
        """
        units = [self._unit("absorbed_flux", unit) for unit in self.organs.units]
        parts = Parts(self._core.budget, self.bands, units, self._totals)
        if "closure_error" in parts:
            parts["closure_error"]._set_unit("")
        return parts

    @cached_property
    def canopy(self):
        """Fractions of the light on the horizontal: dict, part -> Estimates of shape (bands,).

        The difference of two results, ``a.canopy["absorptance"] - b.canopy["absorptance"]``, pairs their
        replicates.
        "incident" is the flux on the horizontal area, in the unit of flux. Empty without a ground or
        a cell that is periodic along both axes.
        """
        sources = fractions_of(self._totals) if self._core.canopy and self._totals else {}
        parts = Parts(self._core.canopy, self.bands, ("",) * len(self.bands), sources)
        if "incident" in parts:
            parts["incident"]._set_units(
                self._unit("absorbed_flux", unit) for unit in self.organs.units
            )
        return parts

    @cached_property
    def sensors(self):
        """Light on sensors: dict, name of a set -> `Sensors`, in the order in which they were added.

        Empty if the run was stopped before it was computed; `sensors["bench"]` is then a KeyError.
        """
        return sensors_by_name(self._sensor_light, self.organs)

    @cached_property
    def sun_shade(self):
        """Light of the sunlit and the shaded part of organs, with sun_shade="apart": SunShade."""
        return parts_of(self._core.sun_shade, self._index, self.organs)

    @cached_property
    def detectors(self):
        """Detectors: dict, name -> DetectorResult, in the order in which they were added."""
        units = tuple(self._unit("absorbed_flux", unit) for unit in self.organs.units)
        return {
            seen["name"]: DetectorResult(seen, units, self.bands) for seen in self._core.detectors
        }

    def at(self, organs):
        """The light of organs given by id or name, in that order: Light.

        Raises KeyError if an organ does not exist, or several organs have the name.
        """
        if isinstance(organs, (str, int, np.integer)):
            organs = [organs]
        rows = np.array([self.organs.index_of(organ) for organ in organs], int)
        return Light(
            self._values[rows],
            self._index.take(rows),
            self.organs,
            sunlit=self._sunlit[rows] if self._has_sunlit else None,
            rows=self._rows.take(rows),
            replicates=self._replicates,
            origins={
                name: (values[rows], parts) for name, (values, parts) in self._origins.items()
            },
        )

    def by(self, *labels, layers=0, layer_heights=()):
        """Sums over groups of organs, with their errors, after the run.

        Parameters
        ----------
        *labels : str
            As `groups` of a run: a label, "plant+kind", "top: plant where height > 1.2".
        layers : int
            Layers of equal height; or
        layer_heights : sequence of float
            heights between layers, ascending.

        Returns
        -------
        Groups

        Raises
        ------
        InputError
            If no organ has a label, or a condition has an error.
        ValueError
            If the replicates of the run were not kept.
        """
        self._require_replicates("by()")
        core = self._replicates.core.groups(list(labels), int(layers), [float(h) for h in layer_heights])
        return Groups(
            core, self.organs, self._ratio_names, first=1, replicates=self._replicates
        )

    def sum(self, quantity, where=None, *, by=None):
        """The sum of a flux over organs, or the mean of a density weighted by area; with its error.

        Parameters
        ----------
        quantity : str
        where : array_like of bool, or str
            Mask of organs, or a condition as that of `Organs.where`; default: all.
        by : str or array_like
            A label, or one value for each organ: a sum for each value.

        Returns
        -------
        Estimates
            Of shape (bands,), or (groups, bands) with an index of the values in `by`.
        """
        light = self[quantity]
        mask = self.organs.where(where) if isinstance(where, str) else where
        mask = np.ones(len(self.organs), bool) if mask is None else np.asarray(mask)
        if by is None:
            return light.sum(where=mask) if light.extensive else light.average(where=mask)
        self._require_replicates("sums by groups")
        positions = np.flatnonzero(mask)
        values = self.organs.label(by) if isinstance(by, str) else np.asarray(by)
        if values.shape != mask.shape:
            raise ValueError(f"by has the shape {values.shape}; there are {len(mask)} organs")
        keys, members = group_rows(values[positions], positions)
        areas = np.array([self.organs.areas[group].sum() for group in members])
        rows = Rows.of_groups(members)
        if not light.extensive:
            rows = rows.scaled(1 / np.where(areas > 0, areas, 1))
        number = list(_core.quantities()).index(quantity) if light.bands else Combination.SUNLIT
        source = Combination(self._replicates, number, rows)
        return Estimates(
            source.estimates(),
            light.name,
            light._units,
            light.bands,
            index=GroupIndex(keys, areas),
            source=source,
            extensive=light.extensive,
        )

    def __reduce__(self):
        from ._store import state_of

        return state_of(self)

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self

    def __eq__(self, other):
        """Whether the light of all organs is the same, bit for bit, for the same organs."""
        return (
            isinstance(other, Result)
            and self._index == other._index
            and self.bands == other.bands
            and np.array_equal(self._values, other._values, equal_nan=True)
        )

    __hash__ = None

    def _require_replicates(self, what):
        if self._replicates is None:
            raise ValueError(
                f'{what}: the replicates of this run were not kept; run with keep="replicates"'
            )

    def __repr__(self):
        info = f"{self.run.method}, {self.run.paths:,} paths x {self.run.replicates}"
        light = self["absorbed_flux"]
        absorbed = ""
        if self.has_replicates and len(self.organs):
            sums = light.sum()
            absorbed = "; absorbed " + ", ".join(f"{band} {sums[band]}" for band in self.bands)
        errors = light.relative_error[np.isfinite(light.relative_error)]
        median = f"; median error {number(100 * float(np.median(errors)))} %" if errors.size else ""
        return (
            f"<Result: {len(self.organs)} organs, {', '.join(self.bands)}{absorbed}{median}; "
            f"{info}, {self.run.stop}>"
        )

    def _repr_html_(self):
        from ._html import result_html

        return result_html(self)
