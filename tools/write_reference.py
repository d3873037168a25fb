#!/usr/bin/env python3
"""Writes the parts of docs/reference that the program prints: options and flags.

A part of a page begins with <!-- quasimc ARGUMENTS --> and ends with <!-- end -->.  Tables that
`quasimc list ...-markdown` prints are copied; `quasimc COMMAND --help` becomes a table of flags,
without the options of a run.  With --check nothing is written, and outdated pages are an error.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/reference"
PART = re.compile(r"(<!-- quasimc (?P<words>[^>]*) -->\n).*?(<!-- end -->)", re.S)
FLAG = re.compile(r"^  (?P<flag>-\S.*?|[A-Z]+\b.*?)(?:  +(?P<text>\S.*))?$")
RANGE = re.compile(
    r":?\b(?:TEXT|UINT|INT|FLOAT|NUMBER|REQUIRED|Excludes: \S+|Needs: \S+)\b"
    r"(?::?\{[^}]*\})?(?: \.\.\.)?"
)


def printed(program, words):
    """What the program prints for these arguments."""
    done = subprocess.run([program, *words.split()], stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def described_flags(text):
    """The flags in a text of --help, as pairs of the flag and its description."""
    flags = []
    for line in text.split("\n"):
        match = FLAG.match(line)
        if match:
            flags.append([match["flag"], match["text"] or ""])
        elif flags and line.startswith("        "):
            flags[-1][1] = f"{flags[-1][1]} {line.strip()}".strip()
        elif line and not line.startswith(" ") and flags and not line.endswith(":"):
            break
    return flags


def flag_table(text, options):
    """A Markdown table of the flags in a text of --help that are not options of a run."""
    rows = []
    for flag, description in described_flags(text):
        name = re.search(r"--[\w-]+", flag)
        if "--help" in flag or (name and name[0] in options):
            continue
        plain = " ".join(RANGE.sub("", flag).replace(",", ", ").split())
        rows.append(f"| `{plain}` | {description} |".replace("|`", "\\|`"))
    return "\n".join(["| Flag | Meaning |", "|---|---|", *rows]) + "\n"


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
