"""write_reference.py: tables of flags from --help, and pages that are outdated."""

import tempfile
import unittest
from pathlib import Path
from unittest import mock

import write_reference

HELP = """draw a picture

Usage: quasimc show [OPTIONS] FILE

Arguments:
  FILE                    JSON result

Options:
  -o,--output FILE        picture to write
  --checkpoint-interval X
                          seconds between saves (default 60)
  --paths N               an option of the run

Help:
  -h,--help               print this help

Exit status: 0 done
"""

PROGRAM = """#!/bin/sh
if [ "$1" = list ]; then echo '| `--paths` |'; else echo "printed $*"; fi
"""


class WriteReference(unittest.TestCase):
    def test_flags_are_a_table_without_help_and_options_of_the_run(self):
        table = write_reference.flag_table(HELP, ["--paths"])
        self.assertEqual(
            table.splitlines()[2:],
            [
                "| `FILE` | JSON result |",
                "| `-o, --output FILE` | picture to write |",
                "| `--checkpoint-interval X` | seconds between saves (default 60) |",
            ],
        )

    def test_outdated_parts_are_found_and_written(self):
        with tempfile.TemporaryDirectory() as folder:
            program, page = Path(folder) / "program", Path(folder) / "page.md"
            program.write_text(PROGRAM)
            program.chmod(0o755)
            page.write_text("before\n<!-- quasimc a b -->\nold\n<!-- end -->\nafter\n")
            with mock.patch.object(write_reference, "PAGES", Path(folder)):
                self.assertEqual(list(write_reference.outdated_pages(str(program))), [page])
                list(write_reference.outdated_pages(str(program), write=True))
                self.assertEqual(list(write_reference.outdated_pages(str(program))), [])
            self.assertIn("\n<!-- quasimc a b -->\nprinted a b\n<!-- end -->\n", page.read_text())


if __name__ == "__main__":
    unittest.main()
