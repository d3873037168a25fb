#!/usr/bin/env python3
"""Builds new members by tools/new.py, one of every family, with tests, in a copy of the tree.

Runs the new tests, and the tests of every row of a catalogue on the new rows.  With a warm ccache of the
release preset this takes about one minute of one processor, otherwise five.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import new

NAME = "specimen_{}"  # of each family; names of pages must differ between families
PARTS = (
    "CMakeLists.txt", "CMakePresets.json", "cmake", "data", "include",
    "src", "tests", "tools", "docs", "examples", "python",
)

# The tests of every row of a catalogue, with their dependencies.
EVERY_ROW = {
    "bsdf": ("models_test.cpp", "optics_testing.cpp"),
    "format": ("formats_test.cpp", "../runfile/io_testing.cpp", "../runfile/catalogues_test.cpp"),
    "sampler": ("every_sampler_test.cpp", "sampler_testing.cpp"),
    "solver": ("every_solver_test.cpp", "../../statistical/scenes.cpp"),
    "detector": (
        "every_detector_test.cpp",
        "../capi/written_detectors_test.cpp",
        "../capi/canopy.cpp",
        "../runfile/io_testing.cpp",
    ),
    "output": ("../runfile/every_output_test.cpp", "../runfile/io_testing.cpp"),
}
FILTER = "*Specimen*:*specimen*:Catalogue*:Formats.*:Catalogues.*"

PROGRAM = """quasimc_test(
    NAME new_members
    SOURCES {sources}
    LIBS quasimc::capi quasimc::netcdf quasimc::detectors quasimc::samplers fmt::fmt
         nlohmann_json::nlohmann_json)
{includes}"""


DETECTOR_IN_PYTHON = """
import quasimc
scene = quasimc.Scene(["PAR"])
scene.add_material("leaf", reflectance=0.5)
scene.add_organ("disk", material="leaf", center=[0, 0, 1], normal=[0, 0, 1], radius=1)
scene.add_source(quasimc.directional(direction=[0, 0, -1], irradiance_facing=1))
scene.add_detector("{type}", name="it")
seen = scene.run(paths=64, method="light_tracing").detectors["it"]
assert seen.type == "{type}" and len(seen["PAR"].mean) == len(seen.bins) > 0
"""


def copy_tree(copy):
    ignored = shutil.ignore_patterns("build", "__pycache__", ".git")
    for part in PARTS:
        source = new.ROOT / part
        if source.is_dir():
            shutil.copytree(source, copy / part, ignore=ignored, symlinks=True)
        elif source.exists():
            shutil.copy2(source, copy / part)


def leave_only_new_tests(copy, families):
    """One program of the new members' tests, in place of all others; the fuzzed readers stay."""
    sources, folders = [], []
    for kind, family in families.items():
        names = (f"{family.prefix}{NAME.format(kind)}_test.cpp", *EVERY_ROW.get(kind, ()))
        sources += [os.path.normpath(f"{family.tests}/{name}") for name in names]
        folders.append(f'"${{PROJECT_SOURCE_DIR}}/{family.tests}"')
    for lists in (copy / "tests").glob("**/CMakeLists.txt"):
        if lists.parent.name not in ("tests", "support", "fuzz"):
            lists.unlink()
    target = copy / "tests/new_members"
    target.mkdir()
    includes = f"target_include_directories(quasimc_test_new_members PRIVATE {' '.join(folders)})\n"
    text = PROGRAM.format(
        sources="\n            ".join(
            f'"${{PROJECT_SOURCE_DIR}}/{source}"' for source in dict.fromkeys(sources)
        ),
        includes=includes,
    )
    (target / "CMakeLists.txt").write_text(text, encoding="utf-8")


def run(command, **more):
    """Runs a command; shows its output only if it fails."""
    done = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **more
    )
    if done.returncode != 0:
        sys.exit(f"{done.stdout[-8000:]}\nnew_build: failed: {' '.join(map(str, command))}")
    return done.stdout


def build(copy, jobs, families):
    # The build folder has the path of every build of this preset, for ccache.
    environment = {"CCACHE_BASEDIR": str(copy), "CCACHE_NOHASHDIR": "1", **os.environ}
    folder = copy / "build/release"
    has_python = "ON" if "detector" in families else "OFF"
    settings = ["APPS=OFF", f"PYTHON={has_python}", "TESTS=ON"]
    settings = [f"-DQUASIMC_BUILD_{setting}" for setting in settings]
    run(["cmake", "--preset", "release", *settings], cwd=copy, env=environment)
    targets = ["quasimc_test_new_members"]
    if "format" in families:
        targets.append("quasimc_fuzz")
    if "detector" in families:
        targets.append("quasimc_python")
    run(["cmake", "--build", folder, "--target", *targets, "-j", str(jobs)], env=environment)
    return folder


def test(copy, folder, families):
    program = next(folder.glob("**/quasimc_test_new_members"))
    said = run([program, f"--gtest_filter={FILTER}"])
    passed = re.findall(r"\[       OK \] (\S+)", said)
    for kind, family in families.items():
        test_file = f"{family.tests}/{family.prefix}{NAME.format(kind)}_test.cpp"
        text = (copy / test_file).read_text(encoding="utf-8")
        for suite, case in re.findall(r"^TEST\((\w+), (\w+)\)", text, re.M):
            if f"{suite}.{case}" not in passed:
                sys.exit(f"{said}\nnew_build: {kind}: {suite}.{case} did not pass")
    rows = [name for name in passed if "/specimen_" in name]
    for kind in families.keys() & {"bsdf", "sampler", "solver", "detector", "output"}:
        if not any(f"/{NAME.format(kind)}" in name for name in rows):
            sys.exit(f"new_build: {kind}: no test over the rows of its catalogue took the new row up")
    if "format" in families:
        replay = f"Fuzz.Replays.{NAME.format('format')}"
        run(["ctest", "--test-dir", folder, "--no-tests=error", "-R", replay])
    print(f"new_build: {len(families)} families, {len(passed)} tests passed, {len(rows)} on new rows")


def test_detector_in_python(folder):
    """Checks that a new type of detector is available in Python by its name."""
    program = DETECTOR_IN_PYTHON.format(type=NAME.format("detector"))
    environment = {**os.environ, "PYTHONPATH": str(folder / "python")}
    cache = (folder / "CMakeCache.txt").read_text(encoding="utf-8")
    python = re.search(r"^QUASIMC_PYTHON:FILEPATH=(.*)$", cache, re.M)[1]
    run([python, "-c", program], env=environment)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("families", nargs="*", help="all, if none is named")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count() or 2)
    args = parser.parse_args()
    every = new.available(new.ROOT)
    unknown = set(args.families) - every.keys()
    if unknown:
        parser.error(f"no family {', '.join(sorted(unknown))}")
    families = {kind: every[kind] for kind in every if not args.families or kind in args.families}
    with tempfile.TemporaryDirectory(prefix="quasimc-new-") as folder:
        copy = Path(folder).resolve() / "quasimc"
        copy.mkdir()
        copy_tree(copy)
        for kind in families:
            new.create(copy, kind, NAME.format(kind))
        run([sys.executable, copy / "tools/check_layers.py", "--root", copy])
        leave_only_new_tests(copy, families)
        built = build(copy, args.jobs, families)
        test(copy, built, families)
        if "detector" in families:
            test_detector_in_python(built)


if __name__ == "__main__":
    main()
