#!/usr/bin/env python3
"""Runs clang-tidy over our sources, in parallel, skipping unchanged files that passed before.

--quick omits the checks of QUICK_LESS; --changed also omits files that do not differ from the main
branch, themselves or by a header.  A file is unchanged if its own text, our headers that it includes,
its compile command, .clang-tidy and the version of clang-tidy are.  The marks of files that passed
are in BUILD/tidy.
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

import changes

ROOT = Path(__file__).resolve().parent.parent
INCLUDE_ROOTS = (ROOT / "include", ROOT / "src", ROOT / "tests")
FOLDERS = ("src", "apps", "python", "tests", "bench")
# Checks that take three quarters of the time and seldom find anything; tools/analyze.py runs them on
# modules.
QUICK_LESS = ("-clang-analyzer-*", "-performance-unnecessary-value-param")
SAMPLE = 20  # files, if the changed ones are unknown
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def find_clang_tidy():
    for name in ("clang-tidy-14", "clang-tidy"):
        if shutil.which(name):
            return name
    sys.exit("tidy: clang-tidy is not installed (./dev setup check)")


def without_launcher(command):
    """The compile command without a leading ccache, which clang-tidy would mistake for the compiler."""
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


def includes_of(path, build):
    """A file and all of our headers below it."""
    seen = set()
    our_includes(path, INCLUDE_ROOTS + (build / "generated",), seen)
    return seen


def fingerprint(path, command, version, build):
    digest = hashlib.sha256(f"{version}\n{command}\n".encode())
    for part in sorted(includes_of(path, build)) + configuration_of(path):
        digest.update(part.read_bytes())
    return digest.hexdigest()


def rotated(paths, turn):
    """The paths in a different order at every turn."""
    return sorted(paths, key=lambda path: hashlib.sha256(f"{turn} {path}".encode()).digest())


def affected_by(changed, read_by, turn):
    """The sources to check, the most relevant first.

    These are the changed ones; one for each changed header, its own if there is one; and all others
    that read a changed file.
    @param read_by  the files that each source reads, itself among them
    """
    sources = sorted(path for path in read_by if path in changed)
    for header in sorted(changed):
        readers = [path for path in rotated(read_by, turn) if header in read_by[path]]
        own = [path for path in readers if path.stem == header.stem]
        sources += [*own, *readers][:1]
    others = [path for path in rotated(read_by, turn) if changed & read_by[path]]
    return list(dict.fromkeys([*sources, *others]))


def choose(paths, since, build, at_most):
    """The files to check, and a text that gives the reason."""
    turn = changes.git(ROOT, "rev-parse", "HEAD") or ""
    found = changes.find_changes(ROOT, since)
    if found.files is None:
        return rotated(paths, turn)[:SAMPLE], f"a sample, for {found.why}"
    read_by = {path: includes_of(path, build) | set(configuration_of(path)) for path in paths}
    affected = affected_by(found.files, read_by, turn)
    chosen = affected[:at_most]
    left = len(affected) - len(chosen)
    return chosen, found.why + (f"; {left} more are left for --full" if left else "")


def check(path, clang_tidy, build, quick):
    """The complaints about one file, empty if it passes."""
    command = [
        *(["nice"] if shutil.which("nice") else []),
        clang_tidy,
        "--quiet",
        *([f"--checks={','.join(QUICK_LESS)}"] if quick else []),
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


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/dev")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--quick", action="store_true", help="without the static analyzer")
    parser.add_argument("--changed", action="store_true", help="only what changed, and quickly")
    parser.add_argument("--since", metavar="COMMIT", help="changed since then")
    parser.add_argument("--at-most", type=int, default=40, help="files, with --changed")
    parser.add_argument("paths", nargs="*", type=Path, help="files or folders; default: all")
    return parser.parse_args()


def main():
    args = parse_arguments()
    quick = args.quick or args.changed
    build = args.build.resolve()
    wanted = [path.resolve() for path in args.paths]
    clang_tidy = find_clang_tidy()
    version = subprocess.run(
        [clang_tidy, "--version"], capture_output=True, text=True, check=True
    ).stdout

    commands = {
        path: command
        for path, command in read_commands(build).items()
        if not wanted or any(path == want or path.is_relative_to(want) for want in wanted)
    }
    if not commands:
        sys.exit(f"tidy: {build} compiles none of these files by itself (QUASIMC_UNITY=none)")
    chosen, why = list(commands), "all"
    if args.changed:
        chosen, why = choose(list(commands), args.since, build, args.at_most)
    todo = {}
    for path in chosen:
        mark = build / "tidy" / fingerprint(path, commands[path], version, build)
        quick_mark = mark.with_suffix(".quick")
        if not mark.exists() and not (quick and quick_mark.exists()):
            todo[path] = quick_mark if quick else mark
    print(f"tidy: {len(chosen)} of {len(commands)} files ({why}), "
          f"{len(chosen) - len(todo)} of which passed before", flush=True)

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        running = {pool.submit(check, path, clang_tidy, build, quick): path for path in todo}
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
