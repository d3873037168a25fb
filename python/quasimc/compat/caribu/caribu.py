"""Functions: energy of triangles, in the unit of the scene.

Parameters of all functions
---------------------------
triangles : list of triangles of three points
materials : list of tuples, one for each triangle; of the x_ functions a dict, band -> such a list
    (r,) opaque; (r, t); (r_up, t_up, r_low, t_low).
lights : list of (energy on the horizontal, (dx, dy, dz))
domain : (xmin, ymin, xmax, ymax) of a periodic scene
sensors : list of triangles
    Light on their upper sides is returned; they cast no shadow.
precision : float
    Relative standard error of the light that 95 % of the triangles absorb; default: that of 65536
    paths. Other keywords are options of `quasimc.Scene.run`.

Each returns lists with a number for each triangle: index, label, area, Eabs, Ei, Ei_sup, Ei_inf,
and the standard errors Eabs_se and Ei_se; the x_ functions a dict of these by band.
"""

from __future__ import annotations

import warnings

from ...errors import QuasimcWarning
from ._errors import CaribuError, CaribuIOError, CaribuOptionError, CaribuRunError
from ._trace import TracedScene, as_array

__all__ = [
    "CaribuError",
    "CaribuIOError",
    "CaribuOptionError",
    "CaribuRunError",
    "default_light",
    "green_leaf_PAR",
    "green_stem_PAR",
    "mixed_radiosity",
    "radiosity",
    "raycasting",
    "soil_reflectance_PAR",
    "x_mixed_radiosity",
    "x_radiosity",
    "x_raycasting",
]

green_leaf_PAR = (0.06, 0.07)
green_stem_PAR = (0.13,)
soil_reflectance_PAR = 0.15
default_light = (1, (0, 0, -1))

_warned = False


def warn_of_ignored(**given):
    """Warns once per program of arguments that are ignored."""
    global _warned
    if _warned or not given:
        return
    _warned = True
    warnings.warn(
        f"{', '.join(given)}: ignored; paths of light need neither pixels nor layers; "
        "set precision= for a smaller error",
        QuasimcWarning,
        stacklevel=4,
    )


def options_of(precision, options):
    """Options of a run."""
    if precision is None:
        return options
    if not 0 < precision < 1:
        raise ValueError(f"precision is {precision}: it is a relative error, 0 to 1")
    return {"target_error": precision, **options}


def check_counts(triangles, materials, at_least):
    """The checks of Caribu on numbers of triangles and materials."""
    for of_band in materials.values():
        if len(of_band) != len(triangles):
            raise ValueError(f"{len(triangles)} triangles have {len(of_band)} materials")
    if len(triangles) < at_least:
        raise ValueError(f"radiosity needs {at_least} triangles, there is {len(triangles)}")


def _lists(light, number, areas):
    count = len(areas)
    result = {"index": list(range(count)), "label": [str(i + 1) for i in range(count)]}
    result["area"] = areas.tolist()
    result.update({key: values.tolist() for key, values in light.triangles(number).items()})
    return result


def _sensor_lists(light, first, number, areas):
    ei, error = light.sensors(number)
    return {
        "sensor_id": list(range(len(areas))),
        "Ei": ei.tolist(),
        "Ei0": (ei if first is None else first.sensors(number)[0]).tolist(),
        "Ei_se": error.tolist(),
        "area": areas.tolist(),
    }


def _compute(triangles, materials, lights, domain, ground, sensors, direct, precision, options):
    """The result of an x_ function."""
    triangles = as_array(triangles)
    check_counts(triangles, materials, 1 if direct or ground else 2)
    sensors = None if sensors is None else as_array(sensors)
    traced = TracedScene(triangles, materials, None, domain, ground, sensors)
    traced.warn()
    options = options_of(precision, options)
    light = traced.run(lights, direct, options)
    first = None if direct or sensors is None else traced.run(lights, True, options)
    result = {}
    for number, band in enumerate(materials):
        result[band] = _lists(light, number, traced.areas)
        if sensors is not None:
            result[band]["sensors"] = _sensor_lists(
                light, first, number, traced.sensor_areas
            )
    return result


def x_raycasting(
    triangles,
    materials,
    lights=(default_light,),
    domain=None,
    screen_size=None,
    sensors=None,
    debug=False,
    canfile=None,
    optfile=None,
    *,
    precision=None,
    **options,
):
    """Direct light only, in several bands."""
    _warn_of_size(screen_size)
    return _compute(
        triangles, materials, lights, domain, None, sensors, True, precision, options
    )


def raycasting(triangles, materials, lights=(default_light,), domain=None, *args, **keys):
    """Direct light only."""
    return x_raycasting(triangles, {"band": materials}, lights, domain, *args, **keys)["band"]


def x_radiosity(
    triangles,
    materials,
    lights=(default_light,),
    screen_size=None,
    sensors=None,
    debug=False,
    *,
    precision=None,
    **options,
):
    """All light, of an isolated scene, in several bands."""
    _warn_of_size(screen_size)
    return _compute(
        triangles, materials, lights, None, None, sensors, False, precision, options
    )


def radiosity(triangles, materials, lights=(default_light,), *args, **keys):
    """All light, of an isolated scene."""
    return x_radiosity(triangles, {"band": materials}, lights, *args, **keys)["band"]


def x_mixed_radiosity(
    triangles,
    materials,
    lights,
    domain,
    soil_reflectance,
    diameter=None,
    layers=None,
    height=None,
    sensors=None,
    screen_size=None,
    debug=False,
    *,
    precision=None,
    **options,
):
    """All light, of a periodic scene above a ground, in several bands.

    Diameter, layers and height are ignored: light of all distances is computed.
    """
    _warn_of_size(screen_size)
    if diameter is not None and diameter < 0:
        raise ValueError(f"the diameter is {diameter}: it must not be negative")
    triangles = as_array(triangles)
    level = min(0.0, float(triangles[..., 2].min()))
    ground = (level, [soil_reflectance[band] for band in materials])
    return _compute(
        triangles, materials, lights, domain, ground, sensors, False, precision, options
    )


def mixed_radiosity(
    triangles,
    materials,
    lights,
    domain,
    soil_reflectance,
    diameter=None,
    layers=None,
    height=None,
    screen_size=None,
    sensors=None,
    debug=False,
    **keys,
):
    """All light, of a periodic scene above a ground."""
    return x_mixed_radiosity(
        triangles,
        {"band": materials},
        lights,
        domain,
        {"band": soil_reflectance},
        diameter,
        layers,
        height,
        sensors,
        screen_size,
        debug,
        **keys,
    )["band"]


def _warn_of_size(screen_size):
    if screen_size is not None:
        warn_of_ignored(screen_size=screen_size)
