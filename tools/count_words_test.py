"""count_words.py: what it must find, and what it must leave alone."""

import subprocess
import tempfile
import unittest
from pathlib import Path

import count_words

TABLE = r"""# Glossary

Text with a | that is no table.

| Id | Expressions | Files | Allowed |
|---|---|---|---|
| hat | `(?<!\\)\bhats?\b` | | LaTeX's command |
| place | `\b[Pp]laces?\b` `\w+_places\b` | | `\bin place\b` `decimal places` |
| fault | `\bfaults?\b` | `docs/*.md` `python/*` | |
| find | `\b(few\|many) finds\b` | | |

| hat | `not this table` | | |
"""
ROWS = list(count_words.rows_of(TABLE))


def words_in(path, text):
    return sorted(word for word, _ in count_words.count(ROWS, [(path, text)]))


class CountWords(unittest.TestCase):
    def test_the_table_is_read(self):
        self.assertEqual([row.word for row in ROWS], ["hat", "place", "fault", "find"])
        self.assertEqual(ROWS[3].expressions[0].pattern, r"\b(few|many) finds\b")
        self.assertEqual(ROWS[2].files, ["docs/*.md", "python/*"])

    def test_words_are_found_with_their_lines(self):
        found = count_words.count(ROWS, [("src/a.cpp", "one\nthe hat\nfew finds, bin_places")])
        self.assertEqual(found["hat", "src/a.cpp"], [(2, "hat")])
        self.assertEqual(found["find", "src/a.cpp"], [(3, "few finds")])
        self.assertEqual(found["place", "src/a.cpp"], [(3, "bin_places")])

    def test_allowed_contexts_are_no_occurrence(self):
        self.assertEqual(words_in("a.md", r"$\hat x$, in place, two decimal places"), [])
        self.assertEqual(words_in("a.md", "in place of a place"), ["place"])

    def test_a_row_can_be_for_some_files(self):
        self.assertEqual(words_in("src/a.cpp", "a fault"), [])
        self.assertEqual(words_in("docs/guide/a.md", "a fault"), ["fault"])

    def test_a_new_occurrence_is_an_error(self):
        found = count_words.count(ROWS, [("a.md", "a hat and a hat")])
        self.assertEqual(len(list(count_words.new_ones(found, {}))), 1)
        self.assertEqual(len(list(count_words.new_ones(found, {("hat", "a.md"): 1}))), 1)
        self.assertEqual(list(count_words.new_ones(found, {("hat", "a.md"): 2})), [])

    def test_what_is_written_is_read_again_and_comments_are_kept(self):
        found = count_words.count(ROWS, [("a b.md", "a hat and a place")])
        text = count_words.written(found, "# hat: a reason\nhat 7 gone.md\n")
        self.assertTrue(text.startswith("# hat: a reason\n"))
        self.assertEqual(
            count_words.read_allowed(text), {("hat", "a b.md"): 1, ("place", "a b.md"): 1}
        )

    def test_only_files_in_git_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "a.md").write_text("a hat")
            (root / "b.md").write_text("a hat")
            (root / "c.png").write_text("a hat")
            for command in (["init", "-q"], ["add", "a.md", "c.png"]):
                subprocess.run(["git", *command], cwd=root, check=True)
            self.assertEqual([path for path, _ in count_words.texts(root)], ["a.md"])

    def test_the_glossary_of_the_project_is_read(self):
        rows = list(count_words.rows_of((count_words.ROOT / count_words.GLOSSARY).read_text()))
        self.assertGreater(len(rows), 20)
        self.assertTrue(all(row.expressions for row in rows))
        self.assertEqual(len({row.word for row in rows}), len(rows))
        reasons = (count_words.ROOT / count_words.ALLOWED).read_text()
        for row in rows:
            self.assertIn(f"\n# {row.word}: ", reasons)


if __name__ == "__main__":
    unittest.main()
