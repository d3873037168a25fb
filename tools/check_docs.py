#!/usr/bin/env python3
"""Runs what the documentation shows: every example, and every code block that is marked to run.

In README.md, CONTRIBUTING.md and docs/**/*.md, a block that opens with ```sh run is executed by
sh -e in a temporary copy of the tree, where ./dev run and quasimc are the program under test, and
a block that opens with ```toml run is given to "quasimc check".  Every examples/*/*.toml is run.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^(?P<indent> *)```(?P<info>[^`\n]*)\n(?P<body>.*?)^ *```\s*$", re.M | re.S)
TIME_LIMIT_S = 300


def runnable_blocks(path):
    """The blocks of a page that are marked to run, as (line, language, text)."""
    text = path.read_text(encoding="utf-8")
    for match in FENCE.finditer(text):
        words = match["info"].split()
        if len(words) > 1 and words[1] == "run":
            indent = len(match["indent"])
            body = "".join(line[indent:] for line in match["body"].splitlines(keepends=True))
            yield text.count("\n", 0, match.start()) + 1, words[0], body


def copy_tree(target):
    """A copy of what the repository holds, without what was built."""
    skip = shutil.ignore_patterns(".git", "build", "__pycache__", "node_modules", ".cache")
    shutil.copytree(ROOT, target, ignore=skip, symlinks=True)


def run(command, folder, environment):
    """What went wrong, or None."""
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=TIME_LIMIT_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"not done after {TIME_LIMIT_S} s"
    return None if done.returncode == 0 else f"exit status {done.returncode}\n{done.stdout}"


def cases(copy, program):
    """Everything to run, as (place, command, folder)."""
    pages = [copy / "README.md", copy / "CONTRIBUTING.md", *sorted(copy.glob("docs/**/*.md"))]
    for page in filter(Path.exists, pages):
        for line, language, text in runnable_blocks(page):
            place = f"{page.relative_to(copy)}:{line}"
            if language == "sh":
                yield place, ["sh", "-e", "-c", text], copy
            elif language == "toml":
                file = page.parent / f"{page.stem}_line_{line}.toml"
                file.write_text(text, encoding="utf-8")
                yield place, [program, "check", file.name], page.parent
            else:
                yield place, ["sh", "-c", f"echo 'cannot run {language}'; exit 1"], copy
    for example in sorted(copy.glob("examples/*/*.toml")):
        command = [program, "run", str(example.relative_to(copy))]
        yield str(example.relative_to(copy)), command, copy


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/quasimc")
    program = parser.parse_args().program.resolve()
    if not program.exists():
        sys.exit(f"docs: {program} is missing; build it first (./dev build)")

    count, failed = 0, 0
    with tempfile.TemporaryDirectory(prefix="quasimc-docs-") as folder:
        copy = Path(folder) / "quasimc"
        copy_tree(copy)
        (copy / "build/release/bin").mkdir(parents=True)
        (copy / "build/release/bin/quasimc").symlink_to(program)
        environment = dict(os.environ, QUASIMC_PROGRAM=str(program))
        environment["PATH"] = f"{program.parent}{os.pathsep}{environment['PATH']}"
        for place, command, where in cases(copy, str(program)):
            count += 1
            problem = run(command, where, environment)
            if problem:
                failed += 1
                print(f"{place}: {problem}", file=sys.stderr)
    print(f"docs: {count} blocks and examples run, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
