"""Progress of runs."""

from __future__ import annotations

import sys


class Progress:
    """Progress of a run.

    Attributes
    ----------
    fraction : float
        Completed fraction of the run, 0 to 1.
    seconds : float
        Time since the run began.
    expected_seconds : float
        Expected duration of the whole run; it grows when a target needs more rounds.
    fraction_at_target : float
        Fraction of the organs that have reached the target error; 0 without a target.
    """

    __slots__ = ("fraction", "seconds", "expected_seconds", "fraction_at_target")

    def __init__(self, fraction, seconds, expected_seconds, fraction_at_target):
        self.fraction = fraction
        self.seconds = seconds
        self.expected_seconds = expected_seconds
        self.fraction_at_target = fraction_at_target


class ProgressBar:
    """A progress line on stderr, overwritten at each update."""

    WIDTH = 30

    def __init__(self, stream=None):
        self._stream = sys.stderr if stream is None else stream
        self._length = 0

    def __call__(self, progress):
        done = round(self.WIDTH * min(max(progress.fraction, 0.0), 1.0))
        left = max(progress.expected_seconds - progress.seconds, 0.0)
        bar = "#" * done + "." * (self.WIDTH - done)
        self._write(f"[{bar}] {100 * progress.fraction:3.0f} %, {left:.0f} s left")

    def close(self):
        """Wipes the line."""
        if self._length:
            self._write("")
            self._stream.write("\r")
            self._stream.flush()

    def _write(self, line):
        self._stream.write("\r" + line.ljust(self._length))
        self._stream.flush()
        self._length = len(line)


class Listener:
    """What quasimc._core calls, for what a person gave as `progress`."""

    def __init__(self, progress):
        self._bar = ProgressBar() if progress is True else None
        self._call = self._bar or progress or None

    @property
    def callback(self):
        if self._call is None:
            return None
        return lambda *numbers: self._call(Progress(*numbers))

    def __enter__(self):
        return self

    def __exit__(self, *error):
        if self._bar is not None:
            self._bar.close()
