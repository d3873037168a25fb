#!/usr/bin/env python3
"""Checks that no outlawed expression of docs/develop/glossary.md is used where it was not used before.

The glossary's last table has the expressions, the files in which each is sought, and the contexts
that are allowed, which are blanked first.  docs/develop/glossary-allowed.txt has the occurrences that
remain, by word and file, with a reason for each word.  More than these is an error.

    tools/count_words.py              check
    tools/count_words.py --list ID    every occurrence of one row, or of all of them: --list all
    tools/count_words.py --update     write glossary-allowed.txt anew; its comments are kept
"""

import argparse
import re
import subprocess
import sys
from collections import defaultdict
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
GLOSSARY = "docs/develop/glossary.md"
ALLOWED = "docs/develop/glossary-allowed.txt"
SUFFIXES = set(".h .cpp .in .c .py .pyi .ipynb .js .mjs .html .css .toml .md .sh .cmake".split())
CODE = re.compile(r"`([^`]+)`")


@dataclass(frozen=True)
class Row:
    """One row of the glossary's table of expressions."""

    word: str
    expressions: list  # compiled
    files: list  # patterns of paths; none: every file
    contexts: list  # compiled; what they match is no occurrence

    def matches(self, path):
        return not self.files or any(fnmatch(path, pattern) for pattern in self.files)

    def occurrences(self, text):
        """Those in a text, as (line, expression found)."""
        for context in self.contexts:
            text = context.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
        for expression in self.expressions:
            for match in expression.finditer(text):
                found = match[0].strip().split("\n")[-1]
                yield text.count("\n", 0, match.end()) + 1, found


def rows_of(glossary):
    """The rows of the table whose head begins with "| Id |"."""
    lines = iter(glossary.splitlines())
    next((line for line in lines if line.startswith("| Id |")), None)
    next(lines, None)
    for line in lines:
        if not line.startswith("|"):
            break
        cells = re.split(r"(?<!\\)\|", line)[1:-1]
        word, *columns = cells
        expressions, files, contexts = ([c.replace(r"\|", "|") for c in CODE.findall(x)] for x in columns)
        compiled = [[re.compile(e) for e in column] for column in (expressions, contexts)]
        yield Row(word.strip(), compiled[0], files, compiled[1])


def texts(root):
    """Path and text of every file that git tracks and a person writes."""
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True)
    for path in listed.stdout.splitlines():
        if Path(path).suffix in SUFFIXES and path != GLOSSARY and (root / path).is_file():
            yield path, (root / path).read_text(encoding="utf-8", errors="replace")


def count(rows, files):
    """{(word, path): [(line, expression found), ...]}"""
    found = defaultdict(list)
    for path, text in files:
        for row in rows:
            if row.matches(path) and (there := list(row.occurrences(text))):
                found[row.word, path] += there
    return found


def read_allowed(text):
    """{(word, path): number} of lines "word number path"."""
    lines = [line.split(maxsplit=2) for line in text.splitlines() if line and line[0] != "#"]
    return {(word, path): int(number) for word, number, path in lines}


def written(found, former):
    """The text of glossary-allowed.txt: the comments of the former one, and what was found."""
    comments = [line for line in former.splitlines() if line.startswith("#")]
    lines = [f"{word} {len(there)} {path}" for (word, path), there in sorted(found.items())]
    return "\n".join([*comments, *lines]) + "\n"


def new_ones(found, allowed):
    """A sentence for every file that has more occurrences of a word than are allowed."""
    for (word, path), there in sorted(found.items()):
        number = allowed.get((word, path), 0)
        if len(there) > number:
            lines = ", ".join(f"line {line}: {text}" for line, text in sorted(there))
            yield f"{path}: '{word}' occurs {len(there)} times, {number} are allowed ({lines})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", metavar="ID")
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--root", type=Path, default=ROOT)
    args = parser.parse_args()
    rows = list(rows_of((args.root / GLOSSARY).read_text(encoding="utf-8")))
    if not rows:
        sys.exit(f"{GLOSSARY}: has no table of expressions")
    found = count(rows, texts(args.root))
    total = sum(map(len, found.values()))
    if args.list:
        for (word, path), there in sorted(found.items()):
            for line, text in sorted(there) if args.list in (word, "all") else ():
                print(f"{path}:{line}: {text}" + (f" ({word})" if args.list == "all" else ""))
        return 0
    former = (args.root / ALLOWED).read_text(encoding="utf-8") if (args.root / ALLOWED).exists() else ""
    if args.update:
        (args.root / ALLOWED).write_text(written(found, former), encoding="utf-8")
        print(f"{ALLOWED}: {total} occurrences")
        return 0
    errors = list(new_ones(found, read_allowed(former)))
    for error in errors:
        print(error)
    print(f"words: {total} outlawed expressions, {len(errors)} files with new ones")
    if errors:
        print(f"Use the term of {GLOSSARY}; if the word is right there: {Path(__file__).name} --update")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
