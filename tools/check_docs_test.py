"""check_docs.py: which blocks it takes for runnable."""

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


class CheckDocs(unittest.TestCase):
    def test_only_marked_blocks_are_run_and_indents_are_removed(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text(PAGE)
            self.assertEqual(
                list(check_docs.runnable_blocks(page)),
                [(7, "sh", "first\nsecond\n"), (14, "toml", "a = 1\n")],
            )

    def test_a_failing_command_is_reported_with_its_output(self):
        problem = check_docs.run(["sh", "-e", "-c", "echo why; false"], ".", None)
        self.assertEqual(problem, "exit status 1\nwhy\n")


if __name__ == "__main__":
    unittest.main()
