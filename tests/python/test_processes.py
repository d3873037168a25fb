"""Results of other processes, by the page of the guide and by dask."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import quasimc
from canopies import FEW, canopy

SOURCE = Path(os.environ["QUASIMC_SOURCE_DIR"])


def test_the_page_runs_as_a_file(tmp_path):
    page = (SOURCE / "docs" / "guide" / "python-processes.md").read_text()
    block = re.findall(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)[0]
    (tmp_path / "pool.py").write_text(block)
    for name in ("maize.toml", "maize.obj"):
        shutil.copy(SOURCE / "examples" / "04-first-canopy" / name, tmp_path)
    said = subprocess.run(
        [sys.executable, "pool.py"], cwd=tmp_path, capture_output=True, text=True, timeout=300
    )
    assert said.returncode == 0, said.stderr
    change, _, error = said.stdout.split()[:3]
    assert -1 < float(change) < 0 and float(error) < 0.1


def hour(first):
    scene = canopy()
    scene.site = quasimc.Site(52, 5.7)
    time = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[first, first + 1])
    return scene.series(time, sources=[], **FEW, threads=1)


def part(index):
    return canopy().part(index, 2, **FEW, threads=1)


def test_dask_sends_series_and_parts():
    distributed = pytest.importorskip("distributed")
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        hours = client.gather(client.map(hour, [9, 12]))
        merged = quasimc.merge(client.gather(client.map(part, range(2))))
    assert merged == canopy().run(**FEW)
    for first, series in zip((9, 12), hours):
        assert series[0] == hour(first)[0] and series.times == hour(first).times
