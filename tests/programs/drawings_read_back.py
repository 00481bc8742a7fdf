#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Workshop drawings as other programs read them: the numbers of report.json stand in the PDF (poppler)
and in the DXF (ezdxf), and each PDF is one page of the size it says."""
import json
import os
import pathlib
import subprocess
import sys

import ezdxf

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
KEYS = ["tip_diameter_mm", "root_diameter_mm", "base_diameter_mm", "reference_diameter_mm", "root_form_diameter_mm"]


def shown(value):
    return f"{value:.4f}".rstrip("0").rstrip(".")


def words_of_dxf(path):
    document = ezdxf.readfile(path)
    errors = document.audit().errors
    if errors:
        sys.exit(f"{path}: {errors[0].message}")
    return {entity.dxf.text for entity in document.modelspace() if entity.dxftype() == "TEXT"}


def check(example):
    folder = OUTPUT / example
    subprocess.run([PROGRAM, "make", SOURCE / "examples" / example / "design.toml", "-o", folder, "--formats", "pdf",
                    "--allow-failing", "--quiet"], stdout=subprocess.DEVNULL, check=False)
    report = json.loads((folder / "report.json").read_text())
    parts = {file["part"] for file in report["files"] if file["format"] == "pdf"}
    missing = []
    pages = {}
    for part in sorted(parts):
        text = subprocess.run(["pdftotext", "-layout", folder / f"{part}.pdf", "-"], capture_output=True, text=True, check=True).stdout
        information = subprocess.run(["pdfinfo", folder / f"{part}.pdf"], capture_output=True, text=True, check=True).stdout
        if "Pages:           1" not in information or not ("841.89 x 595.276" in information or "1190.55 x 841.89" in information):
            missing.append(f"{part}: {information}")
        pages[part] = (set(text.split()), words_of_dxf(folder / f"{part}_drawing.dxf"))
    for gear, values in report["gears"].items():
        part = "planet" if gear.startswith("planet") else gear
        for key in KEYS:
            for kind, words in zip(("pdf", "dxf"), pages[part]):
                if shown(values[key]) not in words:
                    missing.append(f"{example} {part}.{kind}: {key} {shown(values[key])}")
    if missing:
        sys.exit("\n".join(missing))
    return len(parts)


total = sum(check(example) for example in ("bilateral_drive", "helical_planetary", "internal_pair"))
print(f"{total} sheets read back")
if total < 10:
    sys.exit("too few sheets: this looked at the wrong files")
