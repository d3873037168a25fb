"""Runs of a scene."""

from __future__ import annotations

from . import _core
from ._meshes import plain
from ._progress import Listener
from ._tables import FRAME_KEYS, SCENE_KEYS, numbered
from ._warn import warn_here, warn_of_stop
from ._written import Written, WrittenSweep
from .merging import Part
from .result import Result
from .scene_sources import source_tables
from .series import Series
from .sweep import Sweep, points_of, scene_at
from .values import check_options, checked_time

#: The largest sums of replicates that are kept, bytes, by `keep` of a run and of a series.
_RUN_SUMS = {"auto": 256e6, "replicates": float("inf"), "estimates": -1.0}
_SERIES_SUMS = {**_RUN_SUMS, "auto": -1.0, "sums": -1.0}


class Runs:
    """Part of `Scene`."""

    def _written(self, sources=None, time=None, options=()):
        """The scene and the light on it, as a run file that holds them."""
        whole = self._document is not None or not self._meshes
        table = self._table if whole else numbered(self._table, self._meshes.values())
        scene = {key: table[key] for key in table if key in (*SCENE_KEYS, *FRAME_KEYS)}
        light = self._light_table(sources, time, dict(options))
        light.pop("output", None)
        tables = [_with_own_lists(one) for one in (scene, light)]
        return Written(self._name, self._folder, tables[0], self._mesh_list(), tables[1])

    def _light(self, built, sources, time, run_options):
        """What quasimc._core calls the light of a run, on a scene that was built."""
        return _core.Light(self._light_document(sources, time, run_options), built)

    def _light_document(self, sources, time, run_options):
        """The document of the light of a run; of an instant, if `time` is None."""
        if time is None and sources is None and "time" in self._table:
            raise ValueError("the scene has time steps: use scene.series(), or pass sources")
        is_of_scene = sources is None and not run_options and time == self.time
        if is_of_scene and self._document is not None:
            return self._document
        return self._document_of(self._light_table(sources, time, run_options))

    def _light_table(self, sources, time, run_options):
        check_options(run_options, "run")
        table = {key: value for key, value in self._table.items() if key not in SCENE_KEYS}
        if sources is not None:
            table["source"] = source_tables(sources)
        if time is not None:
            table["time"] = time.table()
        else:
            table.pop("time", None)
            table.pop("control", None)  # lamps are controlled by the hour
        if run_options:
            table["run"] = {**table.get("run", {}), **plain(dict(run_options))}
        return table

    def run(self, sources=None, *, progress=None, keep="auto", **options):
        """Computes the light on every organ at an instant.

        Ctrl-C stops a run; its result contains the completed paths, if there are any.

        Parameters
        ----------
        sources : Source or dict, or list of them
            They replace the sources of the scene. Default: the sources of the scene. Paths of files
            are relative to the current folder (for a loaded scene: to the folder of its file).
        progress : bool or callable
            True: a progress bar on stderr. A function is called repeatedly with a `Progress`; an
            exception from it ends the run.
        keep : str
            "replicates": keep the sums of all replicates, by which sums over organs and differences
            of results have errors; "estimates": only the estimates of organs and groups; "auto":
            replicates that need up to 256 MB.
        **options
            Run options, as in ``[run]``; `quasimc.options()` lists them.

        Returns
        -------
        Result

        Raises
        ------
        InputError
            With all errors.
        ValueError
            If the scene was loaded with ``[time]`` and no sources are passed.
        Stopped
            If max_seconds passed before there was a result.
        KeyboardInterrupt
            If Ctrl-C was pressed before there was a result.
        """
        with self._lock:
            organs = self._build()
            light = self._light(self._built, sources, None, options)
            warn_here(light.warnings)
            with Listener(progress) as listener:
                core, replicates = self._simulator.run(
                    self._built, light, largest_sums(keep), listener.callback
                )
            notes = [*self._built.warnings, *light.warnings]
        written = self._written(sources, None, options)
        result = Result(
            core, organs, notes, light.source_notes, light.ratio_names, replicates, written
        )
        warn_of_stop(result.run.stop)
        return result

    def series(self, time=None, sources=None, *, progress=None, keep="auto", **options):
        """Computes the light on every organ at many time steps, and its sums over days.

        Parameters
        ----------
        time : Time
            `quasimc.day`, `days`, `times` or `weather`: sun and sky. Default: `Scene.time`.
        sources : Source or dict, or list of them
            They shine at all time steps, beside sun and sky, and replace the sources of the scene;
            [] leaves sun and sky alone. Default: the sources of the scene shine as well.
        progress, **options
            As of `run`.
        keep : str
            "estimates": keep the result of each time step; "replicates": with the sums of all
            replicates, by which sums over organs have errors, also of days; "sums": keep sums over
            days alone, for long seasons; "auto": "estimates".

        Returns
        -------
        Series

        Raises
        ------
        InputError, Stopped, KeyboardInterrupt
            As of `run`.
        ValueError
            If there is no time.

        Examples
        --------
        >>> scene.series(quasimc.day("2024-06-21", utc_offset_hours=2))  # doctest: +SKIP
        """
        time = self.time if time is None else checked_time(time)
        if time is None:
            raise ValueError('which time? give quasimc.day("2024-06-21", utc_offset_hours=1), ...')
        size = largest_sums(keep, _SERIES_SUMS)
        with self._lock:
            organs = self._build()
            light = self._light(self._built, sources, time, options)
            written = self._written(sources, time, options)
            warn_here(light.warnings)
            with Listener(progress) as listener:
                core = _core.run_series(self._built, light, keep != "sums", size, listener.callback)
            notes = [*self._built.warnings, *light.warnings]
        series = Series(core, organs, notes, light.source_notes, light.ratio_names, written)
        warn_of_stop(series.stop)
        return series

    def sweep(self, values, sources=None, *, combine="product", progress=None, keep="auto", **options):
        """Runs the scene at several values of its keys, with the same random numbers.

        Parameters
        ----------
        values : dict
            Name -> list of values: "materials.leaf.reflectance"; "ground", "cell" or "site", whole or
            with a key ("ground.material"); "sources"; or a run option ("paths").
        combine : str
            "product": every value with all others, the last name varies fastest; "zip": side by side.
        sources, progress, keep, **options
            As of `run`, for all points.

        Returns
        -------
        Sweep

        Raises
        ------
        InputError, KeyError, AttributeError
            If a name or a value does not fit; before the first run, as far as it is about the scene.
        Stopped, KeyboardInterrupt
            As of `run`.

        Examples
        --------
        >>> scene.sweep({"materials.leaf.reflectance": [0.05, 0.1]})  # doctest: +SKIP
        """
        points = points_of(values, combine)
        if sources is not None and any(name.partition(".")[0] == "sources" for name in values):
            raise ValueError("sources are swept and passed: give them once")
        runs = [scene_at(self, point, options) for point in points]
        for scene, _, own in runs:
            check_options(own, "run")
            scene.build()
        results = []
        for scene, of_point, own in runs:
            light = sources if of_point is None else of_point
            results.append(scene.run(light, progress=progress, keep=keep, **own))
        base = self._written(sources, None, options)
        written = WrittenSweep(base, values, combine, [result._written for result in results])
        return Sweep(points, results, written)

    def part(self, index, count, sources=None, *, progress=None, **options):
        """Computes an exact share of a run, for other processes or machines; see `quasimc.merge`.

        Parameters
        ----------
        index, count : int
            Which of how many, from 0.
        sources, progress, **options
            As of `run`, the same for all parts. Paths are fixed: targets and limits are refused.

        Returns
        -------
        Part

        Raises
        ------
        ValueError
            If there is no such part, or the run has a target, a limit, an audit or time steps.
        """
        if not 0 <= index < count:
            raise ValueError(f"there is no part {index} of {count}: they are 0 to {count - 1}")
        with self._lock:
            organs = self._build()
            if organs.sensor_sets:
                raise ValueError("a scene with sensors has no parts: their light is no share of a run")
            light = self._light(self._built, sources, None, options)
            if not light.has_fixed_paths:
                raise ValueError(
                    "a part has no target_error, max_paths, max_seconds, audit or time: give paths"
                )
            with Listener(progress) as listener:
                sums, *method = self._simulator.part(
                    self._built, light, index, count, listener.callback
                )
            warnings = [*self._built.warnings, *light.warnings]
        written = self._written(sources, None, options)
        document = written.table(organs), written.name, written.folder
        return Part(index, count, sums, method, document, warnings, written)


def largest_sums(keep, sizes=_RUN_SUMS):
    """The size of the sums of replicates that are kept, bytes."""
    if keep not in sizes:
        hint = "; sums over days are of series()" if keep == "sums" else ""
        raise ValueError(f"keep is {keep!r}; give one of {', '.join(sizes)}{hint}")
    return sizes[keep]


def _with_own_lists(table):
    """A copy whose lists don't grow with those of the scene."""
    return {k: list(v) if isinstance(v, list) else v for k, v in table.items()}
