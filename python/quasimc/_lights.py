"""The light of a run, ready to be summed."""

from __future__ import annotations

import numpy as np

from . import _core
from ._rows import Rows


class Lights:
    """The light of organs (or of sums of them) by quantity and band, as one run has it.

    Attributes
    ----------
    run : str
        Which replicates it is made of: lights of the same run and labels are the same.
    count, bands : int
        Numbers of replicates and of bands.
    """

    __slots__ = ("core", "run", "count", "bands", "_labels", "_known", "_origins")

    def __init__(self, core, run, bands):
        self.core = core  # of all that a run keeps; None: there is only what is known
        self.run, self.bands = run, bands
        self.count = None if core is None else core.count
        self._labels = None  # of the entries, which are not organs by their positions
        self._known = {}
        self._origins = {}

    def light(self, quantity, band):
        """The light of all entries: a SummableLight."""
        if self.core is not None:
            return self.core.light(quantity, band)
        return self._known[quantity, band]

    def source(self, quantity, rows):
        """Weighted sums of organs: a source of estimates."""
        from ._combination import Combination

        return Combination(self, quantity, rows)

    def origin(self, name):
        """The light that came from an origin."""
        if name not in self._origins:
            self._origins[name] = Lights(self.core.origin(name), f"{self.run}/{name}", self.bands)
        return self._origins[name]

    def whole(self):
        """The light of all origins."""
        return Lights(self.core.whole(), self.run, self.bands)

    def labels_of(self, entries):
        """What entries are: the position of an organ, or a number below 0 for a sum."""
        return np.asarray(entries, np.int64) if self._labels is None else self._labels[entries]

    def kept(self, rows, labels, quantity, bands):
        """Lights of rows alone, which have these labels, in one quantity and some bands."""
        known = {
            (quantity, band): self.light(quantity, band).combined(*rows.arrays()) for band in bands
        }
        return _restored(self.run, labels, self.bands, known, self.count)

    @staticmethod
    def of_same(pairs, quantity, bands):
        """Lights of one run as one, and rows of it.

        Parameters
        ----------
        pairs : list
            Of Lights of the same run, and Rows of them.
        """
        first = pairs[0][0]
        if all(lights is first for lights, _ in pairs):
            return first, [rows for _, rows in pairs]
        labels, parts, moved = np.zeros(0, np.int64), [], []
        for lights, rows in pairs:
            entries = np.unique(rows.organs)
            own = lights.labels_of(entries)
            is_new = ~np.isin(own, labels)
            parts.append(lights.kept(Rows.of_organs(entries[is_new]), own[is_new], quantity, bands))
            labels = np.concatenate([labels, own[is_new]])
            order = np.argsort(labels)
            at = order[np.searchsorted(labels, lights.labels_of(rows.organs), sorter=order)]
            moved.append(Rows(rows.starts, at, rows.weights))
        known = {
            (quantity, band): _core.SummableLight.joined(
                [part.light(quantity, band) for part in parts]
            )
            for band in bands
        }
        return _restored(first.run, labels, first.bands, known, first.count), moved

    def __reduce__(self):
        return _restored, (self.run, self._labels, self.bands, self._known, self.count)


def _restored(run, labels, bands, known, count):
    lights = Lights(None, run, bands)
    lights._labels, lights._known, lights.count = labels, known, count
    return lights
