"""What is added to a scene as entries of a run file: shapes, files, sensors, detectors, control."""

from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np

from ._meshes import input_error, plain
from ._tables import marks_of
from ._warn import warn_here


class Contents:
    """Part of `Scene`."""

    def add_organ(self, shape, *, material, **keys):
        """Adds an organ with a parametric shape: triangle, rhombus, polygon, bezier, cylinder, disk, ...

        Returns the scene, as all methods that add something.

        Parameters
        ----------
        shape : str
            One of `quasimc.shapes()`.
        material : str
        **keys
            Keys of the shape (corners, base, length, ...), and id, name, labels, measured,
            transform, at, field_of_view_deg.
        """
        return self._add("organ", {"shape": shape, "material": material, **self._with_paths(keys)})

    def add_file(self, file, **keys):
        """Adds organs from a geometry file (tri, OBJ, PLY, ...).

        Parameters
        ----------
        file : str or path
            Relative to the current folder (for a loaded scene: to the folder of its file).
        **keys
            format, organs, material, materials, name, labels, labels_from, measured, first_id,
            transform, at, plant_unit.
        """
        return self._add("geometry", {"file": self._path(file), **self._with_paths(keys)})

    def add_sensors(self, points=None, name="sensors", **keys):
        """Adds points at which light is measured; `Result.sensors` has their light.

        They shade nothing and change no other number (docs/reference/run-file.md#sensors).

        Parameters
        ----------
        points : array_like, optional
            (3,), (points, 3) or (rows, columns, 3): positions in the axes of the scene, whose shape the
            results have. Alternatively `at`: rows, a file or a regular array, as in a run file.
        name : str
            Unique among the sensors of the scene.
        **keys
            at, facing, receiver, field_of_view_deg, size, average, labels.

        Raises
        ------
        InputError
            If points have another shape; and when the scene is built, if sensors are invalid.

        Examples
        --------
        >>> scene.add_sensors([[0, 0, 0.5], [1, 0, 0.5]], name="bench")  # doctest: +SKIP
        """
        if points is not None:
            if "at" in keys:
                raise TypeError("give points or at, not both")
            keys["at"] = _rows_of_points(points)
        return self._add("sensors", {"name": name, **self._with_paths(keys)})

    def add_control(self, sources, sensors, **keys):
        """Has lamps switched and dimmed by the light at sensors, in runs with time steps.

        `Series.control` has the outcome (docs/reference/run-file.md#control).

        Parameters
        ----------
        sources : str
            Pattern of the names of lamps: ``"hps *"``.
        sensors : str
            Name of flat sensors, of whose upper sides the mean is taken.
        **keys
            on_below, daily_target, set_point, dim_min, electrical_power_w, band.

        Raises
        ------
        InputError
            By the run, with all errors.

        Examples
        --------
        >>> scene.add_control("hps *", "bench", on_below=150, daily_target=14)  # doctest: +SKIP
        """
        return self._add("control", {"sources": sources, "sensors": sensors, **keys})

    def add_detector(self, type, **keys):
        """Adds a detector, which sorts light that organs do not report (docs/reference/detectors.md)."""
        return self._add("detector", {"type": type, **keys})

    def _set_sources(self, tables):
        """Other sources, which are tables of a run file."""
        with self._lock.to_change():
            for table in self._table.get("source", []):
                self._unmark("source", table)
            self._marks.update(mark for table in tables for mark in marks_of("source", table))
            self._table["source"] = tables
            if not tables:
                del self._table["source"]
            self._document = None

    def _path(self, file):
        """A path as it is kept: what it means does not change with the current folder."""
        return os.fspath(file) if self._folder is not None else os.path.abspath(file)

    def _with_paths(self, keys):
        """The keys with the paths of tables of copies and of labels as they are kept."""
        tables = {
            key: {**value, "file": self._path(value["file"])}
            for key, value in keys.items()
            if key in ("at", "labels_from") and isinstance(value, Mapping) and "file" in value
        }
        return {**keys, **tables}

    def _add(self, key, table):
        table = plain(table)
        with self._lock.to_change():
            self._append(key, table)
            self._built = None
        return self

    def _append(self, key, entry):
        self._warn_of_second(key, entry)
        self._marks.update(marks_of(key, entry))
        self._table.setdefault(key, []).append(entry)
        self._document = None

    def _set(self, key, value):
        self._table[key] = value
        self._document = None
        self._built = None
        self._frame = None if key in ("material", "geometry") else self._frame

    def _warn_of_second(self, key, entry):
        """Warns of what is added twice: a cell of a notebook that was run again.

        Of meshes of one name the second alone is warned of: many may have one name on purpose.
        """
        what = {"geometry": "file"}.get(key, key)
        for mark in marks_of(key, entry):
            is_second = self._marks[mark] == 1 and key == "mesh"
            if is_second if mark[0] == "name" else mark in self._marks:
                same = f"of the name {mark[1]!r}" if mark[0] == "name" else "equal to this one"
                warn_here(
                    [
                        f"{self._name}: the scene already has a {what} {same} and now has both; "
                        "use replace() or remove() to keep one"
                    ]
                )
                break

    def _unmark(self, key, entry):
        for mark in marks_of(key, entry):
            self._marks[mark] -= 1
            if not self._marks[mark]:
                del self._marks[mark]


def _rows_of_points(points):
    """The rows of `at` for an array of points; those of a plane of points have labels i and j."""
    points = np.asarray(points, dtype=float)
    if points.ndim not in (1, 2, 3) or points.shape[-1] != 3 or points.size == 0:
        shape = "(3,), (points, 3) or (rows, columns, 3)"
        raise input_error("add_sensors", f"points have the shape {points.shape}", f"it must be {shape}")
    if points.ndim < 3:
        return points.reshape(-1, 3).tolist()
    return [
        {"x": x, "y": y, "z": z, "i": i + 1, "j": j + 1}
        for j, row in enumerate(points.tolist())
        for i, (x, y, z) in enumerate(row)
    ]
