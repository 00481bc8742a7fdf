#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD opens the assembly of a gearbox: every body of the bill of materials by its name, in its colour, bearings and
screws among them; no two bodies have volume in common."""
import csv
import os
import pathlib
import re
import subprocess
import sys
from collections import Counter

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])

# Links keep FreeCAD 0.20 without a window from a crash on files of several bodies. Of equal bodies against a gear, which
# takes a second, one is compared.
IN_FREECAD = """
import FreeCAD, Import, Part
doc = FreeCAD.newDocument("a")
Import.insert({path!r}, "a", merge=False, useLinkGroup=True)
for o in doc.Objects:
    print("\\nBODY", o.TypeId, o.Label)
shape = Part.Shape()
shape.read({path!r})
solids = shape.Solids
seen = set()
print("\\nVALID", all(s.isValid() and s.isClosed() for s in solids))
for i, one in enumerate(solids):
    for other in solids[:i]:
        if not one.BoundBox.intersect(other.BoundBox):
            continue
        toothed = max(len(one.Faces), len(other.Faces)) > 100
        kin = (round(one.Volume, 3), round(other.Volume, 3))
        if toothed and kin in seen:
            continue
        seen.add(kin)
        common = one.common(other).Volume
        print("\\nPAIR", kin[0], kin[1], common)
"""


def main():
    example = "boxed_pair"
    folder = OUTPUT / example
    subprocess.run([PROGRAM, "make", SOURCE / "examples" / example / "design.toml", "-o", folder, "--formats", "step",
                    "--quiet"], check=True)
    path = folder / "assembly.step"
    script = OUTPUT / "open_assembly.py"
    script.write_text(IN_FREECAD.format(path=str(path)), encoding="utf-8")
    told = subprocess.run(["freecadcmd", str(script)], capture_output=True, text=True, check=False, timeout=500,
                          env=dict(os.environ, HOME=str(OUTPUT))).stdout
    found = Counter()
    for kind, label in re.findall(r"(?m)^BODY (\S+) (.+)$", told):
        if kind != "App::LinkGroup":
            found[re.sub(r"\d{3}$", "", label) if kind == "App::Link" else label] += 1
    with open(folder / "bom.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    missing = [row["part"] for row in rows if row["part"] and row["part"] not in found]
    assert not missing, f"not in FreeCAD's tree: {missing}"
    assert {"bearing_6806", "bearing_608", "motor_nema17"} <= set(found), found
    assert sum(name.startswith("screw_") for name in found) >= 4, found
    assert len(set(re.findall(r"COLOUR_RGB\('',([^)]*)\)", path.read_text()))) >= 4
    assert "VALID True" in told, told[-500:]
    pairs = re.findall(r"(?m)^PAIR (\S+) (\S+) (\S+)$", told)
    print(f"{len(pairs)} pairs of bodies compared")
    assert len(pairs) > 60, told[-500:]
    common = [pair for pair in pairs if float(pair[2]) > 1e-6]
    assert not common, f"volumes [mm3] of two bodies and what they have in common: {common}"


if __name__ == "__main__":
    sys.exit(main())
