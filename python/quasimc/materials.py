"""Materials of a scene, which one edits between runs."""

from __future__ import annotations

from collections.abc import Mapping, MutableMapping

from ._keys import near
from ._meshes import plain


class Materials(MutableMapping):
    """The materials of a scene, by name: ``scene.materials["leaf"].reflectance = 0.1``.

    Those of files (glTF, .opf, ``material_file``) are not among them.
    """

    def __init__(self, scene):
        self._scene = scene

    def _tables(self):
        return {table["name"]: table for table in self._scene._table.get("material", [])}

    def __getitem__(self, name):
        tables = self._tables()
        if name not in tables:
            known = ", ".join(tables) or "none"
            hint = near(name, tables, f"there are: {known}")
            raise KeyError(f"there is no material {name!r}; {hint}")
        return Material(self._scene, name)

    def __setitem__(self, name, value):
        """Adds a material, or replaces it: a Material of any scene, or a dict of its keys."""
        table = value.table() if isinstance(value, Material) else dict(value)
        self._scene.add_material(name, **{k: v for k, v in table.items() if k != "name"})

    def __delitem__(self, name):
        self[name]
        self._scene._remove_material(name)

    def __iter__(self):
        return iter(list(self._tables()))

    def __len__(self):
        return len(self._tables())

    def __repr__(self):
        return "\n".join(repr(self[name]) for name in self) or "<no materials>"


class Material:
    """A material of a scene. Every change is checked at once, and a refused one changes nothing.

    Attributes
    ----------
    name : str
    reflectance, transmittance : ByBand
        0 to 1 in each band: ``material.reflectance["NIR"] = 0.4``; assigned are a number for all
        bands, a list, or a dict by band. Empty where they follow from other keys.
    """

    __slots__ = ("_scene", "_name")

    def __init__(self, scene, name):
        self._scene = scene
        self._name = name

    def __setattr__(self, name, value):
        if not hasattr(type(self), name):
            known = ("reflectance", "transmittance")
            hint = near(name, known, f"others are changed by set({name}=...)")
            raise AttributeError(f"a Material has no {name!r}; {hint}")
        object.__setattr__(self, name, value)

    @property
    def name(self):
        return self._name

    def table(self):
        """The keys of the material, as in a run file: dict."""
        table = self._scene.materials._tables()[self._name]
        return {key: value for key, value in table.items() if value is not None}

    def set(self, **keys):
        """Changes several keys at once, those of `Scene.add_material`; None removes one.

        Raises
        ------
        InputError
            If the material is then invalid; nothing is changed.
        """
        table = {**self.table(), **keys}
        name = table.pop("name")
        self._scene.add_material(name, **{k: v for k, v in table.items() if v is not None})

    @property
    def reflectance(self):
        return self._by_band("reflectance")

    @reflectance.setter
    def reflectance(self, value):
        self.set(reflectance=value)

    @property
    def transmittance(self):
        return self._by_band("transmittance")

    @transmittance.setter
    def transmittance(self, value):
        self.set(transmittance=value)

    def _by_band(self, key):
        value = self.table().get(key, {})
        bands = self._scene._bands
        if not isinstance(value, Mapping):
            value = dict(zip(bands, value if isinstance(value, list) else [value] * len(bands)))
        return ByBand(self, key, value)

    def __eq__(self, other):
        return isinstance(other, Material) and self.table() == other.table()

    __hash__ = None

    def __repr__(self):
        parts = []
        for key, value in self.table().items():
            if key in ("reflectance", "transmittance"):
                value = ", ".join(f"{band} {x:g}" for band, x in self._by_band(key).items())
            if key != "name":
                parts.append(f"{key} {value}")
        return f"<Material {self._name!r}: {'; '.join(parts)}>"


class ByBand(MutableMapping):
    """Numbers by band, of a material: setting one changes the material."""

    def __init__(self, material, key, values):
        self._material = material
        self._key = key
        self._values = dict(values)

    def __getitem__(self, band):
        if band not in self._values:
            raise KeyError(f"there is no band {band!r}; there are: {', '.join(self._values)}")
        return self._values[band]

    def __setitem__(self, band, value):
        self[band]
        values = {**self._values, band: plain(value)}
        self._material.set(**{self._key: values})
        self._values = values

    def __delitem__(self, band):
        raise TypeError("a band of a material can't be removed")

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __repr__(self):
        return repr(self._values)
