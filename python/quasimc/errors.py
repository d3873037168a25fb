"""What can go wrong."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple


class Error(Exception):
    """Anything that quasimc reports."""


class InputError(Error, ValueError):
    """Something in what was stated is wrong.

    The text tells every fault, one a line: "where: problem (why); suggestion".

    Attributes
    ----------
    faults : list of dict
        With the keys "where", "problem", "why" and "suggestion".
    """

    def __init__(self, text: str, faults: List[Dict[str, str]]) -> None:
        super().__init__(text)
        self.faults = faults

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (str(self), self.faults)


class Stopped(Error, RuntimeError):
    """A run ended before there was a result.

    Attributes
    ----------
    why : str
        "time_limit" or "interrupted".
    """

    def __init__(self, text: str, why: str) -> None:
        super().__init__(text)
        self.why = why

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (str(self), self.why)


class QuasimcWarning(UserWarning):
    """Something that is allowed but probably not meant."""
