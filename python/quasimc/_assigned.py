"""What one assigns to a scene: ground, cell, site, time."""

from __future__ import annotations

from ._meshes import input_error
from ._tables import SCENE_KEYS
from .values import Cell, Ground, Site, Time

#: Names of earlier versions.
_RENAMED = {
    "set_ground": 'assign scene.ground = quasimc.Ground("soil")',
    "set_cell": "assign scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))",
}


def _assigned(key, kind, doc):
    """The property of a section of a run file: its value, or None."""

    def value_of(scene):
        table = scene._table.get(key)
        return None if table is None else kind._of(table)

    def assign(scene, value):
        if value is not None and not isinstance(value, kind):
            hint = f"assign quasimc.{kind.__name__}(...) or None"
            raise input_error(f"scene.{key}", f"{value!r} is no {kind.__name__}", "", hint)
        with scene._lock.to_change():
            scene._table.pop(key, None)
            if value is not None:
                table = value.table()
                scene._table[key] = {k: scene._path(v) if k == "file" else v for k, v in table.items()}
            scene._document = None
            if key in SCENE_KEYS or key == "site":
                scene._built = None

    return property(value_of, assign, doc=doc)


class Assigned:
    """Part of `Scene`."""

    ground = _assigned(
        "ground", Ground, 'The ground: Ground or None. ``scene.ground = quasimc.Ground("soil")``.'
    )
    cell = _assigned(
        "cell", Cell, "The periodic cell: Cell or None. ``scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))``."
    )
    site = _assigned("site", Site, "The site on the Earth: Site or None.")
    time = _assigned(
        "time", Time, "The time steps of `series`: Time or None. A run file's ``[time]`` is one."
    )

    def __getattr__(self, name):
        if name in _RENAMED:
            raise AttributeError(f"Scene has no {name!r}: {_RENAMED[name]}")
        raise AttributeError(f"Scene has no {name!r}")
