"""Files that are written."""

from __future__ import annotations

from pathlib import Path


def target(path):
    """The path of a file to write. Raises FileNotFoundError if its folder does not exist."""
    path = Path(path)
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path}: the folder {str(path.parent)!r} does not exist; make it first")
    return path
