"""Pictures, and pages for the browser, made by the program."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from ._optional import needed
from ._program import call, flags, program
from ._targets import target

_IN_A_NOTEBOOK = "ZMQInteractiveShell"


class Picture:
    """A picture in PNG, which a notebook displays.

    Attributes
    ----------
    png : bytes
    size : tuple of int
        Width and height, pixels.
    """

    def __init__(self, png):
        self.png = png
        self.size = struct.unpack(">II", png[16:24])

    def save(self, path):
        """Writes the picture to a file. Returns its path."""
        path = target(path)
        path.write_bytes(self.png)
        return path

    @property
    def pixels(self):
        """(height, width, 4), uint8; needs matplotlib."""
        from io import BytesIO

        import numpy as np
        pixels = needed("matplotlib.image").imread(BytesIO(self.png), format="png")
        opaque = np.ones((*pixels.shape[:2], 1), pixels.dtype)
        pixels = pixels if pixels.shape[2] == 4 else np.concatenate([pixels, opaque], axis=2)
        return np.round(255 * pixels).astype(np.uint8)

    def __eq__(self, other):
        return isinstance(other, Picture) and self.png == other.png

    __hash__ = None

    def __repr__(self):
        return f"<Picture of {self.size[0]} x {self.size[1]} pixels>"

    def _repr_png_(self):
        return self.png


def draw(path, options):
    """The picture of a result, run file or geometry file."""
    with TemporaryDirectory() as folder:
        target = os.path.join(folder, "picture.png")
        call("show", path, "-o", target, *flags(options))
        with open(target, "rb") as file:
            return Picture(file.read())


class Page:
    """A page with a scene to turn; a notebook shows it in a frame."""

    def __init__(self, html, height=640):
        self.html = html
        self.height = height

    def __repr__(self):
        return f"<Page of {len(self.html) / 1e6:.1f} MB>"

    def _repr_html_(self):
        from html import escape

        return (
            f'<iframe srcdoc="{escape(self.html)}" style="width:100%;height:{self.height}px;'
            'border:0"></iframe>'
        )


def in_notebook():
    """Whether this is the kernel of a notebook."""
    shell = sys.modules.get("IPython")
    shell = None if shell is None else shell.get_ipython()
    return type(shell).__name__ == _IN_A_NOTEBOOK


def open_picture(picture):
    """Shows a picture in the browser."""
    import webbrowser
    from tempfile import mkstemp

    handle, path = mkstemp(suffix=".png")
    with os.fdopen(handle, "wb") as file:
        file.write(picture.png)
    webbrowser.open(Path(path).as_uri())


def open_in_browser(path):
    """Serves a result in a browser, until the window's address is closed by this process's end."""
    import atexit
    import webbrowser

    server = subprocess.Popen(
        [program(), "view", str(path)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    atexit.register(server.terminate)
    address = server.stdout.readline().strip()
    if not address:
        call("view", path)  # raises its message
    webbrowser.open(address)
    return address
