"""Scenes."""

from __future__ import annotations

import copy
import os
from collections import Counter
from collections.abc import Mapping

from . import _core
from ._assigned import Assigned, check_assigned
from ._contents import Contents
from ._lock import OneAtATime
from ._meshes import plain
from ._runs import Runs
from ._scene_meshes import LISTS, SceneMeshes
from ._tables import FRAME_KEYS, marks_of, numbered
from ._views import Views
from ._warn import warn_here
from .materials import Materials
from .organs import Organs
from .scene_organs import SceneOrgans


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


class Scene(Assigned, Contents, SceneMeshes, Runs, Views):
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
        Unit of bands without their own unit: "W m-2" (default), "umol m-2 s-1" or "lx"; others are
        names only. Nothing is converted but daylight.
    length_unit : str
        Unit of all coordinates: "m" (default), "cm", "mm" and others; names of no known unit are
        accepted with a warning.
    up : str
        "z" or "y": the axis that points up.
    north : sequence of 3 floats
        Horizontal direction of azimuth 0. Default: y, or x if y is up.
    site : Site
        For the position of the sun.
    title : str
    """

    def __init__(
        self, bands="PAR", *, irradiance_unit=None, length_unit=None, up=None, north=None, site=None,
        title=None,
    ):  # fmt: skip
        given = {
            "title": title, "irradiance_unit": irradiance_unit, "length_unit": length_unit, "up": up,
            "north": north,
        }  # fmt: skip
        given = {key: value for key, value in given.items() if value is not None}
        self._init(plain({**_band_keys(bands), **given}), "scene", None)
        self.site = site

    def __setattr__(self, name, value):
        if type(self) is Scene:  # derived classes have attributes of their own
            check_assigned(self, name)
        super().__setattr__(name, value)

    def _init(self, table, name, folder):
        self._table = table
        self._name = name
        self._folder = folder  # that paths are relative to; None: the current one
        self._meshes = {}  # by ascending numbers, tuples: parts of a mesh share the beginning
        self._numbers = {}  # of the meshes of each name, if they have one
        self._ids = {}  # number of the mesh of each organ that was given an id
        self._free = None  # ids of organs without one; None: unknown
        self._numbered = 0  # meshes that were added so far
        self._document = None  # as it was read, with its lines, as long as nothing is changed
        self._built = None
        self._frame = None  # what meshes are checked against; None: materials were changed
        self._known = set()  # names of materials that the frame has
        self._marks = Counter()  # of all that was added
        self._marks.update(m for key in LISTS for e in table.get(key, []) for m in marks_of(key, e))
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
        given = dict(reflectance=reflectance, transmittance=transmittance, upper=upper, lower=lower)
        given = plain({"name": name, **given, **keys})
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

    def _frame_of(self, materials):
        """Materials, checked, for meshes to be checked against."""
        table = {key: self._table[key] for key in FRAME_KEYS if key in self._table}
        return _core.Frame(self._document_of({**table, "material": materials}))

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
