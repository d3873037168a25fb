"""Triangles, materials and lights of Caribu, computed by quasimc."""

from __future__ import annotations

import math
import re
import warnings

import numpy as np

from ...scene import Scene
from ...sources import directional
from ...values import Cell, Ground
from ..._warn import warn_here
from ...errors import QuasimcWarning
from ._errors import CaribuRunError

#: Coordinates that differ by less are the same, for triangles of no area.
DECIMALS = 6
#: Flag of a side without reported light.
UNRESOLVED = -1.0
SENSOR = "sensor"
#: A triangle in a message: it is an organ, whose id is its number.
_ORGAN = re.compile(r"organ '[^']*' \(id (\d+)\)")


def as_array(triangles):
    """(n, 3, 3) of triangles, each of which is iterated once."""
    corners = [[tuple(point) for point in triangle] for triangle in triangles]
    return np.array(corners, dtype=float).reshape(-1, 3, 3)


def check_finite(triangles, what="triangle"):
    """Refuses triangles of which a coordinate is NaN or infinite. Raises ValueError."""
    faulty = np.flatnonzero(~np.isfinite(triangles).all(axis=(1, 2)))
    if len(faulty):
        raise ValueError(
            f"{what} {faulty[0]} has a corner that is not finite: "
            f"{triangles[faulty[0]].tolist()}"
        )


def areas_of(triangles):
    """Areas; 0 of what is degenerate once coordinates are rounded."""
    rounded = np.round(triangles, DECIMALS)
    sides = rounded[:, 1] - rounded[:, 0], rounded[:, 2] - rounded[:, 0]
    twice = np.linalg.norm(np.cross(*sides), axis=1)
    longest = np.maximum(*(np.sum(side**2, axis=1) for side in sides))
    exact = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return np.where(twice > 1e-9 * longest, np.linalg.norm(exact, axis=1) / 2, 0.0)


def sides_of(material):
    """(r_up, t_up, r_low, t_low) of a material of 1, 2 or 4 numbers."""
    if not isinstance(material, tuple) or len(material) not in (1, 2, 4):
        raise TypeError(f"a material is a tuple of 1, 2 or 4 numbers, not {material!r}")
    if sum(material) <= 0:
        raise ValueError(f"a material must reflect or transmit something, not {material!r}")
    if len(material) == 4:
        return material
    r, t = (*material, 0.0)[:2]
    return (r, t, r, t)


class Materials:
    """The materials of triangles in all bands, each distinct one once."""

    def __init__(self, bands):
        """@param bands: band -> list of tuples, one for each triangle"""
        self.bands = list(bands)
        self.of_triangles = list(zip(*bands.values()))
        self.names = {m: f"material {i}" for i, m in enumerate(dict.fromkeys(self.of_triangles))}

    def state(self, scene):
        """Adds them to a scene."""
        for material, name in self.names.items():
            sides = [sides_of(of_band) for of_band in material]
            up = {"reflectance": [s[0] for s in sides], "transmittance": [s[1] for s in sides]}
            low = {"reflectance": [s[2] for s in sides], "transmittance": [s[3] for s in sides]}
            scene.add_material(name, upper=up, lower=low)

    def key(self):
        return tuple(self.bands), tuple(self.of_triangles)


def sources_of(lights):
    """Parallel light of lights, whose energy is on the horizontal.

    Horizontal light, and light from below, lights nothing, as in Caribu.
    """
    sources = []
    for energy, direction in lights:
        x, y, z = (float(c) for c in direction)
        size = math.sqrt(x * x + y * y + z * z)
        if size == 0 or (x == 0 and y == 0 and z > 0):
            raise CaribuRunError(f"light can't travel along {tuple(direction)!r}")
        if energy < 0:
            raise ValueError(f"the energy of a light is {energy}: it must not be negative")
        if z < 0 and energy > 0:
            facing = energy * size / -z
            sources.append(directional(direction=[x, y, z], irradiance_facing=facing))
    return sources


class TracedScene:
    """Triangles with materials, ready for lights.

    Parameters
    ----------
    triangles : numpy.ndarray
        (n, 3, 3).
    materials : dict
        Band -> list of tuples.
    groups : list
        What each triangle belongs to, for errors of sums; or None.
    domain : tuple
        (xmin, ymin, xmax, ymax) of a periodic scene; or None.
    ground : tuple
        Height, and reflectance by band; or None.
    sensors : numpy.ndarray
        (k, 3, 3), which let light pass; or None.
    """

    def __init__(self, triangles, materials, groups=None, domain=None, ground=None, sensors=None):
        check_finite(triangles)
        if sensors is not None:
            check_finite(sensors, "sensor")
        self.areas = areas_of(triangles)
        self.materials = Materials(materials)
        self.sensor_areas = np.zeros(0) if sensors is None else areas_of(sensors)
        self._lit = np.flatnonzero(self.areas > 0)
        self._lit_sensors = np.flatnonzero(self.sensor_areas > 0)
        self._groups = groups
        self._scene = self._make(triangles, domain, ground, sensors) if len(self._lit) else None

    def _make(self, triangles, domain, ground, sensors):
        scene = Scene(list(self.materials.bands))
        self.materials.state(scene)
        names = [self.materials.names[self.materials.of_triangles[i]] for i in self._lit]
        labels = {} if self._groups is None else {"pid": [self._groups[i] for i in self._lit]}
        scene.add_mesh(triangles[self._lit], material=names, organ=self._lit, labels=labels)
        if len(self._lit_sensors):
            scene.add_material(
                SENSOR, reflectance=0, transmittance=1, transmission_model="mirror"
            )
            ids = len(triangles) + self._lit_sensors
            scene.add_mesh(sensors[self._lit_sensors], material=SENSOR, organ=ids)
        if ground is not None:
            scene.add_material("ground", reflectance=ground[1])
            scene.ground = Ground("ground", height=ground[0])
        if domain is not None:
            x, y = sorted(domain[::2]), sorted(domain[1::2])
            scene.cell = Cell(x=x, y=y)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", QuasimcWarning)  # `warn` has them in Caribu's words
            scene.build()
        return scene

    def warn(self, pids=None):
        """Warns of problems of the scene, such as triangles that overlap.

        @param pids: the pid of each triangle; None: messages have numbers of triangles
        """
        texts = [] if self._scene is None else self._scene.warnings
        name = lambda match: self._described(int(match[1]), pids)
        # Lengths have the unit of Caribu's scene, which is not that of its results.
        warn_here(_ORGAN.sub(name, text) for text in texts if not text.startswith("length_unit"))

    def _described(self, organ, pids):
        """What an organ of the scene is for Caribu. @param organ: its id"""
        count = len(self.areas)
        if organ >= count + len(self.sensor_areas):
            return "the ground"
        if organ >= count:
            return f"sensor {organ - count}"
        return f"triangle {organ}" if pids is None else f"pid {pids[organ]}"

    def run(self, lights, direct, options):
        """The light of each triangle: Light."""
        sources = sources_of(lights)
        result = None
        if sources and self._scene is not None:
            given = dict(options)
            if direct:
                given["max_depth"] = 1
            if self._groups is not None:
                given["groups"] = ["pid"]
            result = self._scene.run(sources, **given)
        return Light(self, result)


class Light:
    """The result of `TracedScene.run`."""

    def __init__(self, traced, result):
        self._traced = traced
        self._result = result

    def _numbers(self, quantity, number, indices, count, offset=0):
        """Mean and error of a quantity in a band: NaN where a triangle has no area."""
        mean, error = np.full((2, count), np.nan)
        mean[indices] = error[indices] = 0.0
        if self._result is not None:
            rows = np.searchsorted(self._sorted_ids, np.asarray(indices) + offset)
            rows = self._order[rows]
            estimates = self._result[quantity]
            mean[indices] = estimates.values[rows, number]
            error[indices] = np.nan_to_num(estimates.standard_error[rows, number])
        return mean, error

    @property
    def _order(self):
        return np.argsort(self._result.organs.ids, kind="stable")

    @property
    def _sorted_ids(self):
        return np.sort(self._result.organs.ids)

    def triangles(self, number):
        """Of a band: dict of arrays Eabs, Ei, Ei_sup, Ei_inf, Eabs_se and Ei_se."""
        traced = self._traced
        count = len(traced.areas)
        get = lambda quantity: self._numbers(quantity, number, traced._lit, count)
        absorbed, absorbed_se = get("absorbed_flux_density")
        (up, up_se), (low, low_se) = get("incident_upper"), get("incident_lower")
        sides = np.array([sides_of(m[number]) for m in traced.materials.of_triangles])
        light = {
            "Eabs": absorbed,
            "Ei": up + low,
            "Ei_sup": up.copy(),
            "Ei_inf": low.copy(),
            "Eabs_se": absorbed_se,
            "Ei_se": _error_of_incident(absorbed_se, up_se, low_se, sides),
        }
        _set_flags(light, [m[number] for m in traced.materials.of_triangles], traced.areas)
        return light

    def sensors(self, number):
        """Light on the upper side of each sensor triangle in a band, and its error."""
        count = len(self._traced.sensor_areas)
        offset = len(self._traced.areas)
        return self._numbers(
            "incident_upper", number, self._traced._lit_sensors, count, offset
        )

    def group_errors(self, number):
        """Of a band: group -> standard errors (Eabs; both sides of Ei, their larger bound)."""
        if self._result is None:
            return {}
        groups = self._result.groups
        errors = [
            np.nan_to_num(groups[quantity].standard_error[:, number])
            for quantity in ("absorbed_flux", "incident_upper", "incident_lower")
        ]
        return {
            group["value"]: (errors[0][i], group["area"] * (errors[1][i] + errors[2][i]))
            for i, group in enumerate(groups.groups)
            if group["by"] == "pid"
        }


def _error_of_incident(absorbed_se, up_se, low_se, sides):
    """Exact where both sides absorb alike, else the sum of the errors of the sides: a bound."""
    absorptance = 1 - sides[:, 0] - sides[:, 1]
    alike = (absorptance == 1 - sides[:, 2] - sides[:, 3]) & (absorptance > 0)
    return np.where(alike, absorbed_se / np.where(alike, absorptance, 1), up_se + low_se)


def _set_flags(light, materials, areas):
    """Sets the sides whose light Caribu does not report."""
    for i, material in enumerate(materials):
        if areas[i] == 0:
            continue
        r_up, t_up, r_low, t_low = sides_of(material)
        if len(material) == 1:
            light["Ei_sup"][i] = light["Ei"][i]
            light["Ei_inf"][i] = UNRESOLVED
        elif r_up * r_low == t_up * t_low:
            light["Ei_sup"][i] = light["Ei_inf"][i] = UNRESOLVED
