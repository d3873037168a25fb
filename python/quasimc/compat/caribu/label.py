"""Labels of triangles in .can files: species (1 digit or more), plant (5), leaf (3), element (3)."""


class Label:
    """A label of 12 digits or more.

    Parameters
    ----------
    label : str or int
    """

    def __init__(self, label="000000000000"):
        self.label = str(label).strip().zfill(12)

    @property
    def species(self):
        return int(self.label[:-11])

    @property
    def plant(self):
        return int(self.label[-11:-6])

    @property
    def leaf(self):
        return int(self.label[-6:-3])

    @property
    def element(self):
        return int(self.label[-3:])

    def is_soil(self):
        """Whether it is of the soil: species 0 and leaf 0."""
        return self.species == 0 and self.leaf == 0

    def is_stem(self):
        """Whether it is opaque: leaf 0 of a plant."""
        return self.species > 0 and self.leaf == 0

    def is_leaf(self):
        return self.leaf > 0

    def __str__(self):
        return self.label

    def __repr__(self):
        return f"Label({self.label!r})"
