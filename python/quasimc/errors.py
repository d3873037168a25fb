"""Exceptions and warnings."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple


class Error(Exception):
    """Base class of the exceptions of quasimc."""


class InputError(Error, ValueError):
    """The input has errors.

    The text has one line for each error: "where: problem (why); suggestion".

    Attributes
    ----------
    faults : list of dict
        One dict for each error, with the keys "where", "problem", "why" and "suggestion".
    """

    def __init__(self, text: str, faults: List[Dict[str, str]]) -> None:
        super().__init__(text)
        self.faults = faults

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (str(self), self.faults)


class KeywordError(InputError, TypeError):
    """A call has a keyword that does not exist."""


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
    """A possible problem in the input."""
