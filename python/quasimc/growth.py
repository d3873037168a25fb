"""Growth: organs that come, change and go between the steps of a simulation."""

from __future__ import annotations

import numbers

import numpy as np

from . import _core
from ._lock import OneAtATime
from ._meshes import integers, mesh_arrays
from ._progress import Listener
from .organs import Organs
from .result import Result
from .scene import _OF_SCENE, _warn


class GrowthSession:
    """The light of a growing canopy, step by step.

    A step states what changes alone, and its result is bit for bit that of a single run for the
    same organs in the same order. Between steps these are kept: the organs; the scene, if no organ
    changed; the acceleration structure for rays, if no triangle changed. When some triangle changed
    both are built anew, in time in proportion to all triangles; triangles that lie on each other,
    which takes longest to find, are looked for near those that changed.

    Parameters
    ----------
    scene : Scene
        Bands, materials, sources, ground, cell, and organs that stay as they are: they come first.
        It may have no organs.
    """

    def __init__(self, scene):
        self._scene = scene
        self._core = _core.GrowthSession(scene._whole_document(), scene._mesh_list())
        self._lock = OneAtATime()

    def add(
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
        """Adds organs behind the others; the arguments are those of `Scene.add_mesh`.

        The arrays are copied.

        Returns
        -------
        list of int
            The ids of the organs, ascending: those in `organ`, or one that neither the session nor
            its scene ever had.

        Raises
        ------
        InputError
            If the session or its scene has an organ of such an id, or one of these is faulty; no
            organ is added then.
        """
        mesh = mesh_arrays(
            "add", vertices, faces, organ, material, name, labels, measured, field_of_view_deg
        )
        with self._lock:
            return self._core.add(mesh)

    def change(
        self,
        vertices,
        faces=None,
        *,
        material,
        organ,
        name=None,
        labels=None,
        measured=True,
        field_of_view_deg=90.0,
    ):
        """Replaces organs by others of the same ids, in their places.

        Raises
        ------
        InputError
            If the session has no such organ, or one of these is faulty; none is changed then.
        """
        mesh = mesh_arrays(
            "change", vertices, faces, organ, material, name, labels, measured, field_of_view_deg
        )
        with self._lock:
            self._core.change(mesh)

    def remove(self, organ):
        """Removes the organ of an id, or those of several.

        Raises
        ------
        InputError
            If the session has no such organ; none is removed then.
        """
        ids = integers("remove", "organ", np.atleast_1d(organ))
        with self._lock:
            self._core.remove(ids.tolist())

    def __contains__(self, organ):
        """Whether an organ of this id was added and not removed; those of the scene do not count."""
        is_id = isinstance(organ, numbers.Integral) and -(2**63) <= organ < 2**63
        return is_id and self._core.has(int(organ))

    def __len__(self):
        """How many organs were added and not removed; those of the scene do not count."""
        return self._core.size

    def update_scene(self):
        """Takes over what was changed in the scene of the session: materials, ground, ...

        Raises
        ------
        InputError
            If an organ of the scene now has the id of one of the session; nothing is taken over.
        """
        with self._lock:
            self._core.set_frame(self._scene._whole_document(), self._scene._mesh_list())

    def run(self, sources=None, *, progress=None, **options):
        """Computes the light of this step; the arguments are those of `Scene.run`.

        What is allowed but probably not meant is told as by `Scene.run`: a scene is looked through
        once after each change, in time in proportion to all triangles.

        Returns
        -------
        Result
            ``result.select(ids)`` gives the light of some organs in the order asked.
        """
        with self._lock:
            builds = self._core.scene_builds
            built = self._core.scene()
            if self._core.scene_builds > builds:
                _warn(built.warnings)
            light = self._scene._light(built, sources, _OF_SCENE, options)
            if light.has_times:
                raise ValueError("a step has no times: give it sources, or use Scene.run")
            _warn(light.warnings)
            with Listener(progress) as listener:
                core = self._core.run(light, listener.callback)
        result = Result(
            core,
            Organs(built),
            [*built.warnings, *light.warnings],
            light.source_notes,
            light.ratio_names,
        )
        if result.stop == "interrupted":
            _warn(["interrupted: the result is of what was done until then"])
        return result

    @property
    def scene_builds(self):
        """How often a scene had to be put together."""
        return self._core.scene_builds

    @property
    def tree_builds(self):
        """How often an acceleration structure had to be built."""
        return self._core.tree_builds
