"""check_docs.py: which blocks it takes for runnable, and that pages name what there is."""

import tempfile
import unittest
from pathlib import Path

import check_docs

PAGE = """# Title

```sh
not run
```

```sh run
first
second
```

1. In a list:

   ```toml run
   a = 1
   ```
"""

NAMES = """# A page

`src/run/run.cpp`, `src/run`, `src/run/gone.cpp`, not `src/gone and more`
`run.cpp`, `run/run.cpp`, `gone.cpp`
`src/run/NAME.cpp`, `src/gone/NAME.cpp`
[here](#a-page), [page](page.md#a-page), [gone](gone.md), [gone](#no-such-heading)

```sh
cat `src/gone.cpp`
```
"""


class CheckDocs(unittest.TestCase):
    def test_only_marked_blocks_are_run_and_indents_are_removed(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text(PAGE)
            self.assertEqual(
                list(check_docs.runnable_blocks(page)),
                [(7, "sh", "first\nsecond\n"), (14, "toml", "a = 1\n")],
            )

    def test_numbers_of_a_page_are_compared_with_those_of_a_table(self):
        head = "# head\nid,name,light,light_se,light_ci95_high\n"
        page_head = "```\nid, name, light, ..._se\n"
        with tempfile.TemporaryDirectory() as folder:
            page, table = Path(folder) / "page.md", Path(folder) / "table.csv"
            table.write_text(head + "1,a,0.26,0.004,0.3\n2,b,0,,0.0249\n")
            page.write_text(page_head + "1, a, 0.3, 0.004\n2, b, 0 (below 0.02)\n```\n")
            self.assertEqual(list(check_docs.wrong_numbers(page, table)), [])
            page.write_text(page_head + "1, a, 0.26, 0.005\n2, b, 0 (below 0.03)\n```\n")
            self.assertEqual(
                list(check_docs.wrong_numbers(page, table)), [("a", "light_se"), ("b", "light")]
            )

    def test_a_failing_command_is_reported_with_its_output(self):
        problem = check_docs.run(["sh", "-e", "-c", "echo why; false"], ".", None)
        self.assertEqual(problem, "exit status 1\nwhy\n")

    def test_pages_and_sources_name_files_and_headings_that_exist(self):
        self.assertEqual(list(check_docs.missing_names()), [])

    def test_names_of_nothing_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "src/run").mkdir(parents=True)
            (root / "docs").mkdir()
            (root / "src/run/run.cpp").write_text("// docs/page.md, docs/gone.md\n")
            (root / "docs/page.md").write_text(NAMES)
            self.assertEqual(
                list(check_docs.missing_names(root)),
                [
                    "docs/page.md:3: src/run/gone.cpp",
                    "docs/page.md:4: gone.cpp",
                    "docs/page.md:5: src/gone/NAME.cpp",
                    "docs/page.md:6: gone.md",
                    "docs/page.md:6: #no-such-heading",
                    "src/run/run.cpp:1: docs/gone.md",
                ],
            )


if __name__ == "__main__":
    unittest.main()
