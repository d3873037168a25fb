"""Sources of light.

Each function makes a source with the keys of ``[[source]]`` in a run file
(docs/reference/run-file.md). An irradiance or a flux is one number for all bands, a list with one for
each, or a dict by the names of bands.
"""

from __future__ import annotations

from . import _core
from ._meshes import plain

LAMPS = ("point", "spot", "rectangle", "disk", "line", "sphere", "ies")


class Source:
    """A source: its type and its keys. It is checked when a run begins.

    Attributes
    ----------
    type : str
        One of `quasimc.source_types()`.
    keys : dict
        The other keys, by name.
    """

    __slots__ = ("type", "keys")

    def __init__(self, type, **keys):
        self.type = str(type)
        self.keys = {key: plain(value) for key, value in keys.items() if value is not None}

    def table(self):
        """The table of a run file, as a dict."""
        return {"type": self.type, **self.keys}

    def __repr__(self):
        keys = ", ".join(f"{key}={value!r}" for key, value in self.keys.items())
        return f"Source({self.type!r}{', ' if keys else ''}{keys})"

    def __eq__(self, other):
        return isinstance(other, Source) and self.table() == other.table()

    __hash__ = None


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


def sky(model="cie_overcast", *, irradiance_horizontal, name=None, **keys):
    """A sky.

    Parameters
    ----------
    model : str
        One of `quasimc.sky_models()`.
    irradiance_horizontal : float, list or dict
        Irradiance on the horizontal, in the units of the bands.
    **keys
        Parameters of the model: time, or azimuth_deg and elevation_deg of the sun (default: those of
        the first sun), cie_type, turbidity, direct_normal and diffuse_horizontal, file.
    """
    return Source(
        "sky", model=model, irradiance_horizontal=irradiance_horizontal, name=name, **keys
    )


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
    if "from_" in keys:
        keys["from"] = keys.pop("from_")
    return Source(
        type,
        power=power,
        photon_flux=photon_flux,
        luminous_flux=luminous_flux,
        name=name,
        on_hours=on_hours,
        **keys,
    )
