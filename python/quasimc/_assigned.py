"""What one assigns to a scene: ground, cell, site, time."""

from __future__ import annotations

from ._meshes import fault
from ._tables import SCENE_KEYS
from .values import Cell, Ground, Site, Time

#: Names of earlier versions.
_RENAMED = {
    "set_ground": 'assign scene.ground = quasimc.Ground("soil")',
    "set_cell": "assign scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))",
}


class Assigned:
    """Part of `Scene`."""

    @property
    def ground(self):
        """The ground: Ground or None. ``scene.ground = quasimc.Ground("soil")``."""
        return self._value("ground", Ground)

    @ground.setter
    def ground(self, value):
        self._assign("ground", Ground, value)

    @property
    def cell(self):
        """The periodic cell: Cell or None. ``scene.cell = quasimc.Cell(x=(0, 1), y=(0, 1))``."""
        return self._value("cell", Cell)

    @cell.setter
    def cell(self, value):
        self._assign("cell", Cell, value)

    @property
    def site(self):
        """The site on the Earth: Site or None."""
        return self._value("site", Site)

    @site.setter
    def site(self, value):
        self._assign("site", Site, value)

    @property
    def time(self):
        """The time steps of `series`: Time or None. A run file's ``[time]`` is one."""
        return self._value("time", Time)

    @time.setter
    def time(self, value):
        self._assign("time", Time, value)

    def _value(self, key, kind):
        table = self._table.get(key)
        return None if table is None else kind._of(table)

    def _assign(self, key, kind, value):
        if value is not None and not isinstance(value, kind):
            raise fault(
                f"scene.{key}", f"{value!r} is no {kind.__name__}", "",
                f"assign quasimc.{kind.__name__}(...) or None",
            )
        with self._lock.to_change():
            if value is None:
                self._table.pop(key, None)
            else:
                self._table[key] = self._with_file(value.table())
            self._document = None
            if key in SCENE_KEYS or key == "site":
                self._built = None

    def _with_file(self, table):
        """A table whose file is kept as its path means now."""
        return {k: self._path(v) if k == "file" else v for k, v in table.items()}

    def __getattr__(self, name):
        if name in _RENAMED:
            raise AttributeError(f"Scene has no {name!r}: {_RENAMED[name]}")
        raise AttributeError(f"Scene has no {name!r}")
