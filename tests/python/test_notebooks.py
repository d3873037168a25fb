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


def test_there_are_six_and_the_page_tells_of_each():
    page = (FOLDER / "README.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) == 6
    assert all(path.name in page for path in NOTEBOOKS)


@pytest.mark.filterwarnings("error::quasimc.QuasimcWarning")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run(path, tmp_path, monkeypatch):
    """Cells one after the other, as plain Python; those that draw, where matplotlib is."""
    monkeypatch.chdir(tmp_path)
    known = {"__name__": "__main__"}
    for number, cell in enumerate(cells_of(path), 1):
        if cell["cell_type"] != "code":
            continue
        if "plot" in cell["metadata"].get("tags", []) and not has_matplotlib():
            continue
        exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), known)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_are_kept_without_outputs(path):
    for cell in cells_of(path):
        assert not cell.get("outputs") and not cell.get("execution_count")
        assert len("".join(cell["source"]).strip()) > 0
