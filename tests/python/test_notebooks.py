"""The notebooks of the guide run, and are kept without what they print."""

import json
import os
from pathlib import Path

import pytest

import quasimc  # noqa: F401  (its warnings are errors here)

FOLDER = Path(os.environ["QUASIMC_SOURCE_DIR"]) / "docs" / "guide" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def cells_of(path):
    return json.loads(path.read_text(encoding="utf-8"))["cells"]


def has_matplotlib():
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return False
    return True


def imported(path, package):
    """Whether a notebook needs a package in a cell that is not skipped."""
    cells = [c for c in cells_of(path) if "plot" not in c["metadata"].get("tags", [])]
    return any(f"from {package}" in line or f"import {package}" in line for c in cells for line in c["source"])


def test_the_page_shows_each_with_its_picture():
    page = (FOLDER / "README.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) == 11
    for path in NOTEBOOKS:
        assert path.name in page and f"pictures/{path.stem}.png" in page
        assert (FOLDER / "pictures" / f"{path.stem}.png").is_file()


@pytest.mark.filterwarnings("error::quasimc.QuasimcWarning")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run(path, tmp_path, monkeypatch):
    """Cells one after the other, as plain Python; those that draw, where matplotlib is."""
    if imported(path, "scipy"):
        pytest.importorskip("scipy")
    monkeypatch.chdir(tmp_path)
    known = {"__name__": "__main__"}
    for number, cell in enumerate(cells_of(path), 1):
        if cell["cell_type"] != "code":
            continue
        if "plot" in cell["metadata"].get("tags", []) and not has_matplotlib():
            continue
        exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), known)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_end_with_a_picture_and_assert_nothing(path):
    code = ["".join(cell["source"]) for cell in cells_of(path) if cell["cell_type"] == "code"]
    assert "plt." in code[-1] or ".plot." in code[-1] or ".picture(" in code[-1]
    assert not any(line.strip().startswith("assert ") for text in code for line in text.splitlines())


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_are_kept_without_outputs(path):
    for cell in cells_of(path):
        assert not cell.get("outputs") and not cell.get("execution_count")
        assert len("".join(cell["source"]).strip()) > 0
