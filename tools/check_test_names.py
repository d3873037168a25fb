#!/usr/bin/env python3
"""Checks that the names of the tests of a build folder are the same in every run, and unique.

ctest records duration and failure of a test by name (--rerun-failed), and the name in a report must
identify the test.
"""

import argparse
import collections
import json
import re
import subprocess
import sys
from pathlib import Path

# Output of GoogleTest for values without operator<<, and for pointers.
UNSTABLE = re.compile(r"-byte object <|\b0x[0-9a-fA-F]{6,}|GetParam\(\)")


def names_of(build, ctest):
    listing = subprocess.run(
        [ctest, "--test-dir", str(build), "--show-only=json-v1"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return [test["name"] for test in json.loads(listing)["tests"]]


def faults(names):
    """The faults of a list of names, one sentence each."""
    if not names:
        return ["there are no tests"]
    found = [f"an address or raw memory in: {name}" for name in names if UNSTABLE.search(name)]
    counts = collections.Counter(names)
    found += [f"{n} tests of one name: {name}" for name, n in counts.items() if n > 1]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ctest", default="ctest")
    parser.add_argument("build", type=Path)
    args = parser.parse_args()
    names = names_of(args.build, args.ctest)
    found = faults(names)
    for fault in found:
        print(fault)
    print(f"{len(names)} tests, {len(found)} faults of their names")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
