"""Results as files and pickles."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

import numpy as np

from . import _core
from ._program import call
from .organs import Organs
from .result import Result

#: Formats of Result.save that the program makes from a JSON result.
_CONVERTED = (".nc", ".vtp", ".ply", ".glb")


def text_of(result, format):
    """A result as bytes of a file: "json", "csv"."""
    if isinstance(result._core, StoredCore):
        if format == "json":
            return result._core.text.encode()
        raise ValueError("a result that was opened has no CSV: use to_pandas().to_csv()")
    if result._written is None:
        raise ValueError(
            "results of series and of growth steps can't be saved: use the scene's own run(), or "
            "to_pandas()"
        )
    return _core.written(result._written.document(result.organs), result._core, format)


def save(result, path):
    """Writes a result in the format of the path's ending. Nothing is left if it fails."""
    path = Path(path)
    ending = path.suffix.lower()
    if ending in (".json", ".csv"):
        _replace(path, text_of(result, ending[1:]))
    elif ending in _CONVERTED:
        with json_file(result) as stored:
            call("convert", stored, path)
    else:
        known = ", ".join([".json", ".csv", *_CONVERTED])
        raise ValueError(f"{path} ends in {ending or 'nothing'!r}; results are written as {known}")
    return path


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
def json_file(result):
    """A temporary JSON file of a result."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "result.json"
        path.write_bytes(text_of(result, "json"))
        yield path


def open_result(path):
    """Reads a result that was saved as JSON, by Python or by the program.

    It has the light of organs, sensors, detectors and groups, the budget and the data of the run, but
    no replicates: sums over organs have unknown errors.

    Parameters
    ----------
    path : str or path

    Returns
    -------
    Result

    Raises
    ------
    InputError
        If it is no result of one time, or an input file is missing or has changed.
    """
    path = os.path.abspath(os.fspath(path))
    with open(path, encoding="utf-8") as file:
        return result_of_text(file.read(), path, os.path.dirname(path))


def result_of_text(text, name, folder):
    scene, core, rest, sources, ratios = _core.read_stored(text, name, folder)
    stored = StoredCore(core, rest, text, ratios)
    return Result(stored, Organs(scene), rest.get("warnings", ()), sources, ratios)


def state_of(result):
    """What is pickled of a result: a function, and its arguments."""
    if result._written is None and not isinstance(result._core, StoredCore):
        return Result, arguments_of(result, result.run.sources)
    if isinstance(result._core, StoredCore):
        return result_of_text, (text_of(result, "json").decode(), "pickle", os.getcwd())
    document = result._written.table(result.organs), result._written.name, result._written.folder
    if not result.has_replicates:
        text = text_of(result, "json").decode()
        return _result_of_json, (text, result._written, result.run)
    sums = _core.saved_sums(result._sums)
    others = result.run, result._sensor_light, result.warnings, result._written
    return _result_of_sums, (document, sums, *others)


def arguments_of(light, sources):
    """The arguments that make a result without a scene's run again, or a series.

    Raises ValueError if there are replicates, which only the core can hold.
    """
    results = [light] if isinstance(light, Result) else light._results
    if any(result.has_replicates for result in results):
        raise ValueError(
            "replicates of series and of growth steps can't be pickled: use keep=\"estimates\", or "
            "pickle sums and tables of the light"
        )
    return data_of(light._core), light.organs, light.warnings, sources, light._ratio_names


def data_of(core):
    """The data of a result or a series of the core, which can be pickled."""
    if isinstance(core, SimpleNamespace):
        return core
    kind = type(core)
    fields = [name for name in dir(kind) if isinstance(getattr(kind, name), property)]
    data = SimpleNamespace(**{name: getattr(core, name) for name in fields})
    if hasattr(data, "results"):
        data.results = [data_of(result) for result in data.results]
    return data


def _result_of_json(text, written, run):
    result = result_of_text(text, "pickle", written.folder)
    result.run = run
    return result


def _result_of_sums(document, sums, run, sensors, warnings, written):
    scene, core, sources, ratios, replicates = _core.restored(_core.Document(*document), [sums])
    result = Result(core, Organs(scene), warnings, sources, ratios, replicates, written)
    result.run, result._sensor_light = run, sensors
    return result


class StoredCore:
    """A result of a file, with the members of a result of the core."""

    def __init__(self, core, rest, text, ratio_names):
        self.text = text
        self.values = core.values
        self.sunlit_fraction = core.sunlit_fraction
        self.ratios = core.ratios
        self.detectors = core.detectors
        self.sensors = core.sensors
        self.sun_shade = core.sun_shade
        self.origins = core.origins
        self.audit = rest.get("audit") or None
        bands = list(rest["energy"])
        self.budget = [_parts(rest["energy"][band], ("emitted",)) for band in bands]
        self.canopy = [_parts(fractions) for fractions in (rest.get("canopy") or {}).values()]
        self.groups = _groups(rest.get("groups") or [], core.groups, bands, ratio_names)
        self.facts = _facts(rest)


def _tuple(estimate):
    """mean, standard error and interval; null, which the core reads as "", is unknown."""
    keys = ("mean", "standard_error", "ci95_low", "ci95_high")
    numbers = [None] * 4 if not estimate else [estimate.get(key) for key in keys]
    return tuple(np.nan if number in (None, "") else float(number) for number in numbers)


def _parts(row, separate=()):
    """The parts of a budget, or fractions: name -> tuple, or a number without an error."""
    parts = {}
    for name, value in row.items():
        if isinstance(value, dict):
            parts[name] = _tuple(value)
        elif name in separate:
            error = row.get(f"{name}_standard_error") or 0.0
            parts[name] = (value, error, np.nan if error else value, np.nan if error else value)
        elif name != "unit" and not name.endswith("_standard_error"):
            parts[name] = np.nan if value in (None, "") else float(value)
    return parts


def _groups(rows, core, bands, ratio_names):
    """The groups of a file as the dict that the core makes."""
    names = list(_core.quantities())

    def column(path):
        values = []
        for row in rows:
            for key in path:
                row = None if row is None else row.get(key)
            values.append(_tuple(row))
        return np.array(values).reshape(len(rows), 4)

    def table(keys):
        columns = [[column([key, band]) for band in bands] for key in keys]
        return np.moveaxis(np.array(columns).reshape(len(keys), len(bands), len(rows), 4), 2, 0)

    shares = ("fraction_incident", "fraction_absorbed")
    has_sun = any("sunlit_fraction" in row for row in rows)
    return {
        "groups": core["groups"][: len(rows)],
        "values": table(names),
        "sunlit_fraction": column(["sunlit_fraction"]) if has_sun else np.zeros((0, 4)),
        "sunlit_area": column(["sunlit_area"]) if has_sun else np.zeros((0, 4)),
        "ratios": np.stack(
            [column(["ratios", name]) for name in ratio_names] or [np.zeros((len(rows), 4))], axis=1
        )[:, : len(ratio_names)],
        "shares": table(shares),
    }


def _facts(rest):
    completed, timing, method = rest["completed"], rest.get("timing") or {}, rest["method"]
    return {
        "method": method["used"],
        "reason": method["reason"],
        "paths": completed["paths"],
        "replicates": completed["replicates"],
        "rays": completed["rays"],
        "stop": completed["stop"],
        "fraction_at_target": completed["fraction_at_target"],
        "preparation_seconds": timing.get("preparation_s", 0.0),
        "solve_seconds": timing.get("solve_s", 0.0),
        "solve_cpu_seconds": timing.get("solve_cpu_s", 0.0),
        "escaped_by_difference": rest["escaped_by_difference"],
        "rounds": rest.get("rounds") or [],
    }
