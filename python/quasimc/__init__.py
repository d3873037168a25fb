"""QuasiMC: the light on every organ of a virtual plant, with error bars.

>>> import quasimc
>>> scene = quasimc.Scene("PAR", irradiance_unit="W m-2", length_unit="m")
>>> _ = scene.add_material("leaf", reflectance=0.08, transmittance=0.06)
>>> _ = scene.add_mesh([[0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2]], material="leaf")
>>> result = scene.run(quasimc.sky(irradiance_horizontal=100))
>>> round(float(result["absorbed_flux"]["PAR"].mean[0]), 1)
43.0

See docs/guide/python.md.
"""

from ._core import version as __version__
from ._progress import Progress
from .errors import Error, InputError, QuasimcWarning, Stopped
from .estimates import DetectorResult, Estimate, Estimates
from .grow import GrowthStep, grow
from .growth import GrowthSession
from .organs import Organs
from .parts import SunShade
from .result import Groups, Result, Selection, Series, Sums, quantities
from .scene import Scene, load, options
from .sensors import Sensors
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


def shapes():
    """The shapes of `Scene.add_organ`: list of str."""
    from . import _core

    return _core.shapes()


__all__ = [
    "DetectorResult",
    "Error",
    "Estimate",
    "Estimates",
    "Groups",
    "GrowthSession",
    "GrowthStep",
    "InputError",
    "Organs",
    "Progress",
    "QuasimcWarning",
    "Result",
    "Scene",
    "Selection",
    "Sensors",
    "Series",
    "Source",
    "Stopped",
    "Sums",
    "SunPosition",
    "SunShade",
    "__version__",
    "directional",
    "grow",
    "lamp",
    "load",
    "options",
    "quantities",
    "shapes",
    "sky",
    "sky_models",
    "source_types",
    "sun",
    "sun_day",
    "sun_position",
    "uniform_sky",
]
