"""Warnings at the line of the caller."""

from __future__ import annotations

import sys
import warnings

from .errors import QuasimcWarning


def warn_here(texts):
    """Warns at the line of the caller outside this package."""
    depth, frame = 1, sys._getframe()
    while frame.f_back is not None and _is_own(frame):
        depth, frame = depth + 1, frame.f_back
    for text in texts:
        warnings.warn(text, QuasimcWarning, stacklevel=depth)


def _is_own(frame):
    """Whether code of this package runs in a frame."""
    return (frame.f_globals.get("__package__") or "").partition(".")[0] == __package__


def warn_of_stop(stop):
    """Warns of a result that is not complete."""
    if stop == "interrupted":
        warn_here(["interrupted: the result contains the paths completed so far"])
