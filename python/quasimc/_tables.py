"""The tables of a scene, as in a run file."""

from __future__ import annotations

#: Keys of a document that say what light falls on.
SCENE_KEYS = ("material", "organ", "geometry", "ground", "cell", "sensors", "detector")

#: Keys of a document by which materials and meshes are checked.
FRAME_KEYS = (
    "bands", "band", "irradiance_unit", "length_unit", "up", "north", "material", "material_file",
)


def numbered(table, meshes):
    """The table with ids for the organs of shapes that have none, beyond those that are given.

    They come before the organs of meshes, and would else be numbered from 1.
    """
    organs = table.get("organ", [])
    given = [int(mesh["ids"].max()) for mesh in meshes if mesh["ids"] is not None]
    if not given or all("id" in organ for organ in organs):
        return table
    largest = max([*given, *(organ["id"] for organ in organs if "id" in organ), 0])
    numbered = []
    for organ in organs:
        if "id" not in organ:
            largest += 1
            organ = {"id": largest, **organ}
        numbered.append(organ)
    return {**table, "organ": numbered}
