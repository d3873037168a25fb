"""Packages that only some methods need."""

from __future__ import annotations

from importlib import import_module


def needed(name):
    """An optional package, or a module of one. Raises ImportError with what to install."""
    package = name.partition(".")[0]
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        if error.name not in (None, package, name):
            raise  # one that it needs itself
        text = f"{package} is missing; install it: pip install {package}"
        raise ModuleNotFoundError(text, name=package) from error
