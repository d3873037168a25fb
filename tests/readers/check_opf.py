#!/usr/bin/env python3
"""Compares the OPF that quasimc writes with its JSON, by Python's XML: check_opf.py QUASIMC"""

import json
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

from program import run_in

OPF = """<?xml version="1.0" encoding="UTF-8"?>
<opf version="2.0"><!-- <branch id="3"> is no node here -->
<meshBDD><mesh Id="0"><points>0 0 0 1 0 0 0 1 0</points><faces><face Id="0">0 1 2</face></faces></mesh></meshBDD>
<materialBDD><material Id="0"><diffuse>0.1 0.2 0.3 1</diffuse></material></materialBDD>
<shapeBDD><shape Id="0"><meshIndex>0</meshIndex><materialIndex>0</materialIndex></shape></shapeBDD>
{table}
<topology class="Plant" scale="1" id="1">
  <decomp class="Leaf" scale="2" id="2">
    <Name>A &amp; B</Name>
    <geometry class="Mesh"><shapeIndex>0</shapeIndex><mat>1 0 0 0 0 1 0 0 0 0 1 2</mat></geometry>
    <branch class="Leaf" scale="2" id="3">
      <geometry class="Mesh"><shapeIndex>0</shapeIndex><mat>1 0 0 0 0 1 0 0 0 0 1 1</mat></geometry>
    </branch>
  </decomp>
  <branch class="Bud" scale="2" id="4"><length>3</length></branch>
</topology>
</opf>
"""
RUN = """
bands = ["PAR"]
[run]
paths = 64
[[source]]
type = "directional"
direction = [0.1, 0, -1]
irradiance_facing = 100
[[material]]
name = "leaf"
reflectance = 0.1
[[geometry]]
file = "plant.opf"
material = "leaf"
{more}
"""
TABLES = (
    "",
    "<attributeBDD/>",
    '<attributeBDD><attribute name="length" class="Double"/></attributeBDD>',
)


def nodes(root):
    return {e.get("id"): e for e in root.iter() if e.get("id") and e.get("class")}


def check(program, folder, table):
    def run(*command, status=0):
        return run_in(folder, program, *command, status=status)

    (folder / "plant.opf").write_text(OPF.format(table=table))
    (folder / "run.toml").write_text(RUN.format(more=""))
    run("run", "run.toml", "--quiet", "--json", "out.json")
    run("convert", "out.json", "light.opf")
    before = nodes(ET.parse(folder / "plant.opf").getroot())
    root = ET.parse(folder / "light.opf").getroot()
    after = nodes(root)
    assert list(after) == list(before)
    organs = {str(o["id"]): o for o in json.loads((folder / "out.json").read_text())["organs"]}
    for number, node in after.items():
        new = {e.tag: e.text for e in node if node.find(e.tag) is not before[number].find(e.tag)}
        if number not in organs:
            assert [e.tag for e in node] == [e.tag for e in before[number]], number
            continue
        density = organs[number]["absorbed_flux_density"]["PAR"]
        assert float(new["absorbed_flux_density_PAR"]) == density["mean"]
        if density["standard_error"] is not None:
            error = new["absorbed_flux_density_PAR_standard_error"]
            assert float(error) == density["standard_error"]
        kept = [e.tag for e in node if not e.tag.endswith("_PAR") and "_standard_error" not in e.tag]
        assert [t for t in kept if t != "sunlit_fraction"] == [e.tag for e in before[number]]
    declared = [e.get("name") for e in root.iter("attribute")]
    assert declared.count("absorbed_flux_density_PAR") == 1, declared
    assert ("length" in declared) == ("length" in table)

    # Writing light to a file that has it already replaces it: nothing is repeated.
    (folder / "plant.opf").write_bytes((folder / "light.opf").read_bytes())
    run("run", "run.toml", "--quiet", "--json", "out.json")
    run("convert", "out.json", "again.opf")
    assert (folder / "again.opf").read_bytes() == (folder / "light.opf").read_bytes()

    # Organs with new numbers do not match those of the file.
    (folder / "run.toml").write_text(RUN.format(more="first_id = 100"))
    run("run", "run.toml", "--quiet", "--json", "out.json")
    assert "no organ of the result is a node of the file" in run(
        "convert", "out.json", "none.opf", status=1
    )
    assert not (folder / "none.opf").exists()


def main():
    for table in TABLES:
        with tempfile.TemporaryDirectory() as name:
            check(sys.argv[1], Path(name), table)


main()
