"""Plants that grow by models in cpfg's language."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping

from . import _core
from ._meshes import input_error
from ._progress import Listener
from .organs import Organs
from .result import Result
from ._warn import warn_here
from .scene import Scene


class GrowthStep:
    """A plant after a derivation step.

    Attributes
    ----------
    step : int
        Derivation steps, from 0.
    string : str
        The string of modules, before it receives light.
    image : str or None
        The string with its homomorphism, if `grow` was called with ``image=True``.
    light : Result, tuple of Result, or None
        The light of this step. With a stand its organs are those of the stand, then one for each
        module of the string that has shapes: the label "module" is the symbol, and the id is the
        index of the module (from 1) plus the largest id of the stand. With a specification its
        organs are the modules that follow queries, and there is one result for each band if bands
        have their own rays. None without shapes, or if the light is not computed here. With a stand it
        can be saved, drawn and opened again as that of `Scene.run`; its file holds stand and plant.
    """

    def __init__(self, core, light):
        self._core = core
        self._organs = None
        self.step = core.step
        self.string = core.string
        self.image = core.image
        self.light = light

    @property
    def organs(self):
        """The shapes of the plant alone: Organs, or None without shapes.

        There is an organ for each module of the string that has shapes; its id is the index of
        the module, from 1. Axes and unit are those of the model: y is up.
        ``organs.triangles(index)`` has the shape (n, 3, 3).
        """
        if self._organs is None:
            drawn = self._core.organs()
            self._organs = None if drawn is None else Organs(drawn)
        return self._organs

    @property
    def scene(self):
        """What the light was computed on: Organs, in the axes of the stand; None without light."""
        return None if self._core.scene is None else Organs(self._core.scene)

    def __repr__(self):
        text = self.string if len(self.string) <= 60 else self.string[:57] + "..."
        return f"<GrowthStep {self.step}: {text}>"


def grow(
    model,
    view=None,
    *,
    light=None,
    sources=None,
    materials=None,
    material=None,
    quantity="absorbed_flux_density",
    steps=None,
    image=False,
    progress=None,
    **options,
):
    """Grows a plant by a model in cpfg's language, step by step.

    Text that the model prints appears on ``sys.stderr``.

    Parameters
    ----------
    model : str or path
        File of the L-system.
    view : str or path
        View file. Default: the file with the model's name and the ending ".v", if there is one.
    light : Scene, str or path
        The light that answers the queries ``?E(x)`` of the model. A Scene, or the path of a run file
        (.toml), is a stand in which the plant grows upright at the origin: all its shapes
        are organs, and the answer is the light on the module that follows, one number for each
        band. Otherwise the path of a specification, or (.e) of an environment file, whose program
        is started. Default: queries keep their values.
    sources : Source or dict, or list of them
        For a stand; default: its own. The irradiance is that of each step.
    materials : dict
        For a stand: symbol of a module -> name of its material. Other modules have the material
        whose name is their symbol, if there is one, or else `material`.
    material : str
        For a stand; default: its first material.
    quantity : str
        For a stand: the answer to queries, one of `quasimc.quantities()`, in its unit.
    steps : int
        Derivation steps. Default: those of the model.
    image : bool
        Whether steps have the homomorphic image.
    progress : bool or callable
        For a stand: as in `Scene.run`, for each step.
    **options
        For a stand: run options as in `Scene.run`. Each step adds 1 to ``seed``.

    Returns
    -------
    iterator of GrowthStep
        Step 0 is the axiom. Each step has its own light; the next one is derived from it before
        this one is returned.

    Raises
    ------
    InputError
        With all errors of the model, at the call; with errors of a step, during the iteration.
    Stopped
        If max_seconds passed before there was a result.
    KeyboardInterrupt
        If Ctrl-C was pressed; the iteration ends.
    """
    chosen = _environment(light)
    written = None
    if "stand" in chosen:
        written = chosen["stand"]._written(sources, None, options)
        chosen["stand"] = _stand(chosen["stand"], sources, materials, material, quantity, options)
    elif any(v is not None for v in (sources, materials, material)) or options:
        raise input_error(
            "grow",
            "sources, materials or run options are given without a stand",
            "",
            "pass a Scene as `light`",
        )
    model = os.fspath(model)
    steps = -1 if steps is None else _count(steps)
    core = _core.GrowingPlant(model, _view(model, view), steps, bool(image), chosen)
    return _steps(core, progress, written)


def _view(model, view):
    """The path of the view file, or ""."""
    if view is not None:
        return os.fspath(view)
    usual = os.path.splitext(model)[0] + ".v"
    return usual if os.path.exists(usual) else ""


def _count(steps):
    if isinstance(steps, bool) or not isinstance(steps, int) or steps < 0:
        raise input_error("grow", f"steps is {steps!r}", "it must be a whole number, 0 or more", "")
    return steps


def _environment(light):
    """The kind of the light, and its file or scene."""
    if light is None:
        return {}
    if isinstance(light, Scene):
        return {"stand": light}
    path = os.fspath(light)
    ending = os.path.splitext(path)[1].lower()
    if ending == ".toml":
        return {"stand": Scene._of_document(_core.Document.read(path))}
    return {"program" if ending == ".e" else "specification": path}


def _stand(scene, sources, materials, material, quantity, options):
    if materials is not None and not isinstance(materials, Mapping):
        raise input_error("grow", "materials is not a dict", "", "use the symbols of modules as its keys")
    materials = dict(materials or {})
    for symbol in materials:
        if not isinstance(symbol, str) or len(symbol.encode()) != 1:
            raise input_error(
                "grow",
                f"{symbol!r} is not the symbol of a module",
                "symbols have one character",
                "",
            )
    return _core.PlantStand(
        scene._whole_document(),
        scene._mesh_list(),
        scene._light_document(sources, None, options),
        materials,
        material or "",
        quantity,
    )


def _steps(core, progress, written):
    reported = set()
    _report(core, reported)
    try:
        while True:
            with Listener(progress) as listener:
                try:
                    step = core.next(listener.callback)
                finally:
                    _report(core, reported)
            if step is None:
                return
            yield _step_of(step, reported, written)
    finally:
        core.close()
        _report(core, reported)


def _report(core, reported):
    """Passes on what the model printed, and new warnings."""
    sys.stderr.write(core.take_printed())
    _warn_new(core.take_notices(), reported)


def _warn_new(texts, reported):
    new = [text for text in dict.fromkeys(texts) if text not in reported]
    reported.update(new)
    warn_here(new)


def _step_of(core, reported, written):
    results = core.results
    if core.scene is None or not results:
        return GrowthStep(core, None)
    built = core.scene
    _warn_new(built.warnings, reported)

    def result_of(result, organs, own=None):
        others = built.warnings, core.source_notes, core.ratio_names
        return Result(result, organs, *others, written=own)

    if len(results) == 1:
        own = None if written is None else written.with_plant(Organs(built), core.plant_organs, core.step)
        light = result_of(results[0], Organs(built), own) if results[0] is not None else None
        return GrowthStep(core, light)
    light = []
    for (name, unit), result in zip(core.bands, results):
        organs = Organs(built)
        organs.bands, organs.units = (name,), (unit,)
        light.append(None if result is None else result_of(result, organs))
    return GrowthStep(core, tuple(light))
