"""QuasiMC: the light on every organ of a virtual plant, with error bars.

>>> import quasimc
>>> scene = quasimc.Scene("PAR", irradiance_unit="W m-2", length_unit="m")
>>> _ = scene.add_material("leaf", reflectance=0.08, transmittance=0.06)
>>> _ = scene.add_mesh([[0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2]], material="leaf")
>>> result = scene.run(quasimc.sky(irradiance_horizontal=100))
>>> print(f'{result["absorbed_flux"]["PAR"][0]:.1f}')
43.0 ± 0.0 W

See docs/guide/python.md.
"""

from ._core import version as __version__
from ._progress import Progress
from ._store import open_result as open
from .errors import Error, InputError, KeywordError, QuasimcWarning, Stopped
from .control import Control, ControlDay, ControlledLight
from .detectors import DetectorResult
from .estimates import Estimates
from .functions import align, propagate
from .gap_fraction import GapFraction, GapIndices
from .groups import Groups
from .grow import GrowthStep, grow
from ._light import Light, quantities
from .materials import Material, Materials
from .organs import Organs
from .merging import Part, merge
from .pictures import Page, Picture
from .result import GroundLight, Result
from .run_info import RunInfo
from .scene import Scene, load, options
from .scene_organs import SceneOrgans
from .scene_sources import Sources
from .sensors import Sensors
from .series import Series, Sums
from .sun_shade import SunShade
from .sweep import Sweep
from .sources import (
    Source,
    directional,
    lamp,
    sky,
    sky_models,
    source_types,
    sun,
    uniform_sky,
)
from .sun_position import SunPosition, sun_day, sun_position
from .values import Cell, Ground, RunOptions, Site, Time, day, days, times, weather


def __getattr__(name):
    if name == "GrowthSession":
        hint = "edit the organs of a scene between its runs (Scene.add_mesh, Scene.organs)"
        raise AttributeError(f"quasimc has no {name!r}: {hint}")
    raise AttributeError(f"module 'quasimc' has no attribute {name!r}")


def shapes():
    """The shapes of `Scene.add_organ`: list of str."""
    from . import _core

    return _core.shapes()


__all__ = [
    "Control",
    "ControlDay",
    "ControlledLight",
    "Cell",
    "DetectorResult",
    "Error",
    "Estimates",
    "Groups",
    "Ground",
    "GroundLight",
    "GapFraction",
    "GapIndices",
    "GrowthStep",
    "InputError",
    "KeywordError",
    "Light",
    "Material",
    "Materials",
    "Organs",
    "Page",
    "Part",
    "Picture",
    "Progress",
    "QuasimcWarning",
    "Result",
    "RunInfo",
    "RunOptions",
    "Scene",
    "SceneOrgans",
    "Sensors",
    "Series",
    "Site",
    "Source",
    "Sources",
    "Stopped",
    "Sums",
    "SunPosition",
    "SunShade",
    "Sweep",
    "Time",
    "__version__",
    "align",
    "day",
    "days",
    "directional",
    "grow",
    "lamp",
    "load",
    "merge",
    "options",
    "propagate",
    "quantities",
    "shapes",
    "sky",
    "sky_models",
    "source_types",
    "sun",
    "sun_day",
    "sun_position",
    "times",
    "uniform_sky",
    "weather",
]
