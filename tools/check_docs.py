#!/usr/bin/env python3
"""Runs the examples, and the code blocks of the documentation that are marked to run.

In README.md, CONTRIBUTING.md and docs/**/*.md, a block that opens with ```sh run is executed by
sh -e in a temporary copy of the tree, where ./dev run and quasimc are the program under test, and
a block that opens with ```toml run is given to "quasimc check".  Every examples/*/*.toml is run.

The table of results in README.md is compared with that of the first example: wrong_numbers().

Parts of docs/reference that the program prints must be up to date: write_reference.py.

missing_names() finds names in pages that the tree does not have: paths and names of files in `code`,
targets of links, and pages that sources name.
"""

import argparse
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from write_reference import outdated_pages

ROOT = Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^(?P<indent> *)```(?P<info>[^`\n]*)\n(?P<body>.*?)^ *```\s*$", re.M | re.S)
TIME_LIMIT_S = 300

# Names in a page: a path from the root, or the end of one, as "run.cpp" or "run/run.cpp".
FOLDERS = "apps|bench|cmake|data|docs|examples|include|python|src|tests|tools"
CODE = re.compile(r"`([^`\s]+)`")
PATH = re.compile(rf"(?:{FOLDERS})/[^\s:]*$")
FILE = re.compile(r"[\w/-]+\.(?:h|cpp|py|cmake|txt)$")
PLACEHOLDER = re.compile(r"\w*(?:NAME|FAMILY)|<|.*\*")  # any part of a path: NAME.cpp, *.cpp
LINK = re.compile(r"\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#+ +(.*?) *$", re.M)
PAGE_IN_SOURCE = re.compile(r"\bdocs/[\w/.-]+\.md\b")
SOURCE_SUFFIXES = {".h", ".cpp", ".py", ".cmake", ".txt", ".toml"}


def runnable_blocks(path):
    """The blocks of a page that are marked to run, as (line, language, text)."""
    text = path.read_text(encoding="utf-8")
    for match in FENCE.finditer(text):
        words = match["info"].split()
        if len(words) > 1 and words[1] == "run":
            indent = len(match["indent"])
            body = "".join(line[indent:] for line in match["body"].splitlines(keepends=True))
            yield text.count("\n", 0, match.start()) + 1, words[0], body


def without_blocks(text):
    """The text of a page with its code blocks empty, lines counted as before."""
    return FENCE.sub(lambda block: "\n" * block[0].count("\n"), text)


def anchors(page):
    """The names by which links find the headings of a page, as GitHub and Sphinx make them."""
    for heading in HEADING.findall(without_blocks(page.read_text(encoding="utf-8"))):
        plain = re.sub(r"[^\w\- ]", "", heading.lower())
        yield plain.replace(" ", "-")


def names_a_file(path, root, files):
    """Whether a path exists in the tree; for one with a placeholder, the folder before that."""
    parts = path.rstrip("/").split("/")
    fixed = next((i for i, part in enumerate(parts) if PLACEHOLDER.match(part)), None)
    if fixed is not None:
        return (root / "/".join(parts[:fixed])).is_dir()
    if PATH.match(path):
        return (root / path).exists()
    return any(file == path or file.endswith("/" + path) for file in files)


def faults_of_page(page, root, files):
    """Names in a page that the tree does not have, as (line, name)."""
    for number, line in enumerate(without_blocks(page.read_text(encoding="utf-8")).split("\n"), 1):
        for name in CODE.findall(line):
            is_path = PATH.match(name) or FILE.match(name)
            if is_path and not names_a_file(name, root, files):
                yield number, name
        for target in LINK.findall(CODE.sub("", line)):
            if re.match(r"\w+:", target):
                continue
            path, _, anchor = target.partition("#")
            there = (page.parent / path).resolve() if path else page
            if not there.exists() or (anchor and anchor not in anchors(there)):
                yield number, target


def missing_names(root=ROOT):
    """Names in pages and sources that the tree does not have, as "file:line: name"."""
    listed = [p for f in FOLDERS.split("|") for p in sorted((root / f).glob("**/*"))]
    files = [str(p.relative_to(root)) for p in listed if p.is_file()]
    pages = [*sorted(root.glob("*.md")), *(root / f for f in files if f.endswith(".md"))]
    pages = [page for page in pages if "templates" not in page.parts]
    for page in pages:
        for number, name in faults_of_page(page, root, files):
            yield f"{page.relative_to(root)}:{number}: {name}"
    for file in files:
        is_source = Path(file).suffix in SOURCE_SUFFIXES and not file.startswith("docs/")
        if is_source and not file.endswith("_test.py"):
            text = (root / file).read_text(encoding="utf-8", errors="replace")
            for number, line in enumerate(text.split("\n"), 1):
                for page in PAGE_IN_SOURCE.findall(line):
                    if Path(page).stem.lower() != "name" and not (root / page).exists():
                        yield f"{file}:{number}: {page}"


def rounds_to(value, shown):
    """Whether a number of a table, as it is shown, is the rounded value."""
    return format(float(value), f".{len(shown.partition('.')[2])}f") == shown


def wrong_numbers(page, table):
    """Numbers of a table of results in a page, in a block whose head begins with "id, name",
    that differ from those of a CSV table, as (row, column).  "..._se" is the error of the column
    before; "0 (below 0.5)" a value of 0 with its upper end."""
    with table.open(encoding="utf-8") as file:
        rows = {row["id"]: row for row in csv.DictReader(l for l in file if not l.startswith("#"))}
    blocks = [m["body"] for m in FENCE.finditer(page.read_text(encoding="utf-8"))]
    shown = next(body for body in blocks if body.startswith("id, name")).splitlines()
    columns = [name.strip() for name in shown[0].split(",")]
    for i, name in enumerate(columns):
        columns[i] = name.replace("...", columns[i - 1])
    for line in shown[1:]:
        cells = [cell.strip() for cell in line.split(",")]
        row = rows[cells[0]]
        for column, cell in list(zip(columns, cells))[2:]:
            value, _, end = cell.partition(" (below ")
            right = rounds_to(row[column], value)
            if end:
                right = right and rounds_to(row[column + "_ci95_high"], end.rstrip(")"))
            if not right:
                yield cells[1], column


def copy_tree(target):
    """A copy of the files of the repository, without build outputs."""
    skip = shutil.ignore_patterns(".git", "build", "__pycache__", "node_modules", ".cache")
    shutil.copytree(ROOT, target, ignore=skip, symlinks=True)


def run(command, folder, environment):
    """The error of a command, or None."""
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
    """All cases to run, as (location, command, folder)."""
    pages = [copy / "README.md", copy / "CONTRIBUTING.md", *sorted(copy.glob("docs/**/*.md"))]
    for page in filter(Path.exists, pages):
        for line, language, text in runnable_blocks(page):
            location = f"{page.relative_to(copy)}:{line}"
            if language == "sh":
                yield location, ["sh", "-e", "-c", text], copy
            elif language == "toml":
                file = page.parent / f"{page.stem}_line_{line}.toml"
                file.write_text(text, encoding="utf-8")
                yield location, [program, "check", file.name], page.parent
            else:
                yield location, ["sh", "-c", f"echo 'cannot run {language}'; exit 1"], copy
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
    for missing in missing_names():
        failed += 1
        print(f"{missing}: there is no such thing", file=sys.stderr)
    for page in outdated_pages(str(program)):
        failed += 1
        print(f"{page.relative_to(ROOT)}: outdated; run tools/write_reference.py", file=sys.stderr)
    with tempfile.TemporaryDirectory(prefix="quasimc-docs-") as folder:
        copy = Path(folder) / "quasimc"
        copy_tree(copy)
        (copy / "build/release/bin").mkdir(parents=True)
        (copy / "build/release/bin/quasimc").symlink_to(program)
        environment = dict(os.environ, QUASIMC_PROGRAM=str(program))
        environment["PATH"] = f"{program.parent}{os.pathsep}{environment['PATH']}"
        for location, command, where in cases(copy, str(program)):
            count += 1
            problem = run(command, where, environment)
            if problem:
                failed += 1
                print(f"{location}: {problem}", file=sys.stderr)
        readme, table = copy / "README.md", copy / "examples/01-leaves/leaves.csv"
        for name, column in wrong_numbers(readme, table):
            failed += 1
            print(f"README.md: {name}: {column} is not what the run gives", file=sys.stderr)
    print(f"docs: {count} blocks and examples run, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
