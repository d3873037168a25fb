"""Scenes."""

from __future__ import annotations

import copy
import difflib
import os
from collections import Counter
from collections.abc import Mapping

import numpy as np

from . import _core
from ._assigned import Assigned
from ._lock import OneAtATime
from ._meshes import digest, input_error, mesh_arrays, owned, plain
from ._runs import Runs
from ._tables import FRAME_KEYS, ids_of, marks_of, numbered
from ._views import Views
from ._warn import warn_here
from .materials import Materials
from .organs import Organs
from .scene_organs import SceneOrgans

#: Keys of a document whose entries are added one by one, and may have a name.
_LISTS = ("organ", "geometry", "sensors", "detector", "source", "control")


def options():
    """Run options: list of dict with key, default, unit, takes and summary."""
    return _core.options()


def _band_keys(bands):
    if isinstance(bands, str):
        return {"bands": [bands]}
    if isinstance(bands, Mapping):
        return {"band": [{"name": name, "unit": unit} for name, unit in bands.items()]}
    bands = list(bands)
    if any(isinstance(band, Mapping) for band in bands):
        return {"band": [b if isinstance(b, Mapping) else {"name": b} for b in bands]}
    return {"bands": bands}


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


class Scene(Assigned, Runs, Views):
    """Organs and their materials, optionally a ground and a periodic cell.

    Arguments have the names of the run file (docs/reference/run-file.md). Arrays are copied: later
    changes of an array have no effect. An invalid material or mesh raises an error at the call, and
    the scene stays unchanged; everything else is checked when the scene is built, at the latest by the
    first run.

    Parameters
    ----------
    bands : str, list, or dict
        Names of the bands; or a dict, name -> unit; or dicts with name, unit, from_nm, to_nm.
    irradiance_unit : str
        Unit of bands without their own unit. It is only a name: nothing is converted.
    length_unit : str
        Unit of all coordinates: "m", "cm", "mm" and others.
    up : str
        "z" or "y": the axis that points up.
    north : sequence of 3 floats
        Horizontal direction of azimuth 0. Default: y, or x if y is up.
    site : Site
        For the position of the sun.
    title : str
    """

    def __init__(
        self,
        bands="PAR",
        *,
        irradiance_unit=None,
        length_unit=None,
        up=None,
        north=None,
        site=None,
        title=None,
    ):
        given = {
            "title": title,
            "irradiance_unit": irradiance_unit,
            "length_unit": length_unit,
            "up": up,
            "north": north,
        }
        self._init(
            plain({**_band_keys(bands), **{k: v for k, v in given.items() if v is not None}}),
            "scene",
            None,
        )
        self.site = site

    def _init(self, table, name, folder):
        self._table = table
        self._name = name
        self._folder = folder  # that paths are relative to; None: the current one
        self._meshes = {}  # by ascending numbers, tuples: parts of a mesh share the beginning
        self._numbers = {}  # of the meshes of each name, if they have one
        self._ids = {}  # number of the mesh of each organ that was given an id
        self._numbered = 0  # meshes that were added so far
        self._document = None  # as it was read, with its lines, as long as nothing is changed
        self._built = None
        self._frame = None  # what meshes are checked against; None: materials were changed
        self._known = set()  # names of materials that the frame has
        self._marks = Counter()  # of all that was added
        self._marks.update(m for key in _LISTS for e in table.get(key, []) for m in marks_of(key, e))
        self._organs = None
        self._overlaps = _core.KnownOverlaps()  # what edits of few triangles leave as it is
        self._simulator = _core.Simulator()
        self._lock = OneAtATime()

    @classmethod
    def _of_document(cls, document):
        scene = cls.__new__(cls)
        scene._init(document.table(), document.name, document.folder)
        scene._document = document
        return scene

    def __copy__(self):
        """An independent copy of the scene."""
        other = type(self).__new__(type(self))
        other._init(copy.deepcopy(self._table), self._name, self._folder)
        other._meshes = dict(self._meshes)
        other._numbers = {name: set(numbers) for name, numbers in self._numbers.items()}
        other._ids = dict(self._ids)
        other._numbered = self._numbered
        other._marks = self._marks.copy()
        other._document = self._document
        return other

    def __deepcopy__(self, memo):
        return self.__copy__()

    def __reduce__(self):
        state = (
            self._table, self._name, self._folder, self._meshes, self._numbers, self._ids,
            self._numbered, self._marks,
        )  # fmt: skip
        return _restored, state

    def __eq__(self, other):
        """Whether two scenes have the same contents in the same order."""
        return (
            isinstance(other, Scene)
            and self._table == other._table
            and [m["digest"] for m in self._mesh_list()] == [m["digest"] for m in other._mesh_list()]
        )

    __hash__ = None

    # Stating what there is.

    def add_material(
        self, name, reflectance=None, transmittance=None, *, upper=None, lower=None, **keys
    ):
        """Adds a material, or replaces that of the same name.

        Parameters
        ----------
        name : str
        reflectance, transmittance : float, list or dict
            0 to 1; one for all bands, one for each, or by band name. Their sum is at most 1.
        upper, lower : dict
            Optics of one side, with the same keys. From the upper side the corners of a triangle
            appear counter-clockwise.
        **keys
            reflection_model, reflection_exponent and others.
        """
        given = plain(
            dict(
                name=name,
                reflectance=reflectance,
                transmittance=transmittance,
                upper=upper,
                lower=lower,
                **keys,
            )
        )
        with self._lock.to_change():
            self._frame_of([given])
            materials = list(self._table.get("material", []))
            same = [i for i, m in enumerate(materials) if m.get("name") == name]
            self._set("material", _with_entry(materials, same, given))
        return self

    @property
    def materials(self):
        """The materials by name: Materials, which can be edited."""
        return Materials(self)

    def _remove_material(self, name):
        """Removes a material that nothing uses. Raises ValueError otherwise."""
        users = [m for m in self._meshes.values() if name in m["materials"]]
        for key in ("organ", "geometry"):
            users += [e for e in self._table.get(key, []) if name in _materials_in(e)]
        users += [g for g in [self._table.get("ground")] if g and g.get("material") == name]
        if users:
            raise ValueError(f"material {name!r} is used by {len(users)} organs, meshes or files")
        with self._lock.to_change():
            self._set("material", [m for m in self._table["material"] if m.get("name") != name])

    def add_mesh(
        self,
        vertices,
        faces=None,
        *,
        material,
        organ=None,
        name=None,
        labels=None,
        measured=True,
        field_of_view_deg=90.0,
    ):
        """Adds organs made of triangles. In results they follow the organs of `add_organ` and `add_file`.

        Arrays are copied. A mesh with the name of an earlier one, or equal to it, is added with a
        warning; use `replace` to replace the earlier one.

        Parameters
        ----------
        vertices : array_like
            (n, 3), in the length unit; without faces (m, 3, 3), the corners of each triangle.
        faces : array_like of int
            (m, 3): indices of vertices, from 0.
        material : str, dict or list of str
            One name; or a dict by the ids in `organ`; or one name for each face.
        organ : int or array_like of int
            (m,): the id of the organ of each face, or of all; unique in the scene. Results list the
            organs by ascending id; organs of `add_organ` without an id are then numbered after the
            largest. Default: all faces are one organ, with the next free id.
        name : str, dict or list of str
            Names of the organs: a dict by the ids in `organ`, or a list of one for each, in the order
            in which the organs first appear in `organ`; one name for several is followed by the id.
        labels : dict
            Key -> a value for all, a dict by the ids in `organ`, or a list of one for each organ, in
            the order in which they first appear there.
        measured : bool
            Whether their light is reported.
        field_of_view_deg : float
            Half angle about the normal for sensors, degrees.
        """
        with self._lock.to_change():
            mesh = self._mesh(
                vertices, faces, organ, material, name, labels, measured, field_of_view_deg
            )
            self._check_mesh(mesh, [])
            self._warn_of_second("mesh", mesh)
            self._put(mesh, (self._numbered,))
        return self

    def add_trimesh(self, mesh, *, material, **keys):
        """Adds the triangles of a trimesh.Trimesh, in the length unit of the scene.

        The face attribute "organ", if there is one, has the ids of organs; `organ` overrides it.
        Other keywords, the value that is returned and errors are those of `add_mesh`.
        """
        from ._exchange import of_trimesh

        vertices, faces, organ = of_trimesh(mesh)
        return self.add_mesh(
            vertices, faces, material=material, organ=keys.pop("organ", organ), **keys
        )

    def add_pyvista(self, mesh, *, material, **keys):
        """Adds the surface of a data set of pyvista, in the length unit of the scene.

        Polygons are divided into triangles. The array of cells "organ", if there is one, has the ids
        of organs; `organ` overrides it. Other keywords, the value that is returned and errors are
        those of `add_mesh`.
        """
        from ._exchange import of_pyvista

        vertices, faces, organ = of_pyvista(mesh)
        return self.add_mesh(
            vertices, faces, material=material, organ=keys.pop("organ", organ), **keys
        )

    def replace(
        self,
        name,
        vertices,
        faces=None,
        *,
        material,
        organ=None,
        labels=None,
        measured=True,
        field_of_view_deg=90.0,
    ):
        """Replaces everything with a name by a mesh; the arguments are those of `add_mesh`.

        Raises
        ------
        InputError
            If nothing has this name, or the mesh is invalid; the scene stays unchanged.
        """
        with self._lock.to_change():
            mesh = self._mesh(
                vertices, faces, organ, material, name, labels, measured, field_of_view_deg
            )
            self._check_name(name)
            numbers = self._numbers.get(name, ())
            self._check_mesh(mesh, numbers)
            number = min(numbers, default=(self._numbered,))
            self._remove(name)
            self._put(mesh, number)
        return self

    def remove(self, name):
        """Removes everything with a name: meshes, organs, files, detectors and sources.

        Raises
        ------
        InputError
            If nothing has this name.
        """
        with self._lock.to_change():
            self._check_name(name)
            self._remove(name)
        return self

    def _mesh(self, vertices, faces, organ, material, name, *others):
        """A mesh that later writes to the arrays don't change."""
        where = f"{self._name}: mesh {self._numbered + 1}"
        mesh = mesh_arrays(where, vertices, faces, organ, material, name, *others)
        mesh["vertices"] = owned(mesh["vertices"], vertices)
        mesh["faces"] = owned(mesh["faces"], faces)
        mesh["name"] = name if isinstance(name, str) else None
        mesh["digest"] = digest(mesh)
        return mesh

    def _check_mesh(self, mesh, replaced):
        """Refuses a faulty mesh, and ids of meshes that are not replaced: those of other numbers."""
        later = set()
        if "geometry" in self._table or not {"material", "material_file"} & self._table.keys():
            # Files may define materials, and scenes may get theirs later.
            later = set(mesh["materials"])
        if self._frame is None or not later <= self._known:
            materials = self._table.get("material", [])
            later |= self._known if self._frame is not None else set()
            later -= {m.get("name") for m in materials}
            assumed = [{"name": name, "reflectance": 0} for name in sorted(later)]
            self._frame = self._frame_of([*materials, *assumed])
            self._known = {m.get("name") for m in [*materials, *assumed]}
        self._frame.check(mesh)
        double = [id for id in ids_of(mesh) if self._ids.get(id) not in (None, *replaced)]
        if double:
            raise input_error(
                mesh["where"],
                f"an earlier mesh has an organ with the id {min(double)}",
                "ids must be unique",
                "use other ids, or replace that mesh by its name",
            )

    def _put(self, mesh, number):
        self._meshes[number] = mesh
        if mesh["name"] is not None:
            self._numbers.setdefault(mesh["name"], set()).add(number)
        self._ids.update(dict.fromkeys(ids_of(mesh), number))
        self._marks.update(marks_of("mesh", mesh))
        self._numbered += 1
        self._built = None

    def _mesh_list(self):
        """The meshes in their order."""
        return [self._meshes[number] for number in sorted(self._meshes)]

    def _frame_of(self, materials):
        """Materials, checked, for meshes to be checked against."""
        table = {key: self._table[key] for key in FRAME_KEYS if key in self._table}
        return _core.Frame(self._document_of({**table, "material": materials}))

    def _check_name(self, name):
        if ("name", name) not in self._marks:
            names = {mark[1] for mark in self._marks if mark[0] == "name"}
            near = difflib.get_close_matches(str(name), names, 1)
            raise input_error(
                self._name,
                f"nothing has the name {name!r}",
                "" if names else "there are no names",
                f"did you mean {near[0]!r}?" if near else "",
            )

    def _remove(self, name):
        for number in list(self._numbers.get(name, ())):
            self._take(number)
        for key in _LISTS if ("name", name) in self._marks else ():
            entries = self._table.get(key, [])
            left = [entry for entry in entries if entry.get("name") != name]
            if len(left) < len(entries):
                self._set(key, left)
            for entry in entries:
                if entry.get("name") == name:
                    self._unmark(key, entry)
        self._built = None

    def _take(self, number):
        """Removes the mesh of a number."""
        mesh = self._meshes.pop(number)
        if mesh["name"] is not None:
            self._numbers[mesh["name"]].remove(number)
        for id in ids_of(mesh):
            del self._ids[id]
        self._unmark("mesh", mesh)
        self._built = None

    def _unmark(self, key, entry):
        for mark in marks_of(key, entry):
            self._marks[mark] -= 1
            if not self._marks[mark]:
                del self._marks[mark]

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

    def add_organ(self, shape, *, material, **keys):
        """Adds an organ with a parametric shape: triangle, rhombus, polygon, bezier, cylinder, disk, ...

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

    # Building and running.

    def build(self):
        """Builds and checks the scene, if that has not been done.

        Returns
        -------
        Organs
            The organs of the results.

        Raises
        ------
        InputError
            With all errors.
        """
        if self._built is None:
            with self._lock:
                self._build()
        return self._organs

    def _build(self):
        """The same where the lock is held."""
        if self._built is None:
            # A scene that was built before is being edited.
            overlaps = None if self._organs is None else self._overlaps
            built = self._whole_document().build(self._mesh_list(), overlaps)
            self._organs = Organs(built)
            self._built = built
            warn_here(built.warnings)
        return self._organs

    def _whole_document(self):
        table = numbered(self._table, self._meshes.values())
        if self._document is not None and table is self._table:
            return self._document
        return self._document_of(table)

    def _document_of(self, table):
        folder = os.getcwd() if self._folder is None else self._folder
        return _core.Document(table, self._name, folder)

    @property
    def organs(self):
        """The organs of the results, which can be edited: SceneOrgans. The scene is built if they are read."""
        return SceneOrgans(self)

    @property
    def warnings(self):
        """Possible problems of the scene: list of str. Builds the scene."""
        self.build()
        return self._built.warnings

    def __repr__(self):
        bands = ", ".join(self._bands)
        meshes = self._meshes.values()
        if self._built is None:
            entries = len(self._table.get("organ", [])) + len(self._table.get("geometry", []))
            parts = [f"{len(meshes)} meshes"] * bool(meshes) + [f"{entries} shapes or files"] * bool(entries)
            return f"<Scene {self._name!r}: {', '.join(parts) or 'empty'}; {bands}; not built>"
        count = self._organs.triangle_count
        return (
            f"<Scene {self._name!r}: {len(self._organs)} organs, {count:,} triangles; {bands}; "
            f"{len(self._built.warnings) or 'no'} warnings>"
        )

    @property
    def _bands(self):
        names = self._table.get("bands") or [band["name"] for band in self._table.get("band", [])]
        return [names] if isinstance(names, str) else list(names)


def _with_entry(entries, same, entry):
    """The entries with one instead of an earlier one, or at the end."""
    if not same:
        return [*entries, entry]
    return [entry if i == same[0] else e for i, e in enumerate(entries) if i not in same[1:]]


def _materials_in(entry):
    """The names of materials in an organ or a file."""
    several = entry.get("materials") or {}
    return {entry.get("material"), *(several.values() if isinstance(several, Mapping) else several)}


def _restored(table, name, folder, meshes, numbers, ids, numbered, marks):
    """A pickled scene."""
    scene = Scene.__new__(Scene)
    scene._init(table, name, folder)
    scene._meshes, scene._numbers, scene._ids = meshes, numbers, ids
    scene._numbered, scene._marks = numbered, marks
    return scene


def load(path):
    """Reads a scene from a run file.

    The scene has the organs, sources, time steps and options of the file; arguments of ``run``
    replace them. ``[output]`` is ignored.

    Parameters
    ----------
    path : str or path

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        With the errors of the scene, or else those of the light, each with its line.
    """
    document = _core.Document.read(os.fspath(path))
    scene = Scene._of_document(document)
    scene.build()
    _core.Light(document, scene._built)  # checks what the file says of it
    return scene
