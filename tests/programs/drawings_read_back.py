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

from inch_pair import INCHES

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
# key and places; what a gear has not is null
KEYS = {"tip_diameter_mm": 4, "root_diameter_mm": 4, "base_diameter_mm": 4, "reference_diameter_mm": 4, "root_form_diameter_mm": 4,
        "start_active_profile_diameter_mm": 4, "reference_thickness_mm": 4, "face_width_mm": 3, "pin_diameter_mm": 3, "lead_mm": 4}
EXAMPLES = ["bilateral_drive", "helical_planetary", "internal_pair", "printed_actuator", "boxed_pair", "carried_drive"]


def shown(value, places):
    return f"{value:.{places}f}".rstrip("0").rstrip(".")


def looked_for(report, gear):
    """Texts of a gear's column, and of that in inches."""
    values = report["gears"][gear]
    for key, places in KEYS.items():
        if values[key] is None:
            continue
        yield key, shown(values[key], places)
        if "inches" in report:
            yield key + " in inches", shown(values[key] / 25.4, places + 1)
    allowance = values["thickness_allowance"] or next(part["flanks"][gear] for part in report["parts"].values() if gear in part["flanks"])
    for key, least, most in (("span_mm", "span_min_mm", "span_max_mm"), ("over_pins_mm", "over_pins_min_mm", "over_pins_max_mm")):
        limits = [allowance[least], allowance[most]] if allowance and allowance[least] is not None else [values[key]]
        for value in limits:
            if value is not None:
                yield key, shown(value, 3)
                if "inches" in report:
                    yield key + " in inches", shown(value / 25.4, 4)


def limits_of(size):
    """What stands behind a size with limits of its own."""
    if size["fit"]:
        return f"{size['fit']} ({'+' if size['upper_mm'] > 0 else ''}{shown(size['upper_mm'], 3)}"
    return ""


def part_numbers(sizes):
    """Texts of a part's sheet by its entry in report.json: sizes with fits, holes, tolerances, surfaces."""
    for d in sizes["diameters"]:
        yield ("AF " if d["shape"] == "hexagon" else "Ø") + " ".join(filter(None, [shown(d["diameter_mm"], 3), limits_of(d)]))
    for length in sizes["widths"] + sizes["depths"]:
        yield shown(length["length_mm"], 3)
    for holes in sizes["holes"]:
        yield str(holes["count"])
        yield from holes["words"]
        if holes["for"]:
            yield "for " + holes["for"]
        if holes["count"] == 1:
            x, y = (shown(v, 3) if abs(v) > 5e-4 else "0" for v in holes["at_mm"][0])
            yield f"x {x}, y {y}"
        else:
            yield "on Ø" + shown(holes["circle_diameter_mm"], 3)
        for step in holes["steps"]:
            if not any(f"Ø{shown(step['diameter_mm'], 3)}" in words for words in holes["words"]):
                sys.exit(f"{holes['words']} without Ø{step['diameter_mm']}")
    for tolerance in sizes["tolerances"]:
        yield ("Ø" if tolerance["kind"] == "position" else "") + shown(tolerance["value_mm"], 4)
    yield sizes["general_tolerances"]
    if sizes["surfaces"]:
        yield sizes["surfaces"]


def missing_numbers(example, part, sizes, path):
    """What of it neither PDF nor DXF has. Blanks are left out: upright texts come in pieces."""
    def squeezed(text):
        return "".join(text.split())
    pdf = squeezed(subprocess.run(["pdftotext", "-raw", path / f"{part}.pdf", "-"], capture_output=True, text=True, check=True).stdout)
    dxf = "\n".join(squeezed(line) for line in words_of_dxf(path / f"{part}_drawing.dxf"))
    for number in part_numbers(sizes):
        for kind, text in (("pdf", pdf), ("dxf", dxf)):
            if squeezed(number) not in text:
                yield f"{example} {part}.{kind}: {number}"


def words_of_dxf(path):
    document = ezdxf.readfile(path)
    errors = document.audit().errors
    if errors:
        sys.exit(f"{path}: {errors[0].message}")
    texts = (entity.dxf.text for entity in document.modelspace() if entity.dxftype() == "TEXT")
    return {text.replace("%%c", "Ø").replace("%%p", "±") for text in texts}


def rows_of(text):
    """Lines of a page by their words, single blanks between."""
    return [" ".join(line.split()) for line in text.splitlines()]


def missing_items(example, report, text, words):
    """The parts list against the bill of materials: every count, designation, material and mass."""
    lines = rows_of(text)
    for line in report.get("bill_of_materials") or []:
        if line["designation"]:
            wanted = f"{line['count']} {line['designation']} to buy"
        else:
            # the drawing has proper names and, of gears, their teeth
            wanted = f"{line['material']} {shown(line['mass_g'], 2)} g"
        if not any(wanted in row for row in lines):
            yield f"{example} assembly.pdf: {wanted}"
        if (line["designation"] or f"{shown(line['mass_g'], 2)} g") not in words:
            yield f"{example} assembly.dxf: {line}"


def check(example):
    folder = OUTPUT / example
    design = SOURCE / "examples" / example / "design.toml"
    if example == "inches":
        design = OUTPUT / "inches.toml"
        OUTPUT.mkdir(parents=True, exist_ok=True)
        design.write_text(INCHES)
    subprocess.run([PROGRAM, "make", design, "-o", folder, "--formats", "pdf",
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
        words = words_of_dxf(folder / f"{part}_drawing.dxf")
        if part == "assembly":
            missing += missing_items(example, report, text, words)
        # limits are one text, "8.028 .. 8.057"
        pages[part] = (set(text.split()), {word for line in words for word in line.split()})
    if sorted(report["parts"]) != sorted(parts - {"assembly"}):
        missing.append(f"{example}: parts {sorted(report['parts'])}, sheets {sorted(parts)}")
    for part, sizes in report["parts"].items():
        missing += missing_numbers(example, part, sizes, folder)
    for gear in report["gears"]:
        part = "planet" if gear.startswith("planet") else gear
        for key, value in looked_for(report, gear):
            for kind, words in zip(("pdf", "dxf"), pages[part]):
                if value not in words:
                    missing.append(f"{example} {part}.{kind}: {key} {value}")
    if missing:
        sys.exit("\n".join(missing))
    if example == "printed_actuator" and not report.get("bill_of_materials"):
        sys.exit("a machine without a bill of materials")
    return len(parts)


# the gate: every other example, among them a pair in a ring and one with a housing
WHOLE = "TRUEFLANK_CAMPAIGN" in os.environ
total = sum(check(example) for example in EXAMPLES[::1 if WHOLE else 2] + ["inches"])
print(f"{total} sheets read back")
if total < (30 if WHOLE else 15):
    sys.exit("too few sheets: this looked at the wrong files")
