"""Results as datasets of xarray, with the names of the NetCDF files."""

from __future__ import annotations

import datetime

import numpy as np

from . import _core
from ._index import as_hashable
from ._light import label_columns
from ._optional import needed
from ._written import combined, run_file_key
from .detectors import detector_variables
from .sensors import free_sensor_variables

_STATISTICS = ["mean", "standard_error", "ci95_low", "ci95_high"]


def result_dataset(result):
    """The Dataset of `Result.to_xarray`."""
    xarray = needed("xarray")

    variables = _light_variables(result, "organ")
    if result._core.sun_shade is not None:
        variables |= _light_variables(result.sun_shade, "organ")
    variables |= _light_variables(result.groups, "group", "group_")
    coordinates = _coordinates(result)
    if result.ratios:
        ratios = np.stack([ratio._values for ratio in result.ratios.values()], axis=1)
        variables["light_ratio"] = (("organ", "ratio", "statistic"), ratios, {"units": "1"})
        coordinates["ratio"] = list(result.ratios)
    dimensions = ("organ", "band", "statistic", "group", "origin", "ratio")
    for key, values in label_columns(result.organs.labels, [*variables, *dimensions]).items():
        coordinates[key] = ("organ", np.asarray(values))
    for name, detector in detector_variables(result.detectors, [*variables, *coordinates]).items():
        variables[name] = detector.to_xarray().rename(bin=f"{name}_bin")
    _add_sensors(result, variables, coordinates)
    return xarray.Dataset(variables, coordinates, {"method": result.run.method})


def series_dataset(series):
    """The Dataset of `Series.to_xarray`."""
    xarray = needed("xarray")

    data = xarray.Dataset()
    if series._results:
        data = _stacked(
            [result_dataset(result) for result in series], "time step", {"time": len(series)}
        ).assign_coords(_times(series.times))
    if series.total_seconds and series.days:
        dates = list(series.days)
        days = [_day_dataset(sums) for sums in series.days.values()]
        data = data.merge(_stacked(days, "day", {"day": len(dates)}).assign_coords(day=dates))
    data.attrs = {"stop": series.stop}
    return data


def sweep_dataset(sweep):
    """The Dataset of `Sweep.to_xarray`."""
    keys = {
        run_file_key(name).replace(".", "_"): [as_hashable(point[name]) for point in sweep.points]
        for name in sweep.points[0]
    }
    single = {key: list(dict.fromkeys(values)) for key, values in keys.items()}
    points = [dict(zip(keys, row)) for row in zip(*keys.values())]
    if combined(single, "product") == points:
        axes = {key: len(values) for key, values in single.items()}
        coordinates = single
    else:
        axes = {"point": len(points)}
        coordinates = {key: ("point", values) for key, values in keys.items()}
    return _stacked([point.to_xarray() for point in sweep], "point", axes).assign_coords(coordinates)


def _attributes(name, light):
    """Units, and the meaning of a quantity."""
    meaning = _core.quantities().get(name, (None,))[0]
    units = ", ".join(dict.fromkeys(light._units)) or "1"
    return {"units": units, **({} if meaning is None else {"long_name": meaning})}


def _light_variables(light, rows, prefix=""):
    """Variables of the quantities of organs or groups. @param light: a Light, Groups or SunShade"""
    variables = {}
    for name in light:
        own = light[name]
        dimensions = (rows, *(("band",) if own.bands else ()), "statistic")
        attributes = _attributes(name, own)
        variables[prefix + name] = (dimensions, own._values, attributes)
        if own.origins:
            parts = np.stack([own.origin(origin)._values for origin in own.origins])
            variables[f"{prefix}{name}_by_origin"] = (("origin", *dimensions), parts, attributes)
    return variables


def _coordinates(light):
    """Organs, bands, statistics, groups and origins of a result or of sums."""
    organs, groups = light._organs, light.groups
    coordinates = {
        "organ": organs.ids,
        "band": list(light.bands),
        "statistic": _STATISTICS,
        "name": ("organ", np.asarray(organs.names)),
        "area": ("organ", organs.areas, {"units": f"{organs.length_unit}2"}),
        "group_by": ("group", [group["by"] for group in groups.groups]),
        "group_value": ("group", [group["value"] for group in groups.groups]),
        "group_area": ("group", groups.areas, {"units": f"{organs.length_unit}2"}),
    }
    if light.origins:
        coordinates["origin"] = list(light.origins)
    return coordinates


def _add_sensors(light, variables, coordinates):
    """Adds the sensors of a result or of sums over a day."""
    for sensors in light.sensors.values():
        more, points = free_sensor_variables(sensors, {*variables, *coordinates})
        variables |= more
        coordinates |= points


def _day_dataset(sums):
    """Sums over a day, by the names of variables in NetCDF files."""
    xarray = needed("xarray")

    variables = _light_variables(sums, "organ")
    variables |= _light_variables(sums.groups, "group", "group_")
    coordinates = _coordinates(sums)
    _add_sensors(sums, variables, coordinates)
    named = {_name_of_day(name): variable for name, variable in variables.items()}
    if sums._parts is not None:
        named |= _day_parts(sums.sun_shade)
    return xarray.Dataset(named, coordinates)


def _name_of_day(name):
    if name.endswith("_transmittance"):
        return f"{name}_day_mean"  # a quotient of sums
    if name.endswith("_sunlit_hours"):
        return name
    end = "_by_origin" if name.endswith("_by_origin") else ""
    return f"{name.removesuffix(end)}_day_sum{end}"


def _day_parts(parts):
    """The light of sunlit and shaded parts over a day: hours, sums of direct light, and means."""
    direct = {row["of_sums"] for row in _core.sun_shade_quantities() if row["is_summed"]}
    return {
        name + ("_day_sum" if name in direct else "_day_mean" if parts[name].bands else ""): variable
        for name, variable in _light_variables(parts, "organ").items()
    }


def _times(times):
    """Coordinates of time steps: their beginning in UTC, and what is known of each."""
    zone = datetime.timezone.utc
    texts = [step["time"] for step in times]
    in_utc = [datetime.datetime.fromisoformat(text).astimezone(zone) for text in texts]
    begin = np.array([time.replace(tzinfo=None) for time in in_utc], "datetime64[ns]")
    of = {key: [step[key] for step in times] for key in ("seconds", "sun_azimuth_deg", "sun_elevation_deg")}
    return {
        "time": ("time", begin, {"long_name": "beginning of the averaging interval, UTC"}),
        "time_text": ("time", texts, {"long_name": "local time with its offset from UTC"}),
        "seconds": ("time", of["seconds"], {"long_name": "duration of the time step", "units": "s"}),
        "sun_azimuth_deg": ("time", of["sun_azimuth_deg"], {"units": "degree"}),
        "sun_elevation_deg": ("time", of["sun_elevation_deg"], {"units": "degree"}),
    }


def _stacked(datasets, what, axes):
    """Datasets of several runs as one.

    Variables that some lack, such as sunlit fractions at night, are NaN there. Coordinates that differ
    get the axes of the runs.

    Parameters
    ----------
    what : str
        What each is, for messages.
    axes : dict
        Name and size of each of the first axes.

    Raises
    ------
    ValueError
        If they have different organs, or other values along an axis.
    """
    xarray = needed("xarray")

    shape = tuple(axes.values())

    def stack(name, known):
        arrays = [
            each[name].values if name in each.variables else np.full(known.shape, np.nan)
            for each in datasets
        ]
        return (*axes, *known.dims), np.stack(arrays).reshape(shape + known.shape), known.attrs

    variables, coordinates = {}, {}
    for each in datasets:
        for name in each.data_vars:
            known = variables.get(name)
            variables[name] = each[name].variable if known is None else known
    for name, known in datasets[0].coords.items():
        if all(name in each.coords and each[name].variable.equals(known.variable) for each in datasets):
            coordinates[name] = known.variable
        elif name in known.dims:
            raise ValueError(f"the {what}s differ along {name!r}: take each alone")
        else:
            coordinates[name] = stack(name, known.variable)
    attributes = {
        key: value
        for key, value in datasets[0].attrs.items()
        if all(each.attrs.get(key) == value for each in datasets)
    }
    stacked = {name: stack(name, known) for name, known in variables.items()}
    return xarray.Dataset(stacked, coordinates, attributes)
