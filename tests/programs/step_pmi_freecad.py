#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD opens AP242 files with product information: the same valid solids as the AP214 files hold. The gear data
in them are the numbers of report.json."""
import json
import os
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
for folder in ("/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"):
    sys.path.append(folder)
import FreeCAD  # noqa: E402,F401  (must come before Part)
import Part  # noqa: E402

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])


def make(example, schema):
    folder = OUTPUT / f"{example}_{schema}"
    subprocess.run([PROGRAM, "make", SOURCE / "examples" / example / "design.toml", "-o", folder, "--formats", "step",
                    "--step-schema", schema, "--quiet", "--allow-failing"], check=False)
    return sorted(folder.glob("*.step"))


def read(path):
    shape = Part.Shape()
    shape.read(str(path))
    return shape


def complaints(plain_path, rich_path):
    text = rich_path.read_text()
    found = []
    if "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF" not in text or "=DIMENSIONAL_SIZE(" not in text:
        found.append("no product information")
    plain, rich = read(plain_path), read(rich_path)
    if not rich.isValid():
        found.append("not valid")
    if len(rich.Solids) != len(plain.Solids) or not rich.Solids:
        found.append(f"{len(rich.Solids)} solids, not {len(plain.Solids)}")
    if rich.Volume != plain.Volume:
        found.append(f"volume {rich.Volume}, not {plain.Volume}")
    print(f"{rich_path.parent.name}/{rich_path.name}: {len(rich.Solids)} solids, {len(rich.Faces)} faces")
    return [f"{rich_path}: {what}" for what in found]


PROPERTY = re.compile(r"_REPRESENTATION_ITEM\('(\w+)\.(\w+)',\w+_MEASURE\(([^)]*)\)")


def wrong_numbers(folder, texts):
    """Gear data that are not those of report.json, and how many are."""
    gears = json.loads((folder / "report.json").read_text())["gears"]
    wrong, right = [], set()
    for gear, key, number in (m for text in texts for m in PROPERTY.findall(text)):
        if float(number) == gears[gear][key]:
            right.add((gear, key))
        else:
            wrong.append(f"{folder.name}: {gear}.{key} is {number}, not {gears[gear][key]}")
    if len(right) != 10 * len(gears):
        wrong.append(f"{folder.name}: {len(right)} numbers of {len(gears)} gears")
    return wrong


def main():
    found, pairs = [], 0
    examples, least = (("external_pair", "internal_pair"), 6) if "TRUEFLANK_CAMPAIGN" not in os.environ else \
                      (("external_pair", "internal_pair", "simple_planetary"), 9)
    for example in examples:
        for plain, rich in zip(make(example, "ap214"), make(example, "ap242"), strict=True):
            found += complaints(plain, rich)
            pairs += 1
        folder = OUTPUT / f"{example}_ap242"
        found += wrong_numbers(folder, [path.read_text() for path in folder.glob("*.step")])
    if pairs < least:
        found.append(f"only {pairs} files")
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
