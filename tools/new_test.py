"""new.py: a new member costs three files and its entries in lists; every family is tried."""

import shutil
import tempfile
import unittest
from pathlib import Path

import new

ROOT = new.ROOT
NAME = "trial_member"


class Spellings(unittest.TestCase):
    def test_a_name_is_filled_in_in_all_its_spellings(self):
        family = new.FAMILIES["format"]
        text = "@name@ @Name@ '@words@' '@Title@' @page@ @member@ @test@"
        self.assertEqual(
            new.filled(text, family, "open_leaf"),
            "open_leaf OpenLeaf 'open leaf' 'Open leaf' open-leaf "
            "src/meshio/read_open_leaf.cpp tests/unit/meshio/read_open_leaf_test.cpp",
        )


class Lists(unittest.TestCase):
    def test_an_entry_goes_above_its_mark(self):
        text = "a\n    // (tools/new.py enters a leaf above this line)\nb\n"
        self.assertEqual(
            new.with_entry(text, "enters a leaf", "x\ny"),
            "a\nx\ny\n    // (tools/new.py enters a leaf above this line)\nb\n",
        )

    def test_a_mark_must_be_there_once(self):
        with self.assertRaises(ValueError):
            new.with_entry("a\n", "enters a leaf", "x")
        mark = "// (tools/new.py enters a leaf above this line)\n"
        with self.assertRaises(ValueError):
            new.with_entry(mark + mark, "enters a leaf", "x")

    def test_a_source_keeps_the_order_of_the_alphabet(self):
        text = "quasimc_test(\n    NAME a\n    SOURCES b.cpp\n            d.cpp\n    LIBS x)\n"
        self.assertIn("SOURCES a.cpp\n            b.cpp\n", new.with_source(text, "a.cpp"))
        self.assertIn("b.cpp\n            c.cpp\n            d.cpp", new.with_source(text, "c.cpp"))
        self.assertIn("d.cpp\n            e.cpp\n    LIBS", new.with_source(text, "e.cpp"))
        text = "quasimc_module(\n    SOURCES\n        b.cpp\n    PUBLIC base)\n"
        self.assertIn("SOURCES\n        a.cpp\n        b.cpp\n", new.with_source(text, "a.cpp"))
        self.assertIn("        b.cpp\n        c.cpp\n    PUBLIC", new.with_source(text, "c.cpp"))

    def test_a_list_without_sources_is_refused(self):
        with self.assertRaises(ValueError):
            new.with_source("quasimc_module(NAME a PUBLIC base)\n", "a.cpp")


class EveryFamily(unittest.TestCase):
    """Checks on the current tree, without writing to it."""

    def test_there_are_some(self):
        families = {"bsdf", "format", "sampler", "solver", "detector", "output"}
        self.assertLessEqual(families, set(new.available(ROOT)))

    def test_a_seam_that_is_not_there_yet_is_not_offered(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(new.available(Path(folder)), {})

    def test_a_member_costs_three_files_and_its_entries(self):
        for kind, family in new.available(ROOT).items():
            with self.subTest(kind):
                texts = new.planned(ROOT, kind, NAME)
                made = {path for path in texts if not (ROOT / path).exists()}
                self.assertEqual(len(made), 3)
                page = new.filled(family.page, family, NAME)
                self.assertEqual(
                    made,
                    {
                        f"{family.folder}/{family.prefix}{NAME}.cpp",
                        f"{family.tests}/{family.prefix}{NAME}_test.cpp",
                        f"{family.pages}/{page}",
                    },
                )
                lists = {new.list_of(ROOT, f"{folder}/x")[0] for folder in (family.folder, family.tests)}
                read = {path for path, _, _ in family.others}
                self.assertEqual(set(texts) - made, {family.catalogue} | lists | read)

    def test_only_lines_are_added_to_the_lists_of_the_build_and_the_catalogue(self):
        for kind, family in new.available(ROOT).items():
            texts = new.planned(ROOT, kind, NAME)
            for path in (family.catalogue, new.list_of(ROOT, f"{family.folder}/x")[0]):
                with self.subTest(path):
                    before = (ROOT / path).read_text(encoding="utf-8")
                    after = iter(texts[path].split())
                    self.assertTrue(all(word in after for word in before.split()))
                    self.assertIn(NAME, texts[path])

    def test_no_placeholder_is_left(self):
        for kind in new.available(ROOT):
            for path, text in new.planned(ROOT, kind, NAME).items():
                with self.subTest(path):
                    self.assertNotRegex(text, r"@(name|Name|words|Title|page|member|test)@")

    def test_the_name_of_a_member_that_is_there_is_refused(self):
        with self.assertRaisesRegex(ValueError, "exists already"):
            new.planned(ROOT, "bsdf", "phong")
        with self.assertRaisesRegex(ValueError, "exists already"):
            new.planned(ROOT, "format", "ply")

    def test_a_member_is_written_and_a_second_one_beside_it(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            kind, family = "bsdf", new.FAMILIES["bsdf"]
            for part in (family.folder, family.tests, family.pages, f"{new.TEMPLATES}/{kind}"):
                shutil.copytree(ROOT / part, root / part)
            made, changed = new.create(root, kind, NAME)
            self.assertEqual(len(made), 3)
            self.assertEqual(len(changed), 3)
            self.assertTrue(all((root / path).exists() for path in made))
            self.assertEqual(len(new.create(root, kind, NAME + "_two")[0]), 3)
            catalogue = (root / family.catalogue).read_text(encoding="utf-8")
            self.assertEqual(catalogue.count(f'"{NAME}"'), 1)


if __name__ == "__main__":
    unittest.main()
