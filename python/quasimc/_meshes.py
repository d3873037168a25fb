"""From arrays of numpy to the arrays that quasimc._core reads."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

import numpy as np

from .errors import InputError


def input_error(where, problem, why="", suggestion=""):
    """Returns an InputError with one error, worded as in the library."""
    text = f"{where}: {problem}" + (f" ({why})" if why else "")
    text += f"; {suggestion}" if suggestion else ""
    detail = {"where": where, "problem": problem, "why": why, "suggestion": suggestion}
    return InputError(text, [detail])


def without_mask(where, what, values):
    """The values, of which none may be masked."""
    if np.ma.is_masked(values):
        raise input_error(where, f"some of {what} are masked", "every value is used", "remove them")
    return values


def integers(where, what, values):
    """Values as an array of int64."""
    values = np.asarray(without_mask(where, what, values))
    if values.size == 0:
        return values.astype(np.int64)
    if values.dtype.kind not in "iu":
        raise input_error(where, f"{what} is {values.dtype}", "it must be integers")
    if int(values.max()) > np.iinfo(np.int64).max:
        raise input_error(where, f"{what} is {values.max()}", "the largest integer is 2^63 - 1")
    return values.astype(np.int64, copy=False)


def owned(array, given):
    """An array that the caller can't write to: a copy, unless it was made here."""
    return array if array is None or (array.base is None and array is not given) else array.copy()


def plain(value):
    """A value of a run file, without arrays and other containers of the caller."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value.tolist() if hasattr(value, "tolist") else value


def digest(mesh):
    """A digest of a mesh, equal for equal meshes."""
    marks = hashlib.blake2b(digest_size=16)
    for key, value in mesh.items():
        if isinstance(value, np.ndarray):
            marks.update(f"{key} {value.dtype} {value.shape}".encode())
            marks.update(value)
        elif key != "where":
            marks.update(repr((key, value)).encode("utf-8", "backslashreplace"))
    return marks.hexdigest()


def vertices_and_faces(where, vertices, faces):
    """Vertices (n, 3) float64; faces (m, 3) integers, or None if every three vertices are one."""
    vertices = without_mask(where, "vertices", vertices)
    vertices = np.ascontiguousarray(vertices, dtype=np.float64)
    if faces is None:
        if vertices.ndim != 3 or vertices.shape[1:] != (3, 3):
            raise input_error(
                where,
                f"vertices have the shape {vertices.shape}",
                "without faces they are triangles: (m, 3, 3)",
            )
        return vertices.reshape(-1, 3), None
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise input_error(where, f"vertices have the shape {vertices.shape}", "it must be (n, 3)")
    faces = np.asarray(without_mask(where, "faces", faces))
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu":
        raise input_error(
            where,
            f"faces are {faces.dtype} of the shape {faces.shape}",
            "they must be integers, (m, 3)",
        )
    if faces.dtype == np.uint32 and faces.max(initial=0) <= np.iinfo(np.int32).max:
        return vertices, np.ascontiguousarray(faces).view(np.int32)
    if faces.dtype.itemsize <= 4 and faces.dtype != np.uint32:
        return vertices, np.ascontiguousarray(faces, dtype=np.int32)
    return vertices, np.ascontiguousarray(integers(where, "faces", faces))


def grouped(where, organ, count):
    """Order of the faces, where each organ begins, and the ids; ascending."""
    if organ is None:
        return None, np.array([0, count], dtype=np.int64), None
    if np.ndim(organ) == 0:
        organ = np.full(count, organ)
    if np.shape(organ) != (count,) or np.asarray(organ).dtype.kind not in "iu":
        raise input_error(
            where,
            f"organ is {np.asarray(organ).dtype} of the shape {np.shape(organ)}",
            f"it must be integers, one for each of the {count} faces",
        )
    organ = integers(where, "organ", organ)
    order = None
    if np.any(organ[1:] < organ[:-1]):
        order = np.argsort(organ, kind="stable")
        organ = organ[order]
    first = np.flatnonzero(organ[1:] != organ[:-1]) + 1
    starts = np.concatenate(([0], first, [count])).astype(np.int64)
    return order, starts, np.ascontiguousarray(organ[starts[:-1]])


def ranks_of(order, starts):
    """Of each organ, by ascending ids: how many organs appear before it among the faces."""
    organs = len(starts) - 1
    if order is None:
        return np.arange(organs)
    ranks = np.empty(organs, dtype=np.int64)
    ranks[np.argsort(order[starts[:-1]])] = np.arange(organs)  # the first face of each
    return ranks


def per_organ(where, what, value, ids, ranks):
    """A value for all organs as a list of one, or one for each, by ascending ids, as texts.

    Lists are in the order in which the organs first appear among the faces: `ranks`.
    """
    count = len(ranks)
    if isinstance(value, Mapping):
        if ids is None:
            raise input_error(where, f"{what} is given by organ", "the argument organ is missing")
        missing = [int(i) for i in ids if int(i) not in value]
        if missing:
            raise input_error(where, f"{what} has no value for organ {missing[0]}")
        return [str(value[int(i)]) for i in ids]
    if isinstance(value, str) or np.ndim(value) == 0:
        return [str(value)]
    values = [str(v) for v in without_mask(where, what, value)]
    if len(values) != count:
        raise input_error(where, f"{what} has {len(values)} values", f"it needs one for each of {count} organs")
    return [values[rank] for rank in ranks]


def materials_of(where, material, order, starts, ids):
    """Names of materials, and the number of each face's among them (None: the first of all)."""
    if isinstance(material, str):
        return [material], None
    faces = int(starts[-1])
    if isinstance(material, Mapping):
        names = per_organ(where, "material", material, ids, ranks_of(order, starts))
        unique, number = np.unique(names, return_inverse=True)
        sorted_faces = np.repeat(number.astype(np.uint32), np.diff(starts))
        of_face = sorted_faces
        if order is not None:
            of_face = np.empty_like(sorted_faces)
            of_face[order] = sorted_faces
        return [str(n) for n in unique], of_face
    names = np.asarray(without_mask(where, "material", material))
    if names.shape != (faces,) or names.dtype.kind not in "UO":
        raise input_error(
            where,
            "material is neither a name nor a list of one name for each face",
            f"there are {faces} faces",
            "write material=\"leaf\"",
        )
    unique, number = np.unique(names.astype(str), return_inverse=True)
    return [str(n) for n in unique], number.astype(np.uint32)


def mesh_arrays(
    where, vertices, faces, organ, material, name, labels, measured, field_of_view_deg
):
    """The dict that quasimc._core.Document.build takes."""
    vertices, faces = vertices_and_faces(where, vertices, faces)
    count = len(vertices) // 3 if faces is None else len(faces)
    if count == 0:
        raise input_error(where, "there are no triangles")
    order, starts, ids = grouped(where, organ, count)
    ranks = ranks_of(order, starts)
    materials, material_of_face = materials_of(where, material, order, starts, ids)
    names = [] if name is None else per_organ(where, "name", name, ids, ranks)
    if labels is not None and not isinstance(labels, Mapping):
        raise input_error(where, f"labels is of the type {type(labels).__name__}", "it must be a dict")
    if len(names) == 1 and len(ranks) > 1:
        names = [f"{names[0]} {i}" for i in ids]
    return {
        "where": where,
        "vertices": vertices,
        "faces": faces,
        "order": order,
        "starts": starts,
        "ids": ids,
        "materials": materials,
        "material_of_face": material_of_face,
        "names": names,
        "labels": [
            (str(key), per_organ(where, f"label '{key}'", value, ids, ranks))
            for key, value in (labels or {}).items()
        ],
        "measured": bool(measured),
        "field_of_view_deg": float(field_of_view_deg),
    }
