"""The sources of a scene, which can be edited."""

from __future__ import annotations

from collections.abc import Mapping, MutableSequence

from ._meshes import input_error, plain
from .sources import Source


class Sources(MutableSequence):
    """The sources of a scene: a list of `Source`, also by name.

    Runs without the argument `sources` take them. ``scene.sources["lamp"]`` is the source of a name;
    sources are values: ``scene.sources["lamp"] = scene.sources["lamp"].replace(power=20)``. Paths of
    files are kept as absolute ones (of a loaded scene: relative to the folder of its file).
    """

    def __init__(self, scene):
        self._scene = scene

    @property
    def _tables(self):
        return self._scene._table.get("source", [])

    @property
    def names(self):
        """The name of each source, or None: list."""
        return [table.get("name") for table in self._tables]

    def __len__(self):
        return len(self._tables)

    def __getitem__(self, key):
        if isinstance(key, slice):
            return [Source._of(table) for table in self._tables[key]]
        return Source._of(self._tables[self._position(key)])

    def __setitem__(self, key, value):
        tables = list(self._tables)
        if isinstance(key, slice):
            tables[key] = self._entries(value)
        else:
            tables[self._position(key)] = self._entries([value])[0]
        self._scene._set_sources(tables)

    def __delitem__(self, key):
        tables = list(self._tables)
        del tables[key if isinstance(key, slice) else self._position(key)]
        self._scene._set_sources(tables)

    def insert(self, index, value):
        """Inserts a source before a position. Warns if the scene has an equal one, or one of its name."""
        table = self._entries([value])[0]
        self._scene._warn_of_second("source", table)
        tables = list(self._tables)
        tables.insert(index, table)
        self._scene._set_sources(tables)

    def _entries(self, sources):
        """The tables of sources, as the scene keeps them."""
        scene, tables = self._scene, []
        for table in source_tables(sources):
            table = plain(scene._with_paths(table))
            tables.append({**table, "file": scene._path(table["file"])} if "file" in table else table)
        return tables

    def _position(self, key):
        """The position of a source, by position or name."""
        if not isinstance(key, str):
            return range(len(self))[key]
        found = [i for i, name in enumerate(self.names) if name == key]
        if not found:
            known = ", ".join(repr(name) for name in self.names if name) or "none has a name"
            raise KeyError(f"there is no source {key!r}; there are: {known}")
        if len(found) > 1:
            raise KeyError(f"{len(found)} sources have the name {key!r}: use positions, {found}")
        return found[0]

    def __eq__(self, other):
        return isinstance(other, (Sources, list, tuple)) and list(self) == list(other)

    __hash__ = None

    def __repr__(self):
        return repr(list(self))


def source_tables(sources):
    """The tables of a source or of several, each a Source or a dict."""
    one = isinstance(sources, (Source, Mapping, str))
    tables = []
    for source in [sources] if one else sources:
        if not isinstance(source, (Source, Mapping)):
            raise input_error(
                "sources",
                f"{source!r} is not a source",
                "",
                "use quasimc.sun, quasimc.sky, ..., or a dict of its keys",
            )
        tables.append(source.table() if isinstance(source, Source) else dict(source))
    return tables
