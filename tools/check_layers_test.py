"""check_layers.py on small trees: what it must find, and what it must leave alone."""

import tempfile
import unittest
from pathlib import Path

import check_layers

TREE = {
    "src/layers.txt": "# the layers\n0 base\n1 geometry optics text\n3 series\n6 apps python\n",
    "src/geometry/CMakeLists.txt": "quasimc_module(NAME geometry SOURCES a.cpp PUBLIC base)\n",
    "src/base/vec3.h": "#pragma once\n",
    "src/geometry/a.cpp": '#include "base/vec3.h"\n#include <vector>\n',
    "src/text/read_toml.cpp": "#include <fstream>\n#include <toml++/toml.h>\n",
    "tests/support/agrees.h": "#pragma once\n",
    "tests/unit/base/vec3_test.cpp": '#include "base/vec3.h"\n#include "support/agrees.h"\n',
}


def faults_with(path, text):
    """The faults of the good tree with one file more, or other."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in {**TREE, path: text}.items():
            file = Path(folder) / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(content)
        return check_layers.Checker(Path(folder)).run()


class CheckLayers(unittest.TestCase):
    def test_a_good_tree_has_no_faults(self):
        self.assertEqual(faults_with("src/base/vec3.h", "#pragma once\n"), [])

    def assert_one_fault(self, path, text, words):
        faults = faults_with(path, text)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(words, faults[0])
        self.assertTrue(faults[0].startswith(f"{path}:"), faults[0])

    def test_a_higher_layer_is_refused(self):
        text = '#include "geometry/a.h"\n'
        self.assert_one_fault("src/base/b.cpp", text, "only lower layers")

    def test_a_neighbour_is_refused(self):
        text = '#include "optics/bsdf.h"\n'
        self.assert_one_fault("src/geometry/a.cpp", text, "only lower layers")

    def test_an_unlinked_module_is_refused(self):
        path = "src/geometry/CMakeLists.txt"
        faults = faults_with(path, "quasimc_module(NAME geometry SOURCES a.cpp)\n")
        self.assertEqual(len(faults), 1, faults)
        self.assertIn("does not link it", faults[0])

    def test_a_library_outside_its_fence_is_refused(self):
        text = "#include <nlohmann/json.hpp>\n"
        self.assert_one_fault("src/geometry/a.cpp", text, "only by src/text/")

    def test_a_slow_header_in_a_header_is_refused(self):
        text = "#pragma once\n#include <toml++/toml.h>\n"
        self.assert_one_fault("src/text/toml.h", text, "slow to compile")

    def test_a_knot_of_more_than_three_units_is_refused(self):
        names = ["a", "b", "c", "d"]
        self.assertEqual(check_layers.knots({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}),
                         [["a", "b", "c"], ["d"]])
        with tempfile.TemporaryDirectory() as folder:
            for name, content in TREE.items():
                file = Path(folder) / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(content)
            for name, other in zip(names, names[1:] + names[:1]):
                header = Path(folder) / f"src/base/{name}.h"
                header.write_text(f'#pragma once\n#include "base/{other}.h"\n')
            faults = check_layers.Checker(Path(folder)).run()
        self.assertEqual(len(faults), 1, faults)
        self.assertIn("4 units include each other", faults[0])

    def test_an_engine_that_prints_is_refused(self):
        text = 'void f() { std::printf("x"); }\n'
        self.assert_one_fault("src/geometry/a.cpp", text, "neither prints nor exits")

    def test_printing_in_a_comment_is_left_alone(self):
        self.assertEqual(faults_with("src/geometry/a.cpp", "// std::cout\n"), [])

    def test_public_headers_have_the_layer_of_their_module(self):
        self.assertEqual(faults_with("src/geometry/a.cpp", '#include "quasimc/mesh.h"\n'), [])
        text = '#include "quasimc/material.h"\n'
        self.assert_one_fault("src/base/b.h", "#pragma once\n" + text, "only lower layers")
        text = '#pragma once\n#include "quasimc/series.h"\n'
        self.assert_one_fault("include/quasimc/mesh.h", text, "only lower layers")

    def test_a_private_include_in_a_public_header_is_refused(self):
        text = '#pragma once\n#include "base/vec3.h"\n'
        self.assert_one_fault("include/quasimc/mesh.h", text, "is private")

    def test_a_public_header_that_is_not_in_the_table_is_refused(self):
        self.assert_one_fault("include/quasimc/more.h", "#pragma once\n", "not in PUBLIC_HEADERS")
        text = '#include "quasimc/more.h"\n'
        self.assert_one_fault("src/geometry/a.cpp", text, "no such header")

    def test_a_word_of_a_compiler_in_a_public_header_is_refused(self):
        for word in ("unsigned __int128 wide", "__builtin_add_overflow(a, b, &c)"):
            self.assert_one_fault("include/quasimc/mesh.h", f"#pragma once\n{word};\n", "standard C++")

    def test_the_header_of_all_is_for_users(self):
        text = '#include "quasimc/quasimc.h"\n'
        self.assert_one_fault("src/geometry/a.cpp", text, "is for users")

    def test_a_relative_include_is_refused(self):
        self.assert_one_fault("src/geometry/a.cpp", '#include "a.h"\n', "from src/")

    def test_a_source_that_is_not_built_is_refused(self):
        self.assert_one_fault("src/geometry/b.cpp", "\n", "not listed")

    def test_a_header_without_a_guard_is_refused(self):
        self.assert_one_fault("src/base/b.h", "int f();\n", "#pragma once")


if __name__ == "__main__":
    unittest.main()
