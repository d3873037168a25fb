"""The meshes of a scene."""

from __future__ import annotations

from ._keys import near
from ._meshes import digest, input_error, mesh_arrays, owned
from ._tables import ids_of, marks_of

#: Keys of a document whose entries are added one by one, and may have a name.
LISTS = ("organ", "geometry", "sensors", "detector", "source", "control")


class FreeIds:
    """The ids that organs of meshes without ids get: each the largest so far plus 1."""

    def __init__(self):
        self.ids = set()
        self._largest = 0

    def add(self, mesh):
        given = ids_of(mesh)
        if not given:
            self.ids.add(self._largest + 1)
        self._largest = max([self._largest + (not given), *given])


class SceneMeshes:
    """Part of `Scene`."""

    def add_mesh(
        self, vertices, faces=None, *, material, organ=None, name=None, labels=None, measured=True,
        field_of_view_deg=90.0,
    ):  # fmt: skip
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

        Returns
        -------
        Scene
            This one, so that calls can be chained.

        Raises
        ------
        InputError
            If the mesh is invalid, or an id is taken; the scene stays unchanged.
        """
        with self._lock.to_change():
            others = labels, measured, field_of_view_deg
            mesh = self._mesh(vertices, faces, organ, material, name, *others)
            self._check_mesh(mesh, [])
            self._warn_of_second("mesh", mesh)
            self._put(mesh, (self._numbered,))
        return self

    def add_trimesh(self, mesh, *, material, **keys):
        """Adds the triangles of a trimesh.Trimesh, in the length unit of the scene.

        The face attribute "organ", if there is one, has the ids of organs; `organ` overrides it.
        Other keywords and errors are those of `add_mesh`. Returns the scene.
        """
        from ._exchange import of_trimesh

        vertices, faces, organ = of_trimesh(mesh)
        return self.add_mesh(
            vertices, faces, material=material, organ=keys.pop("organ", organ), **keys
        )

    def add_pyvista(self, mesh, *, material, **keys):
        """Adds the surface of a data set of pyvista, in the length unit of the scene.

        Polygons are divided into triangles. The array of cells "organ", if there is one, has the ids
        of organs; `organ` overrides it. Other keywords and errors are those of `add_mesh`. Returns the
        scene.
        """
        from ._exchange import of_pyvista

        vertices, faces, organ = of_pyvista(mesh)
        return self.add_mesh(
            vertices, faces, material=material, organ=keys.pop("organ", organ), **keys
        )

    def replace(
        self, name, vertices, faces=None, *, material, organ=None, labels=None, measured=True,
        field_of_view_deg=90.0,
    ):  # fmt: skip
        """Replaces everything with a name by a mesh; the arguments are those of `add_mesh`. Returns the scene.

        Raises
        ------
        InputError
            If nothing has this name, or the mesh is invalid; the scene stays unchanged.
        """
        with self._lock.to_change():
            others = labels, measured, field_of_view_deg
            mesh = self._mesh(vertices, faces, organ, material, name, *others)
            self._check_name(name)
            numbers = self._numbers.get(name, ())
            self._check_mesh(mesh, numbers)
            number = min(numbers, default=(self._numbered,))
            self._remove(name)
            self._put(mesh, number)
        return self

    def remove(self, name):
        """Removes everything with a name: meshes, organs, files, detectors and sources. Returns the scene.

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
        ids = ids_of(mesh)
        double = [id for id in ids if self._ids.get(id) not in (None, *replaced)]
        if double:
            raise input_error(
                mesh["where"],
                f"an earlier mesh has an organ with the id {min(double)}",
                "ids must be unique",
                "use other ids, or replace that mesh by its name",
            )
        free = self._free_ids() if ids and not replaced else set()
        double = [id for id in ids if id in free]
        if double:
            raise input_error(
                mesh["where"],
                f"an earlier mesh has the id {min(double)}, the next free one where it was added",
                "it was added without organ=, and ids must be unique",
                "give ids to all meshes, or to none",
            )

    def _free_ids(self):
        """The ids of organs of meshes without any: set. Empty if shapes or files come first."""
        if "organ" in self._table or "geometry" in self._table:
            return set()
        if self._free is None:
            self._free = FreeIds()
            for mesh in self._mesh_list():
                self._free.add(mesh)
        return self._free.ids

    def _put(self, mesh, number):
        self._free = None if number != (self._numbered,) else self._free
        if self._free is not None:
            self._free.add(mesh)
        self._meshes[number] = mesh
        if mesh["name"] is not None:
            self._numbers.setdefault(mesh["name"], set()).add(number)
        self._ids.update(dict.fromkeys(ids_of(mesh), number))
        self._marks.update(marks_of("mesh", mesh))
        self._numbered += 1
        self._built = None

    def _take(self, number):
        """Removes the mesh of a number."""
        mesh = self._meshes.pop(number)
        self._free = None
        if mesh["name"] is not None:
            self._numbers[mesh["name"]].remove(number)
        for id in ids_of(mesh):
            del self._ids[id]
        self._unmark("mesh", mesh)
        self._built = None

    def _mesh_list(self):
        """The meshes in their order."""
        return [self._meshes[number] for number in sorted(self._meshes)]

    def _check_name(self, name):
        if ("name", name) not in self._marks:
            names = {mark[1] for mark in self._marks if mark[0] == "name"}
            raise input_error(
                self._name,
                f"nothing has the name {name!r}",
                "" if names else "there are no names",
                near(name, names),
            )

    def _remove(self, name):
        for number in list(self._numbers.get(name, ())):
            self._take(number)
        for key in LISTS if ("name", name) in self._marks else ():
            entries = self._table.get(key, [])
            left = [entry for entry in entries if entry.get("name") != name]
            if len(left) < len(entries):
                self._set(key, left)
            for entry in entries:
                if entry.get("name") == name:
                    self._unmark(key, entry)
        self._built = None
