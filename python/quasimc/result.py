"""Results: the light of every organ, with its errors."""

from __future__ import annotations

import os
from functools import cached_property

import numpy as np

from . import _core
from ._format import number
from ._index import GroupIndex, OrganIndex
from ._light import Light, estimate_columns, label_columns, origins_of, ratio_estimates
from ._spread import Combination, Rows
from .detectors import DetectorResult, detector_variables
from .estimates import Estimates
from .groups import Groups, group_rows
from .run_info import Parts, RunInfo
from .sensors import free_sensor_variables, sensors_by_name
from .sun_shade import parts_of


class GroundLight(Light):
    """The light on the ground: ``result.ground["absorbed_flux"]["PAR"]`` is one number."""

    def __getitem__(self, quantity):
        return super().__getitem__(quantity)[0]


class Result(Light):
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

    def __init__(self, core, organs, warnings=(), sources=(), ratio_names=(), replicates=None, written=None):
        count = len(organs)
        if replicates is not None and core.origins:
            parts, whole = replicates, replicates.whole()
        else:
            parts, whole = None, replicates
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
    def budget(self):
        """Energy budget: dict, part -> Estimates of shape (bands,), flux.

        "closure_error" is the fraction of the emitted light that is not accounted for (rounding).
        """
        units = [self._unit("absorbed_flux", unit) for unit in self.organs.units]
        parts = Parts(self._core.budget, self.bands, units)
        if "closure_error" in parts:
            parts["closure_error"]._set_unit("")
        return parts

    @cached_property
    def canopy(self):
        """Fractions of the light on the horizontal: dict, part -> Estimates of shape (bands,).

        "incident" is the flux on the horizontal area, in the unit of flux. Empty without a ground or
        a cell that is periodic along both axes.
        """
        parts = Parts(self._core.canopy, self.bands, ("",) * len(self.bands))
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
        core = self._replicates.groups(list(labels), int(layers), [float(h) for h in layer_heights])
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

    # Files and pictures.

    def save(self, path):
        """Writes the result to a file, in the format of its ending.

        ".json": all, for `quasimc.open` and the program; ".csv": the table of organs; ".nc": NetCDF;
        ".vtp", ".glb", ".ply": the scene with its light for ParaView, Blender and MeshLab. Results of
        series and of growth steps can't be saved.

        Returns
        -------
        pathlib.Path
        """
        from ._store import save

        return save(self, path)

    def picture(self, path=None, quantity="absorbed_flux_density", band=None, **options):
        """Draws the scene coloured by its light, by the program (docs/guide/pictures.md).

        Parameters
        ----------
        path : str or path
            PNG file to write; None: none.
        quantity, band : str
            What colours show; default: the absorbed flux density in the first band.
        **options
            Options of `quasimc show`: error=True, camera="top", size=(1200, 900), fov, clip, range,
            colormap, label, minus (a result whose values are subtracted).

        Returns
        -------
        Picture
            A notebook displays it.
        """
        from ._store import json_file
        from .pictures import draw

        minus = options.pop("minus", None)
        with json_file(self) as stored:
            options = {"quantity": quantity, "band": band, **options}
            if minus is None:
                picture = draw(stored, options)
            else:
                with json_file(minus) as other:
                    picture = draw(stored, {**options, "minus": other})
        if path is not None:
            picture.save(path)
        return picture

    def report(self, path):
        """Writes one HTML page with the scene to turn and all numbers. Returns its path."""
        from pathlib import Path

        from ._program import call
        from ._store import json_file

        with json_file(self) as stored:
            call("report", stored, "-o", os.fspath(path))
        return Path(path)

    def show(self):
        """Shows the result in 3D: in a notebook in a frame, elsewhere in a browser.

        Returns
        -------
        Page of a notebook, or the address of the page, which this process serves until it ends.
        """
        from tempfile import mkdtemp

        from ._store import text_of
        from .pictures import Page, in_notebook, open_in_browser

        folder = mkdtemp()
        if in_notebook():
            return Page(self.report(os.path.join(folder, "result.html")).read_text("utf-8"))
        path = os.path.join(folder, "result.json")
        with open(path, "wb") as file:
            file.write(text_of(self, "json"))
        return open_in_browser(path)

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

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each organ.

        The index is the organ's id; the columns are those of the CSV files: name, labels, area,
        ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``. A label with the name of
        another column becomes ``label_<key>``. Units are in ``frame.attrs["units"]``.
        """
        import pandas

        columns = self._columns()
        if self._has_sunlit:
            columns.update(estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
        for name, estimates in self.ratios.items():
            columns.update(estimate_columns(f"ratio_{name}", estimates))
        labels = label_columns(self.organs.labels, columns)
        columns = {"name": self.organs.names, **labels, "area": self.organs.areas, **columns}
        frame = pandas.DataFrame(columns, index=pandas.Index(self.organs.ids, name="id"))
        frame.attrs["units"] = {
            f"{quantity}_{band}": self[quantity][band].unit
            for quantity in _core.quantities()
            for band in self.bands
        }
        return frame

    def to_pyvista(self):
        """Returns a pyvista.PolyData: the triangles of the organs with their light.

        Cells have the arrays "organ" (ids), "name", ``label_<key>``, and the columns of `to_pandas`:
        ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``, equal for all triangles of an organ.
        Coordinates are in the axes and the length unit of the scene. The ground is not among them.

        Raises ImportError if pyvista is missing, and ValueError if the triangles were not stored.
        """
        from ._exchange import to_pyvista

        columns = self._columns()
        if self._has_sunlit:
            columns.update(estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
        for name, estimates in self.ratios.items():
            columns.update(estimate_columns(f"ratio_{name}", estimates))
        return to_pyvista(self.organs, columns)

    def to_xarray(self):
        """Returns an xarray.Dataset with the dimensions organ, band and statistic.

        Statistics are mean, standard_error, ci95_low, ci95_high. Units are attributes of the
        variables. A detector is a variable with its name and the dimension <name>_bin instead of
        organ; if the name is used already, it is ``detector_<name>``. Sensors have the variables of
        `Sensors.to_xarray` with the name of their set in front: ``bench_incident_upper``, along
        ``bench_point``, or ``bench_j`` and ``bench_i``.
        """
        import xarray

        variables, dimensions = {}, ("organ", "band", "statistic")
        for i, quantity in enumerate(_core.quantities()):
            attributes = {"units": ", ".join(dict.fromkeys(self[quantity]._units))}
            variables[quantity] = (dimensions, self._values[:, i], attributes)
        if self._has_sunlit:
            variables["sunlit_fraction"] = (("organ", "statistic"), self._sunlit, {"units": "1"})
        coordinates = {
            "organ": self.organs.ids,
            "band": list(self.bands),
            "statistic": ["mean", "standard_error", "ci95_low", "ci95_high"],
            "name": ("organ", np.asarray(self.organs.names)),
            "area": ("organ", self.organs.areas, {"units": f"{self.organs.length_unit}2"}),
        }
        for key, values in label_columns(self.organs.labels, [*variables, *dimensions]).items():
            coordinates[key] = ("organ", np.asarray(values))
        taken = [*variables, *coordinates]
        for name, detector in detector_variables(self.detectors, taken).items():
            variables[name] = detector.to_xarray().rename(bin=f"{name}_bin")
        for sensors in self.sensors.values():
            more, points = free_sensor_variables(sensors, {*variables, *coordinates})
            variables |= more
            coordinates |= points
        return xarray.Dataset(variables, coordinates, {"method": self.run.method})

    @property
    def plot(self):
        """Plots by matplotlib: Plots, with scene, profile, histogram, light_by_index, convergence."""
        from .plotting import Plots

        return Plots(self)

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
