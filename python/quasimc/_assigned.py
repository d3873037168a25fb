"""What one assigns to a scene: ground, cell, site, time, options, and its sources."""

from __future__ import annotations

import inspect

from . import _core
from ._keys import near
from ._meshes import input_error
from ._tables import SCENE_KEYS
from .scene_sources import Sources, source_tables
from .values import Cell, Ground, RunOptions, Site, Time

#: Names of earlier versions.
_RENAMED = {
    "set_ground": 'assign scene.ground = quasimc.Ground("soil")',
    "set_cell": "assign scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))",
    "add_source": "use scene.sources.append(quasimc.sky(...))",
}


def _assigned(key, kind, doc, name=None):
    """The property of a section of a run file: its value, or None. @param name: as of the property"""
    name = name or key

    def value_of(scene):
        table = scene._table.get(key)
        return None if table is None else kind._of(table)

    def assign(scene, value):
        if value is not None and not isinstance(value, kind):
            hint = f"assign quasimc.{kind.__name__}(...) or None"
            raise input_error(f"scene.{name}", f"{value!r} is not a {kind.__name__}", "", hint)
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
    options = _assigned(
        "run",
        RunOptions,
        "Options of all runs: RunOptions or None. ``scene.options = quasimc.RunOptions(paths=4096)``.",
        "options",
    )

    @property
    def sources(self):
        """The sources: Sources, a list that can be edited. ``scene.sources = [quasimc.sky(...)]``."""
        return Sources(self)

    @sources.setter
    def sources(self, sources):
        Sources(self)[:] = source_tables([] if sources is None else sources)

    def __getattr__(self, name):
        raise AttributeError(f"Scene has no {name!r}{_instead_of(name, dir(type(self)))}")


def check_assigned(scene, name):
    """Refuses the name of an attribute that a scene has not. Raises AttributeError."""
    if name.startswith("_") or hasattr(type(scene), name):
        return
    if name in [option["key"] for option in _core.options()]:
        hint = f": it is an option, scene.options = quasimc.RunOptions({name}=...)"
    elif name in inspect.signature(type(scene)).parameters:
        hint = f": it is given once, quasimc.Scene({name}=...)"
    else:
        known = [key for key, each in vars(Assigned).items() if isinstance(each, property)]
        hint = _instead_of(name, known) or f"; to be assigned are {', '.join(known)}"
    raise AttributeError(f"Scene has no {name!r}{hint}")


def _instead_of(name, known):
    """What to write instead of a name that does not exist, or ""."""
    if name in _RENAMED:
        return f": {_RENAMED[name]}"
    hint = near(name, [key for key in known if not key.startswith("_")])
    return hint and f"; {hint}"
