"""CaribuScene: scene, lights and runs with the interface of Caribu."""

from __future__ import annotations

import math
import numbers
import warnings

import numpy as np

from ..._optional import needed
from ...errors import QuasimcWarning
from . import plantgl_adaptor as adaptor
from ._trace import TracedScene, as_array
from .caribu import check_counts, options_of, warn_of_ignored
from .file_adaptor import band_of, build_materials, read_can, read_light, read_opt, read_pattern


class CaribuTriangleSet:
    """The triangles of a scene: pid -> list of triangles. Read like a dict."""

    def __init__(self, scene):
        self._scene = scene

    def keys(self):
        return self._scene.keys()

    def values(self):
        return self._scene.values()

    def items(self):
        return self._scene.items()

    def __len__(self):
        return len(self._scene)

    def __iter__(self):
        return iter(self._scene)

    def __contains__(self, pid):
        return pid in self._scene

    def __getitem__(self, pid):
        return self._scene[pid]

    def sorted_pids(self):
        """The pids that have triangles, ascending."""
        return sorted(pid for pid, triangles in self._scene.items() if len(triangles))

    def allvalues(self, copied=False):
        """All triangles, pid by pid."""
        return [
            [tuple(point) for point in triangle] if copied else triangle
            for pid in self.sorted_pids()
            for triangle in self._scene[pid]
        ]

    def allids(self):
        """The pid of each triangle."""
        return [pid for pid in self.sorted_pids() for _ in self._scene[pid]]

    def repeat_for_triangles(self, values):
        """A value for each triangle, from a dict by pid."""
        return [values[pid] for pid in self.allids()]

    def getNumberOfTriangles(self, pid):
        return len(self._scene[pid])

    def getBoundingBox(self):
        points = as_array(self.allvalues()).reshape(-1, 3)
        return tuple(points.min(axis=0).tolist()), tuple(points.max(axis=0).tolist())

    def getZmin(self):
        return self.getBoundingBox()[0][2]

    def getZmax(self):
        return self.getBoundingBox()[1][2]

    def triangle_areas(self):
        triangles = as_array(self.allvalues())
        sides = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
        return np.linalg.norm(np.cross(*sides), axis=1) / 2


def _read_scene(scene):
    """Returns a CaribuTriangleSet from any supported scene."""
    if scene is None or isinstance(scene, CaribuTriangleSet):
        return scene
    if isinstance(scene, str):
        return CaribuTriangleSet(read_can(scene))
    if isinstance(scene, dict):
        first = next(iter(scene.values()), None)
        if first is None:
            raise IndexError("the scene has no triangles")
        if not (isinstance(first, list) and isinstance(first[0], list)):
            raise ValueError("a scene is {pid: [triangle, ...]}, a triangle a list of 3 tuples")
        return CaribuTriangleSet(scene)
    if all(hasattr(scene, name) for name in ("allvalues", "allids", "keys")):
        return CaribuTriangleSet({pid: list(scene[pid]) for pid in scene.keys()})
    if adaptor.is_lsystem_pair(scene):
        scene = scene[0].sceneInterpretation(scene[1])
    if adaptor.is_mtg(scene):
        return CaribuTriangleSet(adaptor.mtg_to_cscene(scene))
    if adaptor.is_plantgl_scene(scene):
        return CaribuTriangleSet(adaptor.scene_to_cscene(scene))
    raise ValueError(f"a scene can't be made of a {type(scene).__name__}")


def _read_pattern(pattern):
    if pattern is None:
        return None
    if isinstance(pattern, str):
        return read_pattern(pattern)
    if isinstance(pattern, tuple) and len(pattern) == 2:
        pattern = tuple(x for corner in pattern for x in corner)
    if not isinstance(pattern, tuple) or len(pattern) != 4:
        raise ValueError("a pattern is (xmin, ymin, xmax, ymax), or two corners")
    return pattern


class CaribuScene:
    """A scene with its lights: the interface of Caribu, computed by quasimc.

    Parameters
    ----------
    scene : dict, str, PlantGL scene, MTG, or (L-system, L-string)
        pid -> list of triangles, each a list of three tuples; or a .can file. An L-string of L-Py
        is drawn by its L-system.
    light : list or str
        List of (energy on the horizontal per m2, (dx, dy, dz)), or a .light file. Default: one light
        from the zenith.
    pattern : tuple or str
        (xmin, ymin, xmax, ymax), ((xmin, ymin), (xmax, ymax)), or a .8 file; in the unit of the
        scene.
    opt : dict or list of str
        Band -> material, or band -> {pid: material}; or .opt files, with a .can scene.
    soil_reflectance : dict
        By band; default 0.15.
    soil_mesh : int
        1: two triangles over the pattern, at z_soil; None or -1: none.
    z_soil : float
        Default: the lowest point of the scene; a warning is given if triangles are there, because
        they then receive the light of the soil.
    scene_unit : str
        "mm" to "km".
    debug, filecache
        Ignored.
    """

    default_material = (0.06, 0.07)
    default_soil_reflectance = 0.15
    default_light = (1, (0, 0, -1))
    default_band = "default_band"
    units = {"mm": 1e-3, "cm": 0.01, "dm": 0.1, "m": 1, "dam": 10, "hm": 100, "km": 1000}

    def __init__(
        self,
        scene=None,
        light=None,
        pattern=None,
        opt=None,
        soil_reflectance=None,
        soil_mesh=None,
        z_soil=None,
        scene_unit="m",
        debug=False,
        filecache=True,
    ):
        if scene_unit not in self.units:
            raise ValueError(f"unknown unit {scene_unit!r}; use one of {', '.join(self.units)}")
        self.conv_unit = self.units[scene_unit]
        self.debug = debug
        self.scene = _read_scene(scene)
        self.lightfile = None
        self.setLight([self.default_light] if light is None else light)
        self.pattern = _read_pattern(pattern)
        self._set_optics(opt, soil_reflectance, is_file=isinstance(scene, str))
        self._set_soil(soil_mesh, z_soil)
        self.soil_raw = self.soil_aggregated = None
        self._traced = None, None

    def setLight(self, light):
        """Sets the lights: a list, or a .light file."""
        if isinstance(light, str):
            self.lightfile = light
            light = read_light(light)
        if not isinstance(light, (list, tuple)):
            raise ValueError("light is a list of (energy, (dx, dy, dz))")
        first = light[0]
        if not isinstance(first, tuple) or len(first) != 2 or len(first[1]) != 3:
            raise ValueError("light is a list of (energy, (dx, dy, dz))")
        self.light = list(light)

    def _set_optics(self, opt, soil_reflectance, is_file):
        if opt is None:
            bands = [self.default_band]
            if soil_reflectance is not None:
                bands = list(soil_reflectance.keys())
            self.material = {band: self._for_all(self.default_material) for band in bands}
        elif isinstance(opt, dict):
            self.material = self._given_materials(opt)
        elif isinstance(opt, (list, tuple)) and is_file:
            soil_reflectance = self._read_optics(opt)
        else:
            raise ValueError("opt is a dict by bands; files go with a .can scene")
        if soil_reflectance is None:
            soil_reflectance = {band: self.default_soil_reflectance for band in self.material}
        if not isinstance(soil_reflectance, dict) or len(soil_reflectance) != len(self.material):
            raise ValueError("soil_reflectance is a dict with a number for each band")
        self.soil_reflectance = soil_reflectance

    def _for_all(self, material):
        return {} if self.scene is None else {pid: material for pid in self.scene.keys()}

    def _given_materials(self, opt):
        first = list(opt.values())[0]
        if isinstance(first, tuple):
            return {band: self._for_all(material) for band, material in opt.items()}
        if not isinstance(first, dict):
            raise ValueError("opt is {band: material} or {band: {pid: material}}")
        return dict(opt)

    def _read_optics(self, paths):
        soil, self.material = {}, {}
        for path in paths:
            band = band_of(path)
            _, soil[band], species = read_opt(path)
            pids = list(self.scene.keys())
            self.material[band] = dict(zip(pids, build_materials(pids, species, soil[band])))
        return soil

    def _set_soil(self, soil_mesh, z_soil):
        self.soil = None
        pids = [] if self.scene is None else list(self.scene.keys())
        self.soil_label = -1 if pids and isinstance(pids[0], numbers.Number) else "soil"
        if soil_mesh is None or soil_mesh == -1:
            return
        if soil_mesh > 1:
            raise UserWarning("soil_mesh is 1, or None")
        if self.pattern is None:
            raise ValueError("soil_mesh needs a pattern")
        xs, ys = sorted(self.pattern[::2]), sorted(self.pattern[1::2])
        lowest = 0.0 if self.scene is None else self.scene.getZmin()
        z = lowest if z_soil is None else z_soil
        if z_soil is None and self.scene is not None:
            self._warn_of_triangles_at(lowest)
        a, b = (xs[0], ys[0], z), (xs[1], ys[0], z)
        c, d = (xs[1], ys[1], z), (xs[0], ys[1], z)
        self.soil = [[a, b, c], [a, c, d]]

    def _warn_of_triangles_at(self, height):
        heights = as_array(self.scene.allvalues())[..., 2]
        if np.any(np.all(heights == height, axis=1)):
            warnings.warn(
                f"soil_mesh: z_soil is missing, and the soil at {height:g} overlaps the lowest "
                "triangles, which receive its light; give z_soil",
                QuasimcWarning,
                stacklevel=4,
            )

    # What is known without a run.

    def bbox(self):
        """((xmin, ymin, zmin), (xmax, ymax, zmax)) in the unit of the scene, without the soil."""
        return self.scene.getBoundingBox()

    def triangle_areas(self, convert=True):
        """Areas in m2 (unit of the scene, squared, if not converted), without the soil."""
        return self.scene.triangle_areas() * (self.conv_unit**2 if convert else 1)

    def auto_screen(self, screen_resolution):
        """Number of pixels of a size [m] across the scene, as in Caribu; not used here."""
        low, high = self.bbox()
        return max(2, int(math.dist(low, high) * self.conv_unit / screen_resolution))

    def getIncidentEnergy(self):
        """(Qi, Qem, Einc): energy on the horizontal, across the lights, and on the pattern."""
        qi = sum(energy for energy, _ in self.light)
        qem = sum(
            energy * math.sqrt(sum(x * x for x in along)) / abs(along[2])
            for energy, along in self.light
        )
        return qi, qem, None if self.pattern is None else qi * self._pattern_area()

    def _pattern_area(self):
        x0, y0, x1, y1 = self.pattern
        return abs((x1 - x0) * (y1 - y0)) * self.conv_unit**2

    def getSoilEnergy(self):
        """(Qi, Einc): light on the soil in the first band, per m2 and on the pattern."""
        if self.soil is None:
            raise ValueError("the scene has no soil")
        qi = next(iter(self.soil_aggregated.values()))["Ei"]
        return qi, qi * self._pattern_area()

    # Other forms of the scene.

    def as_primitive(self):
        """The scene as plain lists, the soil, if any, last.

        Returns
        -------
        triangles : list
        groups : list
            The pid of each triangle; `soil_label` of the soil's.
        materials : dict
            Band -> list of materials, one for each triangle.
        bands : list
        albedo : dict
            Band -> reflectance of the soil.
        """
        pids = [] if self.scene is None else self.scene.allids()
        triangles = [] if self.scene is None else self.scene.allvalues()
        soil = self.soil or []
        groups = pids + [self.soil_label] * len(soil)
        bands = list(self.material)
        return triangles + soil, groups, self._materials(pids), bands, dict(self.soil_reflectance)

    def runPeriodise(self):
        """Moves each triangle as a whole so that its centre lies in the pattern.

        The light of an infinite scene does not depend on it. Pids stay as they are, and the scene
        can be run on.

        Returns
        -------
        CaribuScene
            This one.
        """
        if self.pattern is None:
            raise ValueError("runPeriodise needs a pattern")
        if self.scene is not None:
            xs, ys = sorted(self.pattern[::2]), sorted(self.pattern[1::2])
            low, size = (xs[0], ys[0]), (xs[1] - xs[0], ys[1] - ys[0])
            moved = {
                pid: [_moved_into(triangle, low, size) for triangle in triangles]
                for pid, triangles in self.scene.items()
            }
            self.scene = CaribuTriangleSet(moved)
        return self

    # Running.

    def run(
        self,
        direct=True,
        infinite=False,
        d_sphere=None,
        layers=None,
        height=None,
        screen_size=None,
        screen_resolution=None,
        sensors=None,
        split_face=False,
        simplify=False,
        *,
        precision=None,
        **options,
    ):
        """Computes the light.

        Parameters
        ----------
        direct : bool
            Direct light only.
        infinite : bool
            Whether the scene is periodic with the pattern; unless direct, above a ground with
            soil_reflectance.
        d_sphere, layers, height, screen_size, screen_resolution
            Ignored, with one warning: paths of light need neither pixels nor layers.
        sensors : dict
            id -> list of triangles: light on their upper sides; they cast no shadow.
        split_face : bool
            Whether Ei_sup and Ei_inf are returned.
        simplify : bool
            Whether the level of bands is omitted for a single band.
        precision : float
            Relative standard error of the absorbed light of 95 % of the triangles, 0 to 1.
        **options
            Those of `quasimc.Scene.run`: paths, seed, threads, ...

        Returns
        -------
        raw, aggregated : dict
            Band -> quantity -> pid -> list by triangle, and their area-weighted mean. Per m2 and in m2
            for every scene unit. Eabs_se and Ei_se are standard errors.
        """
        if self.scene is None:
            return {}, {}
        self._check(infinite, d_sphere, direct)
        given = {
            "d_sphere": d_sphere,
            "layers": layers,
            "height": height,
            "screen_size": screen_size,
            "screen_resolution": screen_resolution,
        }
        warn_of_ignored(**{key: value for key, value in given.items() if value is not None})
        traced = self._trace(direct, infinite, sensors)
        run_options = options_of(precision, options)
        light = traced.run(self.light, direct, run_options)
        first = None if direct or sensors is None else traced.run(self.light, True, run_options)
        raw, aggregated = {}, {}
        self.soil_raw, self.soil_aggregated = {}, {}
        for number, band in enumerate(self.material):
            raw[band], aggregated[band] = self._band(light, number, split_face)
            if sensors is not None:
                raw[band]["sensors"], aggregated[band]["sensors"] = self._sensors(
                    light, first, number, sensors
                )
        if simplify and len(raw) == 1:
            return next(iter(raw.values())), next(iter(aggregated.values()))
        return raw, aggregated

    def _check(self, infinite, d_sphere, direct):
        if infinite and self.pattern is None:
            raise ValueError("infinite needs a pattern")
        if infinite and not direct and d_sphere is not None and d_sphere < 0:
            raise ValueError(f"d_sphere is {d_sphere}: it must not be negative")

    def _materials(self, pids):
        materials = {}
        for band, of_pid in self.material.items():
            materials[band] = [of_pid[pid] for pid in pids]
            if self.soil is not None:
                materials[band] += [(self.soil_reflectance[band],)] * 2
        return materials

    def _trace(self, direct, infinite, sensors):
        """The scene ready for lights; that of the run before, if nothing else changed."""
        pids = self.scene.allids()
        materials = self._materials(pids)
        triangles = self.scene.allvalues() + (self.soil or [])
        check_counts(triangles, materials, 1 if direct else 2)
        triangles = as_array(triangles)
        virtual = None
        if sensors is not None:
            virtual = as_array([t for of_id in sensors.values() for t in of_id])
        ground = None
        if infinite and not direct and self.soil is None:
            level = min(0.0, float(triangles[..., 2].min()))
            ground = (level, [self.soil_reflectance[band] for band in self.material])
        domain = self.pattern if infinite else None
        key = (
            triangles.tobytes(),
            None if virtual is None else virtual.tobytes(),
            ground and (ground[0], tuple(ground[1])),
            domain,
            tuple((band, tuple(of_band)) for band, of_band in materials.items()),
        )
        if self._traced[0] != key:
            groups = [str(i) for i in _numbers_of(pids)] + ["soil"] * len(self.soil or [])
            self._traced = key, TracedScene(triangles, materials, groups, domain, ground, virtual)
            self._traced[1].warn([*pids, *["soil"] * len(self.soil or [])])
        return self._traced[1]

    def _band(self, light, number, split_face):
        """raw and aggregated of a band; those of the soil are kept."""
        pids = self.scene.sorted_pids()
        values = light.triangles(number)
        if not split_face:
            values = {k: v for k, v in values.items() if k not in ("Ei_sup", "Ei_inf")}
        values["area"] = self._traced[1].areas * self.conv_unit**2
        errors = light.group_errors(number)
        raw = {key: {} for key in values}
        aggregated = {key: {} for key in values}
        begin = 0
        for index, pid in enumerate(pids):
            part = slice(begin, begin + len(self.scene[pid]))
            begin = part.stop
            means = _aggregated(values, part, errors.get(str(index)), self.conv_unit**2)
            for key in values:
                raw[key][pid] = values[key][part].tolist()
                aggregated[key][pid] = means[key]
        if self.soil is not None:
            part, band = slice(begin, None), list(self.material)[number]
            self.soil_raw[band] = {key: values[key][part].tolist() for key in values}
            self.soil_aggregated[band] = _aggregated(
                values, part, errors.get("soil"), self.conv_unit**2
            )
        return raw, aggregated

    def _sensors(self, light, first, number, sensors):
        ei, error = light.sensors(number)
        direct = ei if first is None else first.sensors(number)[0]
        areas = self._traced[1].sensor_areas * self.conv_unit**2
        values = {"Ei": ei, "Ei0": direct, "Ei_se": error, "area": areas}
        raw, aggregated = {key: {} for key in values}, {key: {} for key in values}
        begin = 0
        for sensor, triangles in sensors.items():
            part = slice(begin, begin + len(triangles))
            begin = part.stop
            means = _aggregated(values, part, None, 1)
            for key in values:
                raw[key][sensor] = values[key][part].tolist()
                aggregated[key][sensor] = means[key]
        return raw, aggregated

    def plot(self, a_property=None, minval=None, maxval=None, gamma=None, display=True):
        """Draws the scene by matplotlib, coloured by a property: {pid: float} or {pid: [float]}.

        Returns
        -------
        axes, values
            values: a number from 0 to 1 for each triangle; None without a property.
        """
        pyplot = needed("matplotlib.pyplot")
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        values, colours = None, (0, 180 / 255, 0)
        if a_property is not None:
            values = self._normalized(a_property, minval, maxval, gamma)
            colours = pyplot.get_cmap("jet")(values)
        axes = pyplot.figure().add_subplot(projection="3d")
        triangles = as_array(self.scene.allvalues())
        axes.add_collection3d(Poly3DCollection(triangles, facecolors=colours))
        low, high = self.bbox()
        for axis, from_, to in zip("xyz", low, high):
            axes.set(**{f"{axis}lim": (from_, to if to > from_ else from_ + 1)})
        if display:
            pyplot.show()
        return axes, values

    def _normalized(self, a_property, minval, maxval, gamma):
        values = []
        for pid in self.scene.sorted_pids():
            value, count = a_property.get(pid, math.nan), len(self.scene[pid])
            values += list(value) if isinstance(value, (list, tuple)) else [value] * count
        known = [v for v in values if not math.isnan(v)] or [0.0]
        low = min(known) if minval is None else minval
        high = max(known) if maxval is None else maxval
        scale = (high - low) or 1.0
        power = 1 if gamma is None else gamma
        return [
            0.0 if math.isnan(v) else min(max((v - low) / scale, 0.0), 1.0) ** power for v in values
        ]


def _moved_into(triangle, low, size):
    """The triangle, its centre moved by whole cells to between `low` and `low` + `size`."""
    points = [tuple(point) for point in triangle]
    shift = [
        -size[k] * math.floor((sum(p[k] for p in points) / 3 - low[k]) / size[k]) for k in (0, 1)
    ]
    return [(x + shift[0], y + shift[1], z) for x, y, z in points]


def _numbers_of(pids):
    """Of each triangle the number of its pid."""
    numbers_of, last = [], object()
    for pid in pids:
        if not numbers_of or pid != last:
            numbers_of.append(numbers_of[-1] + 1 if numbers_of else 0)
        else:
            numbers_of.append(numbers_of[-1])
        last = pid
    return numbers_of


def _aggregated(values, part, flux_errors, square_unit):
    """Means weighted by area, and their errors; 0 without area."""
    area = values["area"][part]
    total = float(area.sum())
    lit = area > 0
    result = {
        key: float((of_all[part][lit] * area[lit]).sum() / total) if total > 0 else 0
        for key, of_all in values.items()
    }
    result["area"] = total
    if flux_errors is not None and total > 0:
        # Errors of sums, made replicate by replicate: triangles shade one another.
        absorbed, incident = (e * square_unit / total for e in flux_errors)
        result["Eabs_se"] = float(absorbed)
        result["Ei_se"] = float(min(result["Ei_se"], incident))
    return result
