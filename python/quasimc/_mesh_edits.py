"""Changes of single organs of meshes. Meshes are dicts as `mesh_arrays` makes them, and never change."""

from __future__ import annotations

import numpy as np

from ._meshes import digest, input_error


def with_digest(mesh):
    """The mesh with the digest of its other entries."""
    others = {key: value for key, value in mesh.items() if key != "digest"}
    return {**others, "digest": digest(others)}


def organ_count(mesh):
    """Number of organs of a mesh."""
    return len(mesh["starts"]) - 1


def corners_of(mesh, rows):
    """The corners of faces, (faces, 3, 3)."""
    faces = mesh["faces"]
    if faces is None:
        return mesh["vertices"].reshape(-1, 3, 3)[rows]
    return mesh["vertices"][faces[rows]]


def organs_from(mesh, first, last):
    """The mesh of the organs from `first` to before `last`, in the order of its results."""
    rows = np.arange(mesh["starts"][first], mesh["starts"][last])
    rows = rows if mesh["order"] is None else mesh["order"][rows]
    materials, of_face = mesh["materials"], mesh["material_of_face"]
    if of_face is not None:
        used, of_face = np.unique(of_face[rows], return_inverse=True)
        materials = [materials[i] for i in used]
        of_face = of_face.astype(np.uint32) if len(used) > 1 else None
    return with_digest(
        {
            **mesh,
            "vertices": np.ascontiguousarray(corners_of(mesh, rows).reshape(-1, 3)),
            "faces": None,
            "order": None,
            "starts": mesh["starts"][first : last + 1] - mesh["starts"][first],
            "ids": None if mesh["ids"] is None else mesh["ids"][first:last],
            "materials": materials,
            "material_of_face": of_face,
            "names": mesh["names"][first:last],
            "labels": [
                (key, values if len(values) == 1 else values[first:last])
                for key, values in mesh["labels"]
            ],
        }
    )


def divided(mesh, changed):
    """The meshes that replace one whose organs change.

    Parameters
    ----------
    changed : dict
        Index of an organ -> the mesh of that organ alone, or None to remove it.
    """
    meshes, first = [], 0
    for index in sorted(changed):
        if index > first:
            meshes.append(organs_from(mesh, first, index))
        if changed[index] is not None:
            meshes.append(changed[index])
        first = index + 1
    if first < organ_count(mesh):
        meshes.append(organs_from(mesh, first, organ_count(mesh)))
    return meshes


def with_triangles(organ, new):
    """An organ with the triangles of another mesh of one organ, and its materials if it has any."""
    has_materials = new["materials"] != [""]
    if not has_materials and organ["material_of_face"] is not None:
        raise input_error(
            new["where"], "the organ has several materials", "", "give the new one: material=..."
        )
    source = new if has_materials else organ
    return with_digest(
        {
            **organ,
            **{key: new[key] for key in ("vertices", "faces", "order", "starts")},
            "materials": source["materials"],
            "material_of_face": source["material_of_face"],
        }
    )


def with_entries(organ, material, labels, name, measured):
    """An organ with another material, labels, name; None: as they are."""
    new = dict(organ)
    if material is not None:
        new.update(materials=[material], material_of_face=None)
    if labels is not None:
        merged = {**dict(organ["labels"]), **{str(key): labels[key] for key in labels}}
        new["labels"] = [
            (key, value if isinstance(value, list) else [str(value)])
            for key, value in merged.items()
            if value is not None
        ]
    if name is not None:
        new.update(names=[name], name=name)
    if measured is not None:
        new["measured"] = bool(measured)
    return with_digest(new)


def moved(organ, scale, rotate, translate):
    """An organ whose vertices are scaled, then rotated, then translated."""
    vertices = organ["vertices"] * float(scale)
    if rotate is not None:
        vertices = vertices @ _rotation(**rotate).T
    vertices = vertices + np.asarray((0, 0, 0) if translate is None else translate, dtype=float)
    return with_digest({**organ, "vertices": np.ascontiguousarray(vertices)})


def _rotation(axis, angle_deg):
    """The matrix of a rotation about an axis through the origin (formula of Rodrigues)."""
    axis = np.asarray(axis, dtype=float)
    x, y, z = axis / np.linalg.norm(axis)
    angle = np.radians(angle_deg)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
