"""Sources of light.

Each function makes a source with the keys of ``[[source]]`` in a run file
(docs/reference/run-file.md). `Scene.sources` are those of a scene. An irradiance or a flux is one number for all bands, a list with one for
each, or a dict by the names of bands.
"""

from __future__ import annotations

from . import _core
from ._keys import check_source
from .values import Keyed

LAMPS = ("point", "spot", "rectangle", "disk", "line", "sphere", "ies")

#: Types with a function of their name.
_FUNCTIONS = ("directional", "sun", "sky", "uniform_sky")


def _call_of(type):
    """The function that makes sources of a type."""
    return type if type in _FUNCTIONS else "lamp" if type in LAMPS else "Source"


class Source(Keyed):
    """A source: its type and its keys, which never change.

    ``source.irradiance_facing`` reads a key; `replace` makes another source. Raises InputError for a
    name that is not a key of the type; values are checked when a run begins.

    Attributes
    ----------
    type : str
        One of `quasimc.source_types()`.
    """

    __slots__ = ()

    def __init__(self, type, **keys):
        super().__init__(type=str(type), **keys)
        check_source(self._keys, _call_of(str(type)))

    def __repr__(self):
        keys = {"from_" if key == "from" else key: value for key, value in self._keys.items()}
        type = keys.pop("type")
        given = [f"{key}={value!r}" for key, value in keys.items()]
        given = given if type in _FUNCTIONS else [repr(type), *given]
        return f"{_call_of(type)}({', '.join(given)})"


def source_types():
    """Types of sources: dict, name -> one-line description."""
    return dict(_core.sources())


def sky_models():
    """Sky models: dict, name -> one-line description."""
    return dict(_core.skies())


def directional(
    *,
    direction=None,
    azimuth_deg=None,
    elevation_deg=None,
    irradiance_facing=None,
    irradiance_horizontal=None,
    name=None,
    on_hours=None,
):
    """Parallel light from one direction.

    Parameters
    ----------
    direction : sequence of 3 floats
        Direction in which the light travels; any length. Or
    azimuth_deg, elevation_deg : float
        direction towards the source, degrees; azimuth clockwise from north.
    irradiance_facing : float, list or dict
        Irradiance on a plane facing the light, in the units of the bands. Or
    irradiance_horizontal : float, list or dict
        irradiance on the horizontal.
    """
    return Source("directional", **locals())


def sun(
    *,
    time=None,
    azimuth_deg=None,
    elevation_deg=None,
    disk=None,
    irradiance_facing=None,
    irradiance_horizontal=None,
    delta_t_s=None,
    name=None,
):
    """The sun, given by time or by angles.

    Parameters
    ----------
    time : str or datetime.datetime
        With its time zone, "2024-06-21T12:00:00+02:00"; the scene then needs a site. Or
    azimuth_deg, elevation_deg : float
        its position, degrees; azimuth clockwise from north.
    disk : bool
        Whether it is a disk with its real size, or a point.
    irradiance_facing : float, list or dict
        Irradiance on a plane facing it, in the units of the bands. Or
    irradiance_horizontal : float, list or dict
        irradiance on the horizontal.
    """
    return Source("sun", **locals())


def sky(model="cie_overcast", *, irradiance_horizontal=None, name=None, **keys):
    """A sky.

    Parameters
    ----------
    model : str
        One of `quasimc.sky_models()`.
    irradiance_horizontal : float, list or dict
        Irradiance on the horizontal, in the units of the bands; required.
    **keys
        Parameters of the model: time, or azimuth_deg and elevation_deg of the sun (default: those of
        the first sun), cie_type, turbidity, direct_normal and diffuse_horizontal, file.
    """
    given = {"model": model, "irradiance_horizontal": irradiance_horizontal, "name": name, **keys}
    source = Source("sky", **given)
    if irradiance_horizontal is None:
        raise TypeError("sky() needs irradiance_horizontal")
    return source


def uniform_sky(*, irradiance_horizontal, name=None):
    """A sky with the same radiance in all directions.

    Parameters
    ----------
    irradiance_horizontal : float, list or dict
        Irradiance on the horizontal, in the units of the bands.
    """
    return Source("uniform_sky", **locals())


def lamp(
    type,
    *,
    power=None,
    photon_flux=None,
    luminous_flux=None,
    name=None,
    on_hours=None,
    **keys,
):
    """A lamp.

    Parameters
    ----------
    type : str
        "point", "spot", "rectangle", "disk", "line", "sphere" or "ies".
    power, photon_flux, luminous_flux : float, list or dict
        Total flux in W, umol s-1 or lm, for bands in W m-2, umol m-2 s-1 or lx. If bands have
        different units, give the flux of each band in its unit, and 0 for the others.
    **keys
        Geometry and distribution, in the length unit: position, aim, along, length, width, radius,
        cone_deg, soft_from_deg, exponent, file, opening; for a line ``from_`` and ``to``; ``at`` for
        copies.
    """
    keys = {"from" if key == "from_" else key: value for key, value in keys.items()}
    return Source(
        type,
        power=power,
        photon_flux=photon_flux,
        luminous_flux=luminous_flux,
        name=name,
        on_hours=on_hours,
        **keys,
    )
