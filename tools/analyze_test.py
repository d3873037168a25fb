"""tools/analyze.py: the files that it examines, and its findings."""

import json
import shutil
import tempfile
import unittest
from pathlib import Path

import analyze
import tidy


class Joined(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()

    def test_the_joined_files_of_the_library_alone(self):
        names = ["src/a/Unity/unity_0_cxx.cxx", "src/a/alone.cpp", "tests/a/Unity/unity_0_cxx.cxx"]
        entries = [
            {"file": str(self.folder / name), "directory": "/", "command": "/usr/bin/ccache c++ x"}
            for name in names
        ]
        (self.folder / "compile_commands.json").write_text(json.dumps(entries))
        found = analyze.joined_files(self.folder)
        self.assertEqual([entry["file"] for entry in found], [str(self.folder / names[0])])
        self.assertEqual(found[0]["command"], "c++ x")

    def test_what_is_found_is_told_once_and_of_our_files(self):
        ours = f"{self.folder}/a.cpp:1:2: warning: here [x]"
        text = f"{ours}\n/usr/include/b.h:3:4: warning: there [x]\n{ours}\n"
        self.assertEqual(analyze.findings(text, self.folder), [ours])

    def test_functions_of_joined_sources_are_looked_through(self):
        if not (shutil.which("clang-tidy-14") or shutil.which("clang-tidy")):
            self.skipTest("clang-tidy is not installed")
        source = self.folder / "source.cpp"
        source.write_text("int f(bool b) {\n    int* p = nullptr;\n    if (b) {\n        return 1;\n    }\n    return *p;\n}\n")
        joined = self.folder / "unity_0_cxx.cxx"
        joined.write_text('#include "source.cpp"\n')
        entry = {"file": str(joined), "directory": str(self.folder), "command": f"c++ -c {joined}"}
        (self.folder / "compile_commands.json").write_text(json.dumps([entry]))
        found = analyze.analyze(joined, self.folder, self.folder, tidy.find_clang_tidy())
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f"{source}:6:"), found)


if __name__ == "__main__":
    unittest.main()
