"""Light on sensors."""

from __future__ import annotations

import itertools

import numpy as np

from . import _core
from ._optional import needed
from .estimates import Estimates

#: Quantities of flat sensors and of spheres, with those of the core.
_FLAT = {
    name: name
    for name in ("incident_upper", "incident_lower", "incident_direct", "incident_scattered")
}
_SPHERE = {
    "fluence_rate": "incident_upper",  # all light on a sphere is on its upper side
    "incident_direct": "incident_direct",
    "incident_scattered": "incident_scattered",
}


class Sensors:
    """The light on a set of sensors.

    ``result.sensors["bench"]["incident_upper"]["PAR"]`` has the shape of the set: (points,),
    (j, i) for a regular array, the shape of the points of `Scene.add_sensors`, or () for an average.
    Spheres have "fluence_rate" instead of the two sides. Sensors that face up have "transmittance",
    the light from above over that on the horizontal, above a ground or in a periodic cell.

    Attributes
    ----------
    name : str
    names : numpy.ndarray
        Names of the sensors, in the shape of the set.
    positions : numpy.ndarray
        Positions in the axes of the scene: the shape of the set, and 3.
    shape : tuple of int
    """

    def __init__(self, own, rows, light, organs, is_sum=False):
        self.name = own["name"]
        self.shape = own["shape"]
        self.names = np.array(own["names"], dtype=object).reshape(self.shape)
        self.positions = own["positions"].reshape(*self.shape, 3)
        self._of = organs
        self._quantities = _SPHERE if own["is_sphere"] else _FLAT
        self._units = tuple(_core.summed_unit(unit) if is_sum else unit for unit in organs.units)
        self._values = light["values"][rows]
        self._per_horizontal = _per_horizontal(own, light)
        self._origins = {name: part["values"][rows] for name, part in light["origins"].items()}
        self._sunlit_name = "sunlit_hours" if is_sum else "sunlit_fraction"
        sunlit = light[self._sunlit_name]
        self._sunlit = sunlit[rows].reshape(*self.shape, 4) if len(sunlit) else None

    def keys(self):
        """Names of the quantities.

        With directional sources there is sunlit_fraction, in sums of runs with sun_shade="apart"
        sunlit_hours.
        """
        return [
            *self._quantities,
            *(() if self._per_horizontal is None else ("transmittance",)),
            *(() if self._sunlit is None else (self._sunlit_name,)),
        ]

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def __getitem__(self, quantity):
        if quantity not in self.keys():
            known = ", ".join(self.keys())
            raise KeyError(f"there is no quantity {quantity!r}; there are: {known}")
        if quantity == self._sunlit_name:
            unit = "h" if quantity == "sunlit_hours" else ""
            return Estimates(self._sunlit, quantity, unit, extensive=False)
        if quantity == "transmittance":
            return self._transmittance()
        number = list(_core.quantities()).index(self._quantities[quantity])
        origins = {
            name: (
                lambda name=name, values=values: self._estimates(
                    f"{quantity}_from_{name}", values[:, number]
                )
            )
            for name, values in self._origins.items()
        }
        return self._estimates(quantity, self._values[:, number], origins)

    def to_xarray(self):
        """Returns an xarray.Dataset: a variable for each quantity, with the coordinates name, x, y, z.

        Its dimensions are those of the set (point, or j and i), band and statistic; ``_by_origin``
        begins with origin. Statistics are mean, standard_error, ci95_low, ci95_high.
        """
        xarray = needed("xarray")

        variables, coordinates = sensor_variables(self)
        return xarray.Dataset(variables, coordinates)

    def _transmittance(self):
        number = list(_core.quantities()).index("incident_upper")
        values = self._values[:, number] * self._per_horizontal[:, np.newaxis]
        units = ("",) * len(self._units)
        return Estimates(
            self._shaped(values), "transmittance", units, self._of.bands, extensive=False
        )

    def _estimates(self, name, values, origins=None):
        return Estimates(
            self._shaped(values), name, self._units, self._of.bands, origins=origins, extensive=False
        )

    def _shaped(self, values):
        return values.reshape(*self.shape, len(self._units), 4)

    def __repr__(self):
        shape = "x".join(map(str, self.shape)) or "one"
        return f"<Sensors {self.name!r}: {shape}>"


def _per_horizontal(own, light):
    """1 / the irradiance on the horizontal by band, of sensors that would receive it; or None."""
    incident = np.asarray(light["incident"])
    if own["horizontal_area"] is None or not len(incident):
        return None
    return own["horizontal_area"] / np.where(incident > 0, incident, np.nan)


def sensor_variables(sensors, prefix=""):
    """Variables and coordinates of an xarray.Dataset, with the names that the NetCDF file has.

    Parameters
    ----------
    sensors : Sensors
    prefix : str
        Of the names of variables, and of coordinates and dimensions of the set.

    Returns
    -------
    tuple of dict
    """
    ends = {0: (), 1: ("point",), 2: ("j", "i")}[len(sensors.shape)]
    axes = tuple(f"{prefix}{end}" for end in ends)
    statistics = ["mean", "standard_error", "ci95_low", "ci95_high"]
    coordinates = {"band": list(sensors._of.bands), "statistic": statistics}
    coordinates[f"{prefix}name"] = (axes, sensors.names)
    for axis, letter in enumerate("xyz"):
        units = {"units": sensors._of.length_unit}
        coordinates[f"{prefix}{letter}"] = (axes, sensors.positions[..., axis], units)
    variables = {}
    for quantity in sensors.keys():
        light = sensors[quantity]
        attributes = {"units": ", ".join(dict.fromkeys(light._units)) or "1"}
        dimensions = (*axes, *(("band",) if light.bands else ()), "statistic")
        variables[prefix + quantity] = (dimensions, light._values, attributes)
        if light.origins:
            coordinates["origin"] = list(light.origins)
            parts = np.stack([light.origin(name)._values for name in light.origins])
            variables[f"{prefix}{quantity}_by_origin"] = (("origin", *dimensions), parts, attributes)
    return variables, coordinates


def free_sensor_variables(sensors, taken):
    """`sensor_variables` with the name of the set in front, and a number if some are taken.

    Characters of the name that NetCDF does not allow become `_`.
    """
    name = "".join(c if c.isalnum() or ord(c) >= 128 else "_" for c in sensors.name)
    for number in itertools.count(1):
        prefix = f"{name}_" if number == 1 else f"{name}_{number}_"
        variables, coordinates = sensor_variables(sensors, prefix)
        own = {key for key in (*variables, *coordinates) if key.startswith(prefix)}
        if own.isdisjoint(taken):
            return variables, coordinates


class _NotComputed(dict):
    """No sensors, in a result of a scene that has some."""

    def __missing__(self, key):
        raise KeyError(
            f"there is no light on sensors {key!r}: the run was stopped before it was computed"
        )


def sensors_by_name(light, organs, is_sum=False):
    """The sets of sensors by name: dict of `Sensors`.

    Parameters
    ----------
    light : dict or None
        Values of the core; None if they were not computed.
    """
    if light is None and organs.sensor_sets:
        return _NotComputed()
    sets, first = {}, 0
    for own in organs.sensor_sets:
        rows = slice(first, first + len(own["names"]))
        sets[own["name"]] = Sensors(own, rows, light, organs, is_sum)
        first = rows.stop
    return sets
