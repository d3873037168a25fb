"""Growth: organs that are added, changed and removed between the steps of a simulation."""

from __future__ import annotations

import numbers

import numpy as np

from . import _core
from ._lock import OneAtATime
from ._meshes import integers, mesh_arrays
from ._progress import Listener
from .organs import Organs
from .result import Result
from ._runs import largest_sums
from ._warn import warn_here, warn_of_stop


class GrowthSession:
    """The light of a growing canopy, step by step.

    Each step passes only the changes, and its result has the same bits as a single run of the same organs in
    the same order. Between steps the session keeps the organs; the scene, if no organ changed; and the
    acceleration structure, if no triangle changed. After a change of triangles both are rebuilt in time
    proportional to the number of triangles; overlaps are searched near the changed triangles only.

    Parameters
    ----------
    scene : Scene
        Bands, materials, sources, ground, cell, and organs that never change: they come first.
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
        """Appends organs; the arguments are those of `Scene.add_mesh`.

        The arrays are copied.

        Returns
        -------
        list of int
            The ids of the organs, ascending: those in `organ`, or one that neither the session nor
            its scene ever had.

        Raises
        ------
        InputError
            If the session or its scene has an organ with one of the ids, or an organ is invalid;
            no organ is added then.
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
        """Replaces organs by others with the same ids; the order stays.

        Raises
        ------
        InputError
            If the session has no such organ, or an organ is invalid; none is changed then.
        """
        mesh = mesh_arrays(
            "change", vertices, faces, organ, material, name, labels, measured, field_of_view_deg
        )
        with self._lock:
            self._core.change(mesh)

    def remove(self, organ):
        """Removes the organs with one or several ids.

        Raises
        ------
        InputError
            If the session has no such organ; none is removed then.
        """
        ids = integers("remove", "organ", np.atleast_1d(organ))
        with self._lock:
            self._core.remove(ids.tolist())

    def __contains__(self, organ):
        """Whether the session has an organ with this id; those of its scene do not count."""
        is_id = isinstance(organ, numbers.Integral) and -(2**63) <= organ < 2**63
        return is_id and self._core.has(int(organ))

    def __len__(self):
        """Number of organs of the session; those of its scene do not count."""
        return self._core.size

    def update_scene(self):
        """Applies changes of the session's scene: materials, ground, ...

        Raises
        ------
        InputError
            If an organ of the scene now has the id of one of the session; nothing is applied.
        """
        with self._lock:
            self._core.set_frame(self._scene._whole_document(), self._scene._mesh_list())

    def run(self, sources=None, *, progress=None, keep="auto", **options):
        """Computes the light of this step; the arguments are those of `Scene.run`.

        Warnings are as those of `Scene.run`: the scene is checked once after each change, in time
        proportional to the number of triangles.

        Returns
        -------
        Result
            ``result.at(ids)`` gives the light of some organs in the given order.
        """
        with self._lock:
            builds = self._core.scene_builds
            built = self._core.scene()
            if self._core.scene_builds > builds:
                warn_here(built.warnings)
            light = self._scene._light(built, sources, None, options)
            warn_here(light.warnings)
            with Listener(progress) as listener:
                core, replicates = self._core.run(light, largest_sums(keep), listener.callback)
        result = Result(
            core,
            Organs(built),
            [*built.warnings, *light.warnings],
            light.source_notes,
            light.ratio_names,
            replicates,
        )
        warn_of_stop(result.run.stop)
        return result

    @property
    def scene_builds(self):
        """How often the scene was built."""
        return self._core.scene_builds

    @property
    def tree_builds(self):
        """How often the acceleration structure was built."""
        return self._core.tree_builds
