"""tidy.py: the selection of files. (The findings of clang-tidy are not tested.)"""

import unittest
from pathlib import Path
from unittest import mock

import changes
import tidy

A, B, C = (Path(f"/tree/src/{name}.cpp") for name in "abc")
A_H, DEEP_H = Path("/tree/src/a.h"), Path("/tree/src/deep.h")
READ_BY = {A: {A, A_H, DEEP_H}, B: {B, A_H, DEEP_H}, C: {C, DEEP_H}}


class AffectedBy(unittest.TestCase):
    def test_a_source_that_changed_comes_alone(self):
        self.assertEqual(tidy.affected_by({C}, READ_BY, ""), [C])

    def test_a_header_brings_its_own_source_first_and_then_its_readers(self):
        for turn in ("1", "2", "3"):
            self.assertEqual(tidy.affected_by({A_H}, READ_BY, turn), [A, B])

    def test_what_changed_comes_before_what_reads_it(self):
        for turn in ("1", "2", "3"):
            found = tidy.affected_by({C, DEEP_H}, READ_BY, turn)
            self.assertEqual(found[0], C)
            self.assertEqual(set(found), {A, B, C})

    def test_what_no_source_reads_brings_nothing(self):
        self.assertEqual(tidy.affected_by({Path("/tree/README.md")}, READ_BY, ""), [])


class IncludesOf(unittest.TestCase):
    def test_public_and_private_headers(self):
        found = tidy.includes_of(tidy.ROOT / "src/run/run.cpp", Path("/none"))
        self.assertIn(tidy.ROOT / "include/quasimc/run.h", found)
        self.assertIn(tidy.ROOT / "src/run/rounds.h", found)


class Choose(unittest.TestCase):
    def choose(self, found, at_most=40):
        paths = [tidy.ROOT / f"src/f{i}.cpp" for i in range(100)]
        with mock.patch.object(changes, "find_changes", return_value=found), mock.patch.object(
            tidy, "includes_of", lambda path, build: {path}
        ):
            return tidy.choose(paths, None, Path("build"), at_most)

    def test_a_sample_where_changes_are_not_known(self):
        chosen, why = self.choose(changes.Changes(None, "the history holds one commit"))
        self.assertEqual(len(chosen), tidy.SAMPLE)
        self.assertIn("sample", why)

    def test_at_most_so_many_and_the_rest_is_named(self):
        files = {tidy.ROOT / f"src/f{i}.cpp" for i in range(70)}
        chosen, why = self.choose(changes.Changes(files, "changed"))
        self.assertEqual(len(chosen), 40)
        self.assertIn("30 more are left", why)

    def test_other_rules_concern_every_file(self):
        rules = changes.Changes({tidy.ROOT / ".clang-tidy"}, "changed")
        self.assertEqual(len(self.choose(rules, at_most=1000)[0]), 100)


if __name__ == "__main__":
    unittest.main()
