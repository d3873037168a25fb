"""The part of the wheel that CMake makes: quasimc._core. All else is in pyproject.toml."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        folder = Path(self.build_temp).resolve() / "cmake"
        definitions = {
            "CMAKE_BUILD_TYPE": "Release",
            "QUASIMC_PYTHON": sys.executable,
            "QUASIMC_BUILD_APPS": "OFF",
            "QUASIMC_BUILD_TESTS": "OFF",
            "QUASIMC_UNITY": "all",
        }
        configure = ["cmake", "-G", "Ninja", "-S", str(ROOT), "-B", str(folder)]
        try:
            import pybind11

            definitions["pybind11_DIR"] = pybind11.get_cmake_dir()
        except ImportError:
            pass  # that of the system
        configure += [f"-D{key}={value}" for key, value in definitions.items()]
        subprocess.run(configure, check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "quasimc_python"], check=True)
        target = Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        made = next((folder / "python" / "quasimc").glob("_core*"))
        shutil.copy2(made, target)


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^    VERSION ([0-9.]+)$", text, re.MULTILINE).group(1)


setup(
    version=version(),
    ext_modules=[Extension("quasimc._core", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
