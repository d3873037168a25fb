"""The tables of a scene, as in a run file."""

from __future__ import annotations

#: Keys of a document that say what light falls on.
SCENE_KEYS = ("material", "organ", "geometry", "ground", "cell", "sensors", "detector")

#: Keys of a document by which materials and meshes are checked.
FRAME_KEYS = (
    "bands", "band", "irradiance_unit", "length_unit", "up", "north", "material", "material_file",
)


def marks_of(key, entry):
    """What is equal in two entries that are the same, or of the same name."""
    if entry.get("name") is not None:
        yield ("name", entry["name"])
    yield (key, entry["digest"] if key == "mesh" else repr(entry))


def ids_of(mesh):
    """The ids that the organs of a mesh were given: list of int."""
    return [] if mesh["ids"] is None else mesh["ids"].tolist()


def numbered(table, meshes):
    """The table with an id for the first organ that has none, beyond all that are given.

    The organs of shapes come before those of meshes, and would else be numbered from 1. Ids of the
    other organs without one follow by themselves, those of copies included.
    """
    organs = table.get("organ", [])
    given = [int(mesh["ids"].max()) for mesh in meshes if mesh["ids"] is not None]
    first = next((i for i, organ in enumerate(organs) if "id" not in organ), None)
    if not given or first is None:
        return table
    largest = max([*given, *(organ["id"] for organ in organs if "id" in organ), 0])
    numbered = [*organs[:first], {"id": largest + 1, **organs[first]}, *organs[first + 1 :]]
    return {**table, "organ": numbered}
