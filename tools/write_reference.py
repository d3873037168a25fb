#!/usr/bin/env python3
"""Writes the parts of docs/reference that the program prints: options and flags.

A part of a page begins with <!-- quasimc ARGUMENTS --> and ends with <!-- end -->.  Tables that
`quasimc list ...-markdown` prints are copied; `quasimc COMMAND --help` becomes a table of flags,
without the options of a run.  With --check nothing is written, and outdated pages are an error.
"""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/reference"
PART = re.compile(r"(<!-- quasimc (?P<words>[^>]*) -->\n).*?(<!-- end -->)", re.S)
FLAG = re.compile(r"^  (?P<flag>\S.*?)(?:  +(?P<text>\S.*))?$")


def printed(program, words):
    """The output of the program for these arguments."""
    unfolded = dict(os.environ, COLUMNS="100000")
    command = [program, *words.split()]
    return subprocess.run(
        command, env=unfolded, stdout=subprocess.PIPE, text=True, check=True
    ).stdout


def flag_table(text, options):
    """A Markdown table of the flags in a text of --help that are not options of a run."""
    rows = []
    for line in text[text.index("\nUsage:") :].splitlines():
        match = FLAG.match(line)
        if match:
            rows.append([match["flag"], match["text"] or ""])
        elif line.startswith("   ") and rows:
            rows[-1][1] = line.strip()
    lines = ["| Flag | Meaning |", "|---|---|"]
    for flag, meaning in rows:
        name = flag.split()[0].split(",")[-1]
        if name != "--help" and name not in options:
            lines.append(f"| `{flag.replace(',-', ', -')}` | {meaning} |")
    return "\n".join(lines) + "\n"


def rewritten(page, program):
    """A page with its parts as this program prints them."""
    options = re.findall(r"`(--[\w-]+)`", printed(program, "list options-markdown"))

    def part(match):
        text = printed(program, match["words"])
        if match["words"].endswith("--help"):
            text = flag_table(text, options)
        return match[1] + text.strip() + "\n" + match[3]

    return PART.sub(part, page)


def outdated_pages(program, write=False):
    """Pages whose parts differ from what the program prints; writes them anew if asked to."""
    for path in sorted(PAGES.glob("*.md")):
        page = path.read_text(encoding="utf-8")
        new = rewritten(page, program) if PART.search(page) else page
        if new != page:
            if write:
                path.write_text(new, encoding="utf-8")
            yield path


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/quasimc")
    parser.add_argument("--check", action="store_true", help="write nothing")
    arguments = parser.parse_args()
    pages = list(outdated_pages(str(arguments.program.resolve()), write=not arguments.check))
    for page in pages:
        print(f"{page.relative_to(ROOT)}: {'outdated' if arguments.check else 'written'}")
    return 1 if pages and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main())
