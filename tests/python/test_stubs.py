"""The stubs say what the package has, and the examples pass mypy --strict."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

import quasimc

SOURCE = Path(os.environ["QUASIMC_SOURCE_DIR"])
PACKAGE = SOURCE / "python" / "quasimc"
PRIVATE_PARTS = [
    f"quasimc.{name}"
    for name in (
        "_assigned", "_contents", "_result_tables", "_result_views", "_runs", "_scene_meshes",
        "_selection", "_sums", "_views",
    )
]  # fmt: skip
STUB = ast.parse((PACKAGE / "__init__.pyi").read_text())


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("mypy")


def mypy(arguments, cache):
    pytest.importorskip("mypy")
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(cache), *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "MYPYPATH": str(SOURCE / "python")},
    )


def definitions(body):
    return {node.name: node for node in body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def test_mypy_finds_nothing_in_stubs_and_examples(cache):
    files = [*PACKAGE.rglob("*.pyi"), *(SOURCE / "examples" / "05-python").glob("*.py")]
    assert len(files) >= 9
    said = mypy(files, cache)
    assert said.returncode == 0, said.stdout + said.stderr


def test_mypy_finds_what_is_wrong(tmp_path, cache):
    wrong = tmp_path / "wrong.py"
    wrong.write_text('import quasimc\nquasimc.Scene("PAR").run(pathes=3)\n')
    said = mypy([wrong], cache)
    assert said.returncode == 1 and "run" in said.stdout


def test_everything_public_is_in_the_stub():
    names = set(definitions(STUB.body)) | {"__version__"}
    assert set(quasimc.__all__) <= names


def test_methods_of_the_stub_are_those_of_the_package():
    for name, node in definitions(STUB.body).items():
        if not isinstance(node, ast.ClassDef) or name.startswith("_"):
            continue
        kind = getattr(quasimc, name)
        parts = [kind, *(k for k in kind.__bases__ if k.__module__ in PRIVATE_PARTS)]
        public = {n for part in parts for n in vars(part) if not n.startswith("_")}
        methods = {n for n in public if callable(getattr(getattr(quasimc, name), n))}
        stated = {n for n in definitions(node.body) if not n.startswith("_")}
        assert methods <= stated, name
        assert all(hasattr(getattr(quasimc, name), n) for n in stated), name


def test_run_takes_every_option():
    runs = [n for n in definitions(STUB.body)["Scene"].body if getattr(n, "name", "") == "run"]
    options = [option["key"] for option in quasimc.options()]
    assert runs
    for run in runs:
        assert [a.arg for a in run.args.kwonlyargs][-len(options) :] == options
