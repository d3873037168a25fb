"""Where light comes from.

Each function states a source, by the keys of ``[[source]]`` in a run file
(docs/reference/run-file.md). An irradiance or a flux is one number for all bands, a list with one for
each, or a dict by the names of bands.
"""

from __future__ import annotations

from . import _core
from ._meshes import plain

LAMPS = ("point", "spot", "rectangle", "disk", "line", "sphere", "ies")


class Source:
    """A source as it is stated: its type and its keys. Checked when a run begins.

    Attributes
    ----------
    type : str
        One of `quasimc.source_types()`.
    keys : dict
        The others, by name.
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
    """The types of sources, with a line on each: dict of str."""
    return dict(_core.sources())


def sky_models():
    """The models of skies, with a line on each: dict of str."""
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
    """Parallel light.

    Parameters
    ----------
    direction : sequence of 3 floats
        In which the light travels; any length. Or
    azimuth_deg, elevation_deg : float
        where it comes from, degrees; azimuth clockwise from north.
    irradiance_facing : float, list or dict
        On a plane that faces the light, in the units of the bands. Or
    irradiance_horizontal : float, list or dict
        on the horizontal.
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
    """The sun, by time or by angles.

    Parameters
    ----------
    time : str or datetime.datetime
        With its time zone, "2024-06-21T12:00:00+02:00"; the scene then needs a site. Or
    azimuth_deg, elevation_deg : float
        where it stands, degrees; azimuth clockwise from north.
    disk : bool
        Whether it is a disk of its true size; otherwise a point.
    irradiance_facing : float, list or dict
        On a plane that faces it, in the units of the bands. Or
    irradiance_horizontal : float, list or dict
        on the horizontal.
    """
    return Source("sun", **locals())


def sky(model="cie_overcast", *, irradiance_horizontal, name=None, **keys):
    """A sky.

    Parameters
    ----------
    model : str
        One of `quasimc.sky_models()`.
    irradiance_horizontal : float, list or dict
        On the horizontal, in the units of the bands.
    **keys
        What the model asks for: time or azimuth_deg and elevation_deg of the sun (default: those of
        the first sun), cie_type, turbidity, direct_normal and diffuse_horizontal, file.
    """
    return Source(
        "sky", model=model, irradiance_horizontal=irradiance_horizontal, name=name, **keys
    )


def uniform_sky(*, irradiance_horizontal, name=None):
    """A sky of the same radiance everywhere.

    Parameters
    ----------
    irradiance_horizontal : float, list or dict
        On the horizontal, in the units of the bands.
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
        What it emits in all: W, umol s-1 or lm, as the bands are in W m-2, umol m-2 s-1 or lx.
        Where bands have different units each states those of its unit, and 0 for the others.
    **keys
        Where it stands and how it shines, in the unit of length: position, aim, along, length,
        width, radius, cone_deg, soft_from_deg, exponent, file, opening; of a line ``from_`` and
        ``to``.
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
