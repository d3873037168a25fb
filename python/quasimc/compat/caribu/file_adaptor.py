"""Readers of .can (triangles), .light, .8 (pattern) and .opt (optics) files."""

from __future__ import annotations

import os

from ._errors import CaribuIOError
from .label import Label


def _lines(path):
    """The fields of each line that is neither empty nor a comment, with its number."""
    try:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                fields = line.split("#")[0].split()
                if fields:
                    yield number, fields
    except OSError as error:
        raise CaribuIOError(f"{path}: {error.strerror}") from error


def _numbers(path, line, fields):
    try:
        return [float(field) for field in fields]
    except ValueError as error:
        raise CaribuIOError(f"{path}:{line}: {error}") from error


def read_can(path):
    """The triangles of a .can file: dict, label -> list of triangles of three points."""
    scene = {}
    for line, fields in _lines(path):
        if fields[0] != "p":
            continue
        if len(fields) < 12:
            raise CaribuIOError(f"{path}:{line}: a triangle has a label and 9 coordinates")
        xyz = _numbers(path, line, fields[-9:])
        triangle = [tuple(xyz[3 * i : 3 * i + 3]) for i in range(3)]
        scene.setdefault(fields[2], []).append(triangle)
    return scene


def read_light(path):
    """The lights of a .light file: list of (energy on the horizontal, (dx, dy, dz))."""
    lights = []
    for line, fields in _lines(path):
        numbers = _numbers(path, line, fields)
        if len(numbers) != 4:
            raise CaribuIOError(f"{path}:{line}: a light is energy dx dy dz")
        lights.append((numbers[0], tuple(numbers[1:])))
    return lights


def read_pattern(path):
    """The pattern of a .8 file: (xmin, ymin, xmax, ymax)."""
    numbers = [x for line, fields in _lines(path) for x in _numbers(path, line, fields[:2])]
    if len(numbers) < 4:
        raise CaribuIOError(f"{path}: a pattern is two lines of x y")
    return tuple(numbers[:4])


def read_opt(path):
    """The optics of an .opt file.

    Returns
    -------
    n : int
        Number of species it states.
    soil : float
        Reflectance of the soil.
    species : dict
        1, 2, ... -> (stem reflectance; reflectance and transmittance of the upper side of leaves;
        those of the lower side).
    """
    count, soil, species = 0, 0.0, {}
    for line, fields in _lines(path):
        words = [field for field in fields[1:] if field != "d"]
        numbers = _numbers(path, line, words)
        if fields[0] == "n":
            count = int(numbers[0])
        elif fields[0] == "s":
            soil = numbers[0]
        elif fields[0] == "e":
            if len(numbers) < 5:
                raise CaribuIOError(f"{path}:{line}: a species has five numbers")
            species[len(species) + 1] = tuple(numbers[:5])
    return count, soil, species


def band_of(path):
    """The band that an .opt file is of: its name up to the first dot."""
    return os.path.basename(path).split(".")[0]


def build_materials(labels, species, soil_reflectance=0.15):
    """The material of each label by the optics of its species: list of tuples."""
    materials = []
    for text in labels:
        label = Label(text)
        if label.is_soil():
            materials.append((soil_reflectance,))
            continue
        stem, r_up, t_up, r_low, t_low = species[label.species]
        if label.is_stem():
            materials.append((stem,))
        elif (r_up, t_up) == (r_low, t_low):
            materials.append((r_up, t_up))
        else:
            materials.append((r_up, t_up, r_low, t_low))
    return materials
