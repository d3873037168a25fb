#!/usr/bin/env python3
"""Starts a new sampler, source, bsdf or format: tools/new.py sampler halton

Copies the simplest member of the family and its test under the new name, adds both to their
CMakeLists.txt, and prints what is left to do.  What was copied compiles at once, so the work starts
from something that runs.
"""

import argparse
import re
import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Family:
    module: str  # the folder under src/quasimc and under tests/unit
    model: str  # the member that is copied
    left_to_do: str


FAMILIES = {
    "sampler": Family("samplers", "monte_carlo", "add its row to src/samplers/catalogue.cpp"),
    "source": Family("sources", "uniform_sky", "add its row to src/quasimc/sources/catalogue.cpp"),
    "bsdf": Family("optics", "phong", "add its row to src/optics/catalogue.cpp"),
    "format": Family(
        "io",
        "read_tri",
        "add its row to src/io/meshes/formats.cpp, its inputs to tests/fuzz/corpus/, "
        "its page to docs/formats/",
    ),
}


def cap_words(name):
    return "".join(word.capitalize() for word in name.split("_"))


def renamed(text, old, new):
    """The text with the name changed in all of its spellings: a_b, AB, "a b"."""
    for spell in (str, cap_words, lambda name: name.replace("_", " ")):
        text = re.sub(rf"(?<![a-z0-9]){re.escape(spell(old))}(?![a-z])", spell(new), text)
    return text


def add_to_cmake(path, old, new):
    """Lists the new file right after the one it was copied from."""
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(old, f"{old} {new}", 1), encoding="utf-8")


def create(root, kind, name):
    """Writes the files of a new member; returns their paths."""
    family = FAMILIES[kind]
    old = family.model
    new = f"read_{name}" if kind == "format" else name
    written = []
    source_folder = root / "src/quasimc" / family.module
    test_folder = root / "tests/unit" / family.module
    for folder, old_file, new_file in (
        (source_folder, f"{old}.h", f"{new}.h"),
        (source_folder, f"{old}.cpp", f"{new}.cpp"),
        (test_folder, f"{old}_test.cpp", f"{new}_test.cpp"),
    ):
        if not (folder / old_file).exists():
            continue
        if (folder / new_file).exists():
            sys.exit(f"{folder / new_file} exists already")
        text = renamed((folder / old_file).read_text(encoding="utf-8"), old, new)
        if kind == "format":
            text = renamed(text, old.removeprefix("read_"), name)
        (folder / new_file).write_text(text, encoding="utf-8")
        written.append(folder / new_file)
        cmake = folder / "CMakeLists.txt"
        if new_file.endswith(".cpp") and cmake.exists():
            add_to_cmake(cmake, old_file, new_file)
    return written


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=FAMILIES)
    parser.add_argument("name", help="snake_case")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    args = parser.parse_args()
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", args.name):
        parser.error(f"{args.name}: write the name in snake_case")
    for path in create(args.root, args.kind, args.name):
        print(f"wrote {path.relative_to(args.root)}")
    print(f"Now write the model itself, and {FAMILIES[args.kind].left_to_do}.")


if __name__ == "__main__":
    main()
