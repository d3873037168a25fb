"""A scene without light: gaps, pictures, objects of other packages."""

from __future__ import annotations

import os

from . import _core
from ._targets import target
from .gap_fraction import LAI_2000_RINGS, measure


class Views:
    """Part of `Scene`."""

    def gap_fraction(
        self, positions, rings_deg=LAI_2000_RINGS, azimuths=8, where="", rays=4096,
        replicates=8, seed=1, threads=0,
    ):
        """Measures the gaps of the canopy as seen upwards from positions in it; needs no light.

        Parameters
        ----------
        positions : array_like
            (3,) or (..., 3), in the axes and the unit of length of the scene.
        rings_deg : sequence of float
            Bounds of rings, degrees from the zenith, ascending within 0 to 90.
        azimuths : int
            Equal sectors of each ring, the first from north clockwise.
        where : str
            Condition on the organs that block the view ("kind == 'leaf'"); "": all.
        rays : int
            For each position and replicate.

        Returns
        -------
        GapFraction

        Raises
        ------
        InputError
            If an argument is outside its domain, or a position below the ground.

        Examples
        --------
        >>> scene.gap_fraction([[0, 0, 0.1]]).all.plant_area_index  # doctest: +SKIP
        """
        self.build()
        keys = {
            "azimuths": azimuths, "where": where, "rays": rays, "replicates": replicates,
            "seed": seed, "threads": threads,
        }
        return measure(self._built, positions, rings_deg, keys)

    def picture(self, path=None, **options):
        """Draws the surfaces, without light, by the program (docs/guide/pictures.md).

        Parameters
        ----------
        path : str or path
            PNG file to write; None: none.
        **options
            Options of `quasimc show`: label="plant" colours organs by a label; camera, size, fov, clip.

        Returns
        -------
        Picture
            A notebook displays it.
        """
        from tempfile import TemporaryDirectory

        from .pictures import draw

        if path is not None:
            target(path)
        organs = self.build()
        with TemporaryDirectory() as folder:
            stored = os.path.join(folder, "scene.json")
            with open(stored, "wb") as file:
                file.write(_core.written_scene(self._written().lit().document(organs)))
            picture = draw(stored, {"geometry_only": "label" not in options, **options})
        if path is not None:
            picture.save(path)
        return picture

    def to_trimesh(self):
        """Returns a trimesh.Trimesh of all organs, with the face attribute "organ": their ids.

        Coordinates are in the axes and the length unit of the scene. The ground is not among them.
        Raises ImportError if trimesh is missing.
        """
        from ._exchange import to_trimesh

        return to_trimesh(self.organs)

    def to_pyvista(self):
        """Returns a pyvista.PolyData of all organs: cells with "organ" (ids), "name", ``label_<key>``.

        Coordinates are in the axes and the length unit of the scene. The ground is not among them.
        Raises ImportError if pyvista is missing.
        """
        from ._exchange import to_pyvista

        return to_pyvista(self.organs)

    def show(self, **options):
        """Shows the picture of the surfaces: in a notebook, or in the browser; see `picture`.

        Returns
        -------
        Picture
        """
        from .pictures import in_notebook, open_picture

        picture = self.picture(**options)
        if not in_notebook():
            open_picture(picture)
        return picture
