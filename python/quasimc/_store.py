"""Results as files and pickles."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

from . import _core
from ._keys import TABLE_KEYS, keyword_error, near
from ._meshes import input_error, plain
from ._program import call
from ._targets import target
from ._warn import warn_here
from .organs import Organs
from .result import Result
from .series import Series
from .sweep import Sweep

#: Formats that the module writes, those that the program makes from JSON, and of these the ones
#: of a scene, which has the light of one run.
_OWN, _CONVERTED, _OF_SCENES = (".json", ".csv"), (".nc", ".vtp", ".ply", ".glb"), (".vtp", ".ply", ".glb")


class Opened:
    """What a result of a file was computed from.

    Attributes
    ----------
    text : str or None
        The whole file, if it holds this result and no other.
    """

    def __init__(self, document, text=None):
        self._document = document
        self.text = text

    def document(self, _organs):
        """The run file, which holds the scene already."""
        return self._document


def text_of(light, format, table=None):
    """A Result, Series or Sweep as bytes of a file: "json", "csv", or "table" with the keys of one."""
    if light._written is None:
        raise input_error(
            "save",
            f"this {type(light).__name__} has no run file",
            "time steps are saved with their series, and the light of a specification is of no scene",
            "save the whole Series, or use to_pandas()",
        )
    if format == "json" and light._written.text is not None:
        return light._written.text.encode()
    document = light._written.document(light.organs)
    if format == "table":
        document = _core.Document({**document.table(), "table": [table]}, document.name, document.folder)
    if isinstance(light, Sweep):
        return _core.written_sweep(document, [_record_of(point) for point in light], format)
    if format == "csv" and isinstance(light, Series):
        light._results_of_times()  # refuses a table without rows
    return _core.written(document, _record_of(light), format)


def _record_of(light):
    """A result or a series as the record that the core writes."""
    if isinstance(light, Series):
        return light._core
    return _core.record_of(light.organs._scene, light._core)


def save(light, path, keys):
    """Writes a Result, Series or Sweep in the format of the path's ending. Nothing is left if it fails.

    @param keys: those of ``[[table]]``, for CSV
    """
    path = Path(path)
    ending = path.suffix.lower()
    known = [*_OWN, *(end for end in _CONVERTED if not (isinstance(light, Sweep) and end in _OF_SCENES))]
    if ending not in known:
        raise input_error(
            str(path),
            f"ends in {ending!r}" if ending else "has no ending",
            "the format follows from it",
            f"use {', '.join(known)}",
        )
    target(path)
    if keys:
        _check_table(light, ending, keys)
        _replace(path, text_of(light, "table", plain({"file": os.path.abspath(path), **keys})))
    elif ending in _OWN:
        _replace(path, text_of(light, ending[1:]))
    else:
        with json_file(light) as stored:
            call("convert", stored, path)
    return path


def _check_table(light, ending, keys):
    """Refuses keys of tables that have no meaning. Raises InputError."""
    for key in keys:
        if key not in TABLE_KEYS:
            raise keyword_error("save", key, near(key, TABLE_KEYS, f"it has {', '.join(TABLE_KEYS)}"))
    if ending != ".csv":
        raise input_error("save", f"{next(iter(keys))} is for tables", "", "use the ending .csv")
    per = keys.get("per", "time")
    if per == "sweep":
        raise input_error("save", "per = 'sweep'", "sums over points are not kept", "use sweep.sum()")
    if isinstance(light, Series) and per == "time" and keys.get("rows") != "control":
        light._results_of_times()  # refuses a table without rows


def _replace(path, content):
    """Writes a file whole or not at all."""
    draft = path.with_name(path.name + f".{os.getpid()}.part")
    try:
        draft.write_bytes(content)
        os.replace(draft, path)
    finally:
        if draft.exists():
            draft.unlink()


@contextmanager
def json_file(light):
    """A temporary JSON file of a Result, Series or Sweep."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "result.json"
        path.write_bytes(text_of(light, "json"))
        yield path


def open_result(path):
    """Reads a result that was saved as JSON, by Python or by the program.

    It has all that the file holds: the light of organs, sensors, detectors and groups, the budget,
    the fractions of the canopy, sums over days, lamps under control and the data of the run. It has
    no replicates: sums over organs have unknown errors. Quantities and bands that ``[output]`` of the
    run left out are nan, with a warning.

    Parameters
    ----------
    path : str or path

    Returns
    -------
    Result, Series or Sweep
        A Series of a run with ``[time]``, a Sweep of one with ``[sweep]`` (of Series, if it has both).

    Raises
    ------
    InputError
        If it is no result, or an input file is missing or has changed.
    """
    path = os.path.abspath(os.fspath(path))
    with open(path, "rb") as file:
        content = file.read()
    if content.startswith((b"CDF", b"\x89HDF")):
        raise input_error(
            path, "is NetCDF", "results are opened from JSON", "use xarray.open_dataset, or save .json too"
        )
    try:
        text = content.decode()
    except UnicodeDecodeError:
        text = ""
    if not text.lstrip().startswith("{"):
        raise input_error(
            path, "is not a result of QuasiMC", "results are JSON", "open a file of save() or `quasimc run --json`"
        )
    light, selection = _read(text, path, os.path.dirname(path))
    warn_here([f"{path}: {selection}"] if selection else [])
    return light


def result_of_text(text, name, folder):
    """The Result, Series or Sweep in the text of a JSON result."""
    return _read(text, name, folder)[0]


def _read(text, name, folder):
    """The light in a text, and in words what its run did not write."""
    points, runs, document, selection = _core.read_stored(text, name, folder)
    if points is None:
        return _light_of(*runs[0], text), selection
    return Sweep(points, [_light_of(*run) for run in runs], Opened(document, text)), selection


def _light_of(scene, core, sources, ratios, document, text=None):
    arguments = core, Organs(scene), scene.warnings, sources, ratios
    written = Opened(document, text)
    if isinstance(core, _core.Series):
        return Series(*arguments, written)
    return Result(*arguments, written=written)


def state_of(light):
    """What is pickled of a Result, Series or Sweep: a function, and its arguments."""
    written = light._written
    if isinstance(light, Sweep) and not isinstance(written, Opened):
        return Sweep, (light.points, light._results, written)
    if written is None:  # a time step, or a growth step
        _require_no_replicates(light)
        others = light.warnings, light.run.sources, light._ratio_names
        return Result, (_data_of(light._core), light.organs, *others)
    if isinstance(light, Result) and light.has_replicates:
        document = written.table(light.organs), written.name, written.folder
        others = light.run, light._sensor_light, light.warnings, written, light._identity
        return _result_of_sums, (document, _core.saved_sums(light._sums), *others)
    if isinstance(written, Opened):
        return result_of_text, (text_of(light, "json").decode(), "pickle", os.getcwd())
    _require_no_replicates(light)
    text = text_of(light, "json").decode()
    return _light_of_json, (text, written, light.__dict__.get("run"), light.warnings)


def _require_no_replicates(light):
    """Raises ValueError for replicates that only the core can hold."""
    results = [light] if isinstance(light, Result) else light._results
    if any(result.has_replicates for result in results):
        raise ValueError(
            "replicates of series and of growth steps can't be pickled: use keep=\"estimates\", or "
            "pickle sums and tables of the light"
        )


def _data_of(core):
    """The data of a result of the core, which can be pickled."""
    if isinstance(core, SimpleNamespace):
        return core
    kind = type(core)
    fields = [name for name in dir(kind) if isinstance(getattr(kind, name), property)]
    return SimpleNamespace(**{name: getattr(core, name) for name in fields})


def _light_of_json(text, written, run, warnings):
    light = result_of_text(text, "pickle", written.folder)
    light._written, light.warnings = written, warnings
    if run is not None:
        light.run = run
    return light


def _result_of_sums(document, sums, run, sensors, warnings, written, identity):
    scene, core, sources, ratios, replicates = _core.restored(_core.Document(*document), [sums])
    result = Result(core, Organs(scene), warnings, sources, ratios, replicates, written, identity)
    result.run, result._sensor_light = run, sensors
    return result
