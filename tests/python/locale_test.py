# SPDX-License-Identifier: GPL-3.0-or-later
"""A program that sets the locale of another country gets from the package what any other gets, to the byte.

The locale is set by Python for C, and by a small library, loaded before Python, for C++ too.
"""
import json
import locale
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import foreign_locale
from small_search import NEEDS

PAIR = """format = 1
name = "p"
[gearbox]
kind = "pair"
module_mm = 1.25
backlash_mm = 0.05
[pinion]
teeth = 17
face_width_mm = 8.0
[wheel]
teeth = 40
face_width_mm = 8.0
"""
INDEX = "# ZERO = Common\nRecord,Tooth,Flank,Diameter_MM,Z_mm,DEVIATION_um\n" + "".join(
    f"INDEX,{tooth},{flank},21.25,4,{1.5 * ((5 * tooth) % 7):.2f}\n" for tooth in range(1, 18) for flank in ("LEFT", "RIGHT"))


def job(folder):
    """All that the package writes or says, into the folder."""
    name = os.environ.get("FOREIGN_LOCALE")
    if name:
        locale.setlocale(locale.LC_ALL, name)
        assert locale.str(0.5) == "0,5"
    import trueflank
    pair = trueflank.read_text(PAIR)
    pair.export(folder / "parts", formats=["stl", "3mf", "obj", "ply", "glb", "step", "dxf", "svg", "scad"], tolerance_um=5)
    (folder / "index.csv").write_text(INDEX)
    loop = pair.close_loop("pinion", folder / "index.csv")
    gear = trueflank.Gear(17, module_mm=1.25, shift=0.2)
    meshes = [pair.mesh("pinion", tolerance_um=t) for t in (2.5, 12.5)]
    found = trueflank.search_text(NEEDS, threads=1)
    texts = {"report": json.dumps(pair.report()), "page": pair.report_html(), "design": pair.design_text(),
             "efficiency": json.dumps(pair.efficiency(friction=0.085)), "step": pair.step_text("wheel"),
             "loop.json": loop.json_text(), "loop.html": loop.html(), "loop.text": loop.text(),
             "gear": repr((gear, gear.tip_diameter_mm, gear.span_mm())), "found": found.csv_text(),
             "compared": json.dumps(trueflank.compare(*meshes, tolerance_um=2.5))}
    for what, wrong in {"tolerance": lambda: trueflank.compare(*meshes, tolerance_um=-1234.5),
                        "friction": lambda: pair.efficiency(friction=1.25),
                        "shift": lambda: trueflank.read_text(PAIR.replace("teeth = 17", "teeth = 17\nshift = -3.25"))}.items():
        try:
            wrong()
        except trueflank.TrueflankError as error:
            texts["wrong_" + what] = str(error)
        assert "wrong_" + what in texts, what
    for what, text in texts.items():
        (folder / f"{what}.txt").write_text(text, encoding="utf-8")


def main():
    output = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "locale"
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    foreign_locale.make(output)
    files = []
    for name, settings in (("plain", {}),
                           ("foreign", {"LOCPATH": str(output), "FOREIGN_LOCALE": foreign_locale.NAME, "LD_PRELOAD": sys.argv[1]})):
        folder = output / name
        folder.mkdir()
        environment = {key: value for key, value in os.environ.items() if not key.startswith("LC_")} | settings
        subprocess.run([sys.executable, __file__, "job", str(folder)], check=True, env=environment)
        files.append({str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()})
    assert len(files[0]) > 40 and files[0].keys() == files[1].keys(), files[0].keys() ^ files[1].keys()
    differ = [name for name, content in files[0].items() if files[1][name] != content]
    assert not differ, f"the locale changes {differ}"


if __name__ == "__main__":
    if sys.argv[1] == "job":
        job(pathlib.Path(sys.argv[2]))
    else:
        main()
