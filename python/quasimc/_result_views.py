"""Files, pictures and pages of results."""

from __future__ import annotations

import os

from ._targets import target


class ResultViews:
    """Part of `Result`."""

    def save(self, path, **table):
        """Writes the result to a file, in the format of its ending.

        ".json": all, for `quasimc.open` and the program; ".csv": the table of organs; ".nc": NetCDF;
        ".vtp", ".glb", ".ply": the scene with its light for ParaView, Blender and MeshLab. Time steps
        are saved with their series (`Series.save`); the light of a specification (`grow`) can't be saved.

        Parameters
        ----------
        path : str or path
        **table
            For ".csv", another table, with the keys of ``[[table]]`` (docs/reference/csv.md): rows
            ("groups", "sensors", ...), per ("day", "period"), form, where, quantities, bands, origins,
            statistics, digits.

        Returns
        -------
        pathlib.Path

        Raises
        ------
        InputError
            If the ending is unknown, or it is the light of a time step or of a specification.
        FileNotFoundError
            If the folder does not exist.
        """
        from ._store import save

        return save(self, path, table)

    def picture(self, path=None, quantity="absorbed_flux_density", band=None, **options):
        """Draws the scene coloured by its light, by the program (docs/guide/pictures.md).

        Parameters
        ----------
        path : str or path
            PNG file to write; None: none.
        quantity, band : str
            What colours show; default: the absorbed flux density in the first band.
        **options
            Options of `quasimc show`: error=True, camera="top", size=(1200, 900), fov, clip, range,
            colormap, label, minus (a result whose values are subtracted).

        Returns
        -------
        Picture
            A notebook displays it.
        """
        from ._store import json_file
        from .pictures import draw

        if path is not None:
            target(path)
        minus = options.pop("minus", None)
        with json_file(self) as stored:
            options = {"quantity": quantity, "band": band, **options}
            if minus is None:
                picture = draw(stored, options)
            else:
                with json_file(minus) as other:
                    picture = draw(stored, {**options, "minus": other})
        if path is not None:
            picture.save(path)
        return picture

    def report(self, path):
        """Writes one HTML page with the scene to turn and all numbers. Returns its path."""
        from ._program import call
        from ._store import json_file

        path = target(path)
        with json_file(self) as stored:
            call("report", stored, "-o", path)
        return path

    def show(self):
        """Shows the result in 3D: in a notebook in a frame, elsewhere in a browser.

        Returns
        -------
        Page of a notebook, or the address of the page, which this process serves until it ends.
        """
        from tempfile import mkdtemp

        from ._store import text_of
        from .pictures import Page, in_notebook, open_in_browser

        folder = mkdtemp()
        if in_notebook():
            return Page(self.report(os.path.join(folder, "result.html")).read_text("utf-8"))
        path = os.path.join(folder, "result.json")
        with open(path, "wb") as file:
            file.write(text_of(self, "json"))
        return open_in_browser(path)

    @property
    def plot(self):
        """Plots by matplotlib: Plots, with scene, profile, histogram, light_by_index, convergence."""
        from .plotting import Plots

        return Plots(self)
