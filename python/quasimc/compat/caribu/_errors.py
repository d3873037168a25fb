"""The exceptions of the interface."""

from ...errors import Error


class CaribuError(Error):
    """Any error of this interface."""


class CaribuOptionError(CaribuError):
    """An option has no meaning."""


class CaribuIOError(CaribuError):
    """A file can't be read."""


class CaribuRunError(CaribuError):
    """Light can't be computed."""
