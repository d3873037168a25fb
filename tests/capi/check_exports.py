#!/usr/bin/env python3
"""Compares what a shared library shows with the functions of its header."""

import re
import subprocess
import sys


def exported(nm, library):
    said = subprocess.run(
        [nm, "-D", "--defined-only", library], check=True, capture_output=True, text=True
    ).stdout
    symbols = (line.split() for line in said.splitlines())
    # Of "A" is the name of the version itself.
    return {s[-1].split("@")[0] for s in symbols if s[-2] != "A"}


def declared(header):
    with open(header, encoding="utf-8") as file:
        text = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)
    return set(re.findall(r"\b(quasimc_\w+)\(", text))


def main():
    nm, library, header = sys.argv[1:]
    shown, stated = exported(nm, library), declared(header)
    assert len(stated) > 40, "the header was not understood"
    for name in sorted(shown - stated):
        print(f"shown, and not in the header: {name}")
    for name in sorted(stated - shown):
        print(f"in the header, and not shown: {name}")
    return 1 if shown != stated else 0


if __name__ == "__main__":
    sys.exit(main())
