"""The program quasimc, which draws pictures and shows results."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from .errors import Error


def program():
    """The path of the program: of $QUASIMC_PROGRAM, of this installation, or on the path.

    Raises `quasimc.Error` if there is none.
    """
    name = "quasimc.exe" if sys.platform == "win32" else "quasimc"
    build = Path(__file__).resolve().parent
    candidates = [
        os.environ.get("QUASIMC_PROGRAM") or None,
        os.path.join(sysconfig.get_path("scripts"), name),
        Path(__file__).parent.parent.parent / "bin" / name,  # of a build
        build.parent.parent / "build" / "release" / "bin" / name,  # of a clone
        shutil.which(name),
    ]
    for path in candidates:
        if path is not None and os.access(path, os.X_OK) and os.path.isfile(path):
            return str(path)
    raise Error("the program quasimc was not found: put it on the path, or set QUASIMC_PROGRAM")


def call(*arguments):
    """Runs the program. Raises `quasimc.Error` with its message if it fails."""
    said = subprocess.run(
        [program(), *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL
    )
    if said.returncode:
        raise Error(said.stderr.strip() or f"quasimc ended with the status {said.returncode}")
    return said.stdout


def flags(options):
    """Options of a command: view="top" is --view top; True is a flag alone, None and False none."""
    for key, value in options.items():
        flag = "--" + key.replace("_", "-")
        if value is True:
            yield flag
        elif value is not None and value is not False:
            if isinstance(value, (tuple, list)):
                value = ("x" if key == "size" else ",").join(map(str, value))
            yield from (flag, str(value))
