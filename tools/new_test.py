"""new.py: a new member starts as a renamed copy that the build knows."""

import tempfile
import unittest
from pathlib import Path

import new


class New(unittest.TestCase):
    def test_a_name_is_changed_in_all_its_spellings(self):
        text = 'class MonteCarlo {}; // monte_carlo, "monte carlo", make_monte_carlo\n'
        expected = 'class Halton {}; // halton, "halton", make_halton\n'
        self.assertEqual(new.renamed(text, "monte_carlo", "halton"), expected)

    def test_longer_names_are_left_alone(self):
        self.assertEqual(new.renamed("Monte Carlos MonteCarlos", "monte_carlo", "x"), "Monte Carlos MonteCarlos")

    def test_a_member_gets_its_files_and_its_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            module = root / "src/quasimc/optics"
            module.mkdir(parents=True)
            (module / "phong.cpp").write_text("class Phong;\n")
            (module / "CMakeLists.txt").write_text("SOURCES lambertian.cpp phong.cpp\n")
            written = new.create(root, "bsdf", "oren_nayar")
            self.assertEqual(written, [module / "oren_nayar.cpp"])
            self.assertEqual(written[0].read_text(), "class OrenNayar;\n")
            self.assertEqual(
                (module / "CMakeLists.txt").read_text(),
                "SOURCES lambertian.cpp phong.cpp oren_nayar.cpp\n",
            )


if __name__ == "__main__":
    unittest.main()
