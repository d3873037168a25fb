"""Sums of light over groups of organs."""

from __future__ import annotations

import numpy as np

from ._index import GroupIndex
from ._light import Light, estimate_columns, origins_of, ratio_estimates
from ._optional import needed
from ._rows import Rows
from .estimates import Estimates
from .sun_shade import parts_of


class Groups(Light):
    """Sums over organs, with the errors of the sums.

    Indexed like a result, and by "fraction_incident" (absorbed flux over the light on the horizontal)
    and "fraction_absorbed" (over that of all measured organs). Densities are means weighted by area.
    ``groups["absorbed_flux"]["PAR"].at("maize")`` is that of a group, by the value of its label.

    Attributes
    ----------
    groups : list of dict
        For each group: by, value, labels (dict), organs (indices in the result), area; for layers also
        height_min, height_max, plant_area_index and cumulative_plant_area_index.
    """

    #: Fractions of other light, in the order of the core.
    _SHARES = ("fraction_incident", "fraction_absorbed")

    def __init__(
        self,
        core,
        organs,
        ratio_names=(),
        *,
        first=0,
        is_summed=False,
        replicates=None,
        parts=None,
        origins=None,
    ):
        def values_of(light):
            return light["groups"]["values"][first:]

        self.groups = core["groups"][first:]
        rows = Rows.of_groups([group["organs"] for group in self.groups])
        index = GroupIndex([_key_of(g) for g in self.groups], [g["area"] for g in self.groups])
        self._sunlit_area = core["sunlit_area"][first:]
        self._ratios = core["ratios"][first:]
        self._ratio_names = list(ratio_names)
        self._parts, self._first = core.get("sun_shade"), first
        shares = core.get("shares")
        self._shares = None if shares is None else shares[first:]
        super().__init__(
            core["values"][first:],
            index,
            organs,
            sunlit=None if is_summed else core["sunlit_fraction"][first:],
            rows=rows,
            replicates=replicates,
            origins=origins_of(origins or {}, parts, values_of),
            is_summed=is_summed,
        )

    @property
    def sun_shade(self):
        """Light of the sunlit and the shaded part of groups, with sun_shade="apart": SunShade."""
        return parts_of(self._parts, self._index, self._organs, self._first)

    def keys(self):
        """Names of the quantities."""
        return [*self._names(), *(() if self._shares is None else self._SHARES)]

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def __getitem__(self, quantity):
        if self._shares is None or quantity not in self._SHARES:
            return super().__getitem__(quantity)
        shares = self._shares[:, self._SHARES.index(quantity)]
        return Estimates(shares, quantity, "", self.bands, index=self._index)

    @property
    def ratios(self):
        """Ratios of bands by group: dict, "R:FR" -> Estimates of shape (groups,)."""
        return ratio_estimates(self._ratios, self._ratio_names, self._index)

    @property
    def areas(self):
        """(groups,), one-sided areas."""
        return self._index.areas

    def to_pandas(self):
        """Returns a pandas.DataFrame with a row for each group and the columns of the CSV files.

        by, value, organs (their number), area, height_min, height_max, plant_area_index,
        cumulative_plant_area_index, ``<quantity>_<band>`` with ``_se`` and ``_ci95_high``,
        sunlit_fraction and sunlit_area where there are directional sources, ``ratio_<ratio>``,
        ``fraction_incident_<band>`` and ``fraction_absorbed_<band>``. The fractions of the canopy are
        in `Result.canopy`.
        """
        pandas = needed("pandas")

        columns = {name: [group[name] for group in self.groups] for name in ("by", "value")}
        columns["organs"] = [len(group["organs"]) for group in self.groups]
        for name in (
            "area", "height_min", "height_max", "plant_area_index", "cumulative_plant_area_index"
        ):
            columns[name] = [group[name] for group in self.groups]
        columns.update(self._columns())
        if self._has_sunlit:
            area = Estimates(self._sunlit_area, "sunlit_area", f"{self._organs.length_unit}2")
            columns.update(estimate_columns("sunlit_fraction", self["sunlit_fraction"]))
            columns.update(estimate_columns("sunlit_area", area))
        for name, estimates in self.ratios.items():
            columns.update(estimate_columns(f"ratio_{name}", estimates))
        for band in self.bands if self._shares is not None else ():
            for name in self._SHARES:
                columns.update(estimate_columns(f"{name}_{band}", self[name][band]))
        frame = pandas.DataFrame(columns)
        frame.attrs["units"] = self._column_units()
        return frame

    def _repr_html_(self):
        return self.to_pandas()._repr_html_()

    def __repr__(self):
        by = ", ".join(dict.fromkeys(group["by"] for group in self.groups))
        return f"<Groups by {by}: {len(self.groups)}>"


def _key_of(group):
    """The value by which a group is found: a text, or a tuple for several labels."""
    values = tuple(group["labels"].values())
    if not values:
        return group["by"]
    return values[0] if len(values) == 1 else values


def group_rows(keys, positions):
    """Groups of organs by equal keys, in the order in which they first appear.

    Parameters
    ----------
    keys : array_like
        (n,), the group of each organ.
    positions : numpy.ndarray
        (n,), of the organs in the result.
    """
    members = {}
    for key, position in zip(np.asarray(keys).tolist(), positions.tolist()):
        members.setdefault(key, []).append(position)
    return list(members), [np.array(group, np.uint32) for group in members.values()]
