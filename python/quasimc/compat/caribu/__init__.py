"""The interface of Caribu (OpenAlea), computed by quasimc: docs/guide/coming-from-other-programs.md.

Change one import of a script: ``from quasimc.compat.caribu.CaribuScene import CaribuScene``.
"""

from . import CaribuScene_nodes, caribu, file_adaptor, label, light, plantgl_adaptor, sky_tools
from .CaribuScene import CaribuScene
from .caribu import (
    CaribuError,
    CaribuIOError,
    CaribuOptionError,
    CaribuRunError,
)
from .light import light_sources

__all__ = [
    "CaribuError",
    "CaribuIOError",
    "CaribuOptionError",
    "CaribuRunError",
    "CaribuScene",
    "CaribuScene_nodes",
    "caribu",
    "file_adaptor",
    "label",
    "light",
    "light_sources",
    "plantgl_adaptor",
    "sky_tools",
]
