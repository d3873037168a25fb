#!/usr/bin/env python3
"""Runs clang-tidy over our sources, in parallel, skipping what passed before unchanged.

A file is unchanged if its own text, our headers that it includes, its compile command, .clang-tidy
and the version of clang-tidy are.  The marks of files that passed stand in BUILD/tidy.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("src", "apps", "python", "tests", "bench")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def find_clang_tidy():
    for name in ("clang-tidy-14", "clang-tidy"):
        if shutil.which(name):
            return name
    sys.exit("tidy: clang-tidy is not installed (./dev setup check)")


def without_launcher(command):
    """The compile command without a leading ccache, which clang-tidy takes for the compiler."""
    words = command.split(" ")
    return " ".join(words[1:] if Path(words[0]).name == "ccache" else words)


def read_commands(build):
    """The compile command of each of our files, and a database of them that clang-tidy reads."""
    entries = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"])
        if path.is_relative_to(ROOT) and path.relative_to(ROOT).parts[0] in FOLDERS:
            entry["command"] = without_launcher(entry["command"])
            entries.append(entry)
    database = build / "tidy"
    database.mkdir(exist_ok=True)
    (database / "compile_commands.json").write_text(json.dumps(entries))
    return {Path(entry["file"]): entry["command"] for entry in entries}


def our_includes(path, include_roots, seen):
    """Adds a file and all of our headers below it to seen."""
    if path in seen:
        return
    seen.add(path)
    for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        for folder in (path.parent, *include_roots):
            if (folder / name).is_file():
                our_includes((folder / name).resolve(), include_roots, seen)
                break


def configuration_of(path):
    """The .clang-tidy files that govern a file."""
    folders = [folder for folder in path.parents if folder.is_relative_to(ROOT)]
    return [folder / ".clang-tidy" for folder in folders if (folder / ".clang-tidy").exists()]


def fingerprint(path, command, version, build):
    digest = hashlib.sha256(f"{version}\n{command}\n".encode())
    seen = set()
    our_includes(path, (ROOT / "src", ROOT / "tests", build / "generated"), seen)
    for part in sorted(seen) + configuration_of(path):
        digest.update(part.read_bytes())
    return digest.hexdigest()


def check(path, clang_tidy, build):
    """The complaints about one file, empty if it passes."""
    command = [
        *(["nice"] if shutil.which("nice") else []),
        clang_tidy,
        "--quiet",
        f"-p={build / 'tidy'}",
        "--extra-arg=-Wno-unknown-warning-option",
        "--extra-arg=-Wno-ignored-optimization-argument",
        str(path),
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return ""
    noise = re.compile(r"^(\d+ warnings? .*generated\.|Suppressed .*|Use -header-filter.*)\n", re.M)
    return noise.sub("", done.stdout + done.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/dev")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("paths", nargs="*", type=Path, help="files or folders; default: all")
    args = parser.parse_args()
    build = args.build.resolve()
    wanted = [path.resolve() for path in args.paths]
    clang_tidy = find_clang_tidy()
    version = subprocess.run(
        [clang_tidy, "--version"], capture_output=True, text=True, check=True
    ).stdout

    todo = {}
    commands = read_commands(build)
    for path, command in commands.items():
        if wanted and not any(path == want or path.is_relative_to(want) for want in wanted):
            continue
        mark = build / "tidy" / fingerprint(path, command, version, build)
        if not mark.exists():
            todo[path] = mark
    print(f"tidy: {len(todo)} of {len(commands)} files to check", flush=True)

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        running = {pool.submit(check, path, clang_tidy, build): path for path in todo}
        for future in concurrent.futures.as_completed(running):
            complaints = future.result()
            if complaints:
                failed += 1
                print(complaints, flush=True)
            else:
                todo[running[future]].touch()
    print(f"tidy: {failed} files with complaints")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
