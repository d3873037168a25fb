#!/usr/bin/env python3
"""Runs clang's static analyzer over the library, each module as the file that its sources are joined into.

Per source, most of its time would go into the same headers.  By default the analyzer omits functions of
included files, hence -analyzer-opt-analyze-headers.
"""

import argparse
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import tidy

ROOT = Path(__file__).resolve().parent.parent
# clang-tidy 14 reports a returned std::unique_ptr as a leak; the address sanitizer finds true ones.
UNFIT = "-clang-analyzer-cplusplus.NewDeleteLeaks"
FINDING = re.compile(r"^(/[^:\n]+):\d+:\d+: (warning|error): .*$", re.MULTILINE)


def joined_files(build):
    """The compile commands of the joined files of the library."""
    entries = json.loads((build / "compile_commands.json").read_text())
    return [
        {**entry, "command": tidy.without_launcher(entry["command"])}
        for entry in entries
        if "/Unity/unity_" in entry["file"] and Path(entry["file"]).is_relative_to(build / "src")
    ]


def findings(text, folder):
    """The findings in a folder, each once."""
    findings = (match for match in FINDING.finditer(text) if Path(match[1]).is_relative_to(folder))
    return list(dict.fromkeys(match[0] for match in findings))


def analyze(path, database, folder, clang_tidy):
    """The findings in a joined file, and whether it could be compiled."""
    command = [
        clang_tidy, "--quiet", f"-p={database}",
        f"--checks=-*,{','.join(check.removeprefix('-') for check in tidy.QUICK_LESS)},{UNFIT}",
        "--header-filter=.*",
        "--extra-arg=-Wno-unknown-warning-option",
        "--extra-arg=-Wno-ignored-optimization-argument",
        "--extra-arg=-UNDEBUG",  # variables of checks are used
        "--extra-arg=-Xclang", "--extra-arg=-analyzer-opt-analyze-headers",
        str(path),
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    found = findings(done.stdout, folder)
    return found if found or done.returncode == 0 else [done.stdout + done.stderr]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    args = parser.parse_args()
    entries = joined_files(args.build.resolve())
    if not entries:
        sys.exit(f"analyze: {args.build} joins no files (QUASIMC_UNITY=all)")
    clang_tidy = tidy.find_clang_tidy()
    failed = 0
    with tempfile.TemporaryDirectory() as database:
        (Path(database) / "compile_commands.json").write_text(json.dumps(entries))
        shutil.copy(ROOT / ".clang-tidy", database)
        paths = sorted((Path(entry["file"]) for entry in entries), key=lambda path: -path.stat().st_size)
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            for found in pool.map(lambda path: analyze(path, database, ROOT, clang_tidy), paths):
                failed += bool(found)
                print("\n".join(found), end="\n" if found else "", flush=True)
    print(f"analyze: {len(paths)} modules, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
