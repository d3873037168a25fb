"""Every block of Python in the guide and every example is run."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import quasimc

SOURCE = Path(os.environ["QUASIMC_SOURCE_DIR"])
EXAMPLES = sorted((SOURCE / "examples" / "05-python").glob("*.py"))
# Pages and how many blocks each has.
PAGES = {"python.md": 16, "growing-plants.md": 3, "coming-from-other-programs.md": 1,
         "sun-and-shade.md": 3, "lamps.md": 1}


def blocks_of(page):
    return re.findall(r"^```python\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


@pytest.mark.filterwarnings("ignore::quasimc.QuasimcWarning")
@pytest.mark.parametrize("page", PAGES)
def test_the_blocks_of_a_page_run_one_after_the_other(page, tmp_path, monkeypatch, capsys):
    pytest.importorskip("xarray")
    monkeypatch.chdir(tmp_path)
    blocks = blocks_of(SOURCE / "docs" / "guide" / page)
    assert len(blocks) == PAGES[page]
    known = {}
    for number, block in enumerate(blocks):
        exec(compile(block, f"{page}, block {number + 1}", "exec"), known)
    printed = capsys.readouterr().out
    assert printed
    if page == "python.md":
        assert "paths" in printed.splitlines()[-1] and "SunPosition" in printed


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(path):
    said = subprocess.run([sys.executable, str(path)], capture_output=True, text=True, timeout=300)
    assert said.returncode == 0, said.stderr
    assert len(said.stdout.splitlines()) >= 6


def test_all_examples_are_told_of():
    told = (SOURCE / "examples" / "05-python" / "README.md").read_text()
    assert len(EXAMPLES) == 5 and all(path.name in told for path in EXAMPLES)


def test_the_example_of_the_package_gives_what_it_says():
    import doctest

    assert doctest.testmod(quasimc).failed == 0


def test_the_block_of_the_reference_runs(capsys):
    (block,) = blocks_of(SOURCE / "docs" / "reference" / "python-api.md")
    exec(compile(block, "python-api.md", "exec"), {})
    assert round(float(capsys.readouterr().out), 1) == 43.0


def test_everything_public_is_documented():
    for name in quasimc.__all__:
        thing = getattr(quasimc, name)
        if name.startswith("__"):
            continue
        assert thing.__doc__, name
        for method, value in vars(thing).items() if isinstance(thing, type) else ():
            if not method.startswith("_") and callable(value):
                assert value.__doc__, f"{name}.{method}"
