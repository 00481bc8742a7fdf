# SPDX-License-Identifier: GPL-3.0-or-later
"""Under a locale of another country, set by a host program, everything is read and written as without.

The locale is made here, and a small library sets it in the program before main().
"""
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import foreign_locale
from small_search import NEEDS

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "locale"
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
SETTER = sys.argv[1]
PAIR = """format = 1
name = "pair"
[gearbox]
kind = "pair"
module_mm = 1.5
[pinion]
teeth = 17
face_width_mm = 8
[wheel]
teeth = 23
face_width_mm = 8
"""
TRACES = "Record,Tooth,Flank,Diameter_MM,Z_mm,DEVIATION_um\n" + "".join(
    f"{record},{tooth},{flank},{diameter},{z},{0.3 * ((7 * tooth + 3 * k) % 5) + 0.25 * k:.2f}\n"
    for tooth in (1, 5, 9, 13) for flank in ("LEFT", "RIGHT")
    for k in range(10)
    for record, diameter, z in (("PROFILE", f"{25 + 0.2 * k:.1f}", "4"), ("HELIX", "25.5", f"{0.5 + 0.7 * k:.1f}")))
TRACES += "".join(f"INDEX,{tooth},{flank},25.5,4,{(5 * tooth) % 7}\n"
                  for tooth in range(1, 18) for flank in ("LEFT", "RIGHT"))
TRACES += "HELIX,3,LEFT,25.5,1234.5,1\n"

CORNERS, FACES = ((0, 0, 0), (10, 0, 0), (0, 12.25, 0), (0, 0, 15.5)), ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
AMF = ('<?xml version="1.0"?>\n<amf version="1.1"><object id="1"><mesh><vertices>\n' + "".join(
    f"<vertex><coordinates><x>{x}</x><y>{y}</y><z>{z}</z></coordinates></vertex>\n" for x, y, z in CORNERS) +
       "</vertices><volume>\n" + "".join(f"<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>\n" for a, b, c in FACES) +
       "</volume></mesh></object></amf>\n")
X3D = ("<?xml version='1.0'?><X3D profile='Interchange' version='3.3'><Scene><Group><Shape><IndexedFaceSet coordIndex='" +
       " ".join(f"{a} {b} {c} -1" for a, b, c in FACES) + "'><Coordinate point='" +
       " ".join(f"{x / 1000} {y / 1000} {z / 1000}" for x, y, z in CORNERS) +
       "'/></IndexedFaceSet></Shape></Group></Scene></X3D>")


def environment(foreign):
    plain = {key: value for key, value in os.environ.items() if not key.startswith("LC_")}
    if foreign:
        plain |= {"LOCPATH": str(OUTPUT), "FOREIGN_LOCALE": foreign_locale.NAME, "LD_PRELOAD": SETTER,
                  "ASAN_OPTIONS": "verify_asan_link_order=0:detect_leaks=0"}
    return plain


def run(folder, foreign, *arguments, codes=(0,)):
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          env=environment(foreign))
    assert done.returncode in codes, (arguments, foreign, done.returncode, done.stderr)
    return done.stdout + done.stderr


def all_commands(folder, foreign):
    """What each command says; its files lie in the folder."""
    folder.mkdir()
    shutil.copytree(EXAMPLES / "bilateral_drive", folder / "drive")
    (folder / "needs.toml").write_text(NEEDS)
    (folder / "pair.toml").write_text(PAIR)
    (folder / "traces.csv").write_text(TRACES)
    (folder / "other.toml").write_text(PAIR.replace("[pinion]", "[pinion]\nshift = 0.02"))
    said = run(folder, foreign, "check", "drive/design.toml", "--json", "report.json", "--tolerance", "7")
    said += run(folder, foreign, "make", "drive/design.toml", "-o", "parts", "--formats",
                "stl,3mf,obj,ply,glb,step,dxf,svg,scad", "--tolerance-um", "5")
    said += run(folder, foreign, "loop", "drive/design.toml", "drive/measured.csv", "-o", "loop", codes=(0, 1))
    for name in ("pair", "other"):
        said += run(folder, foreign, "make", f"{name}.toml", "-o", name, "--formats", "obj,3mf", "--tolerance-um", "5",
                    "--allow-failing")
    said += run(folder, foreign, "compare", "pair/pinion.obj", "other/pinion.3mf", "--picture", "difference.svg",
                codes=(0, 1))
    for name, text in (("body.amf", AMF), ("body.x3d", X3D)):  # assimp reads them, in a process of its own
        (folder / name).write_text(text)
        said += run(folder, foreign, "compare", name, name, codes=(0, 2))
    # what cannot be, with the number that cannot
    (folder / "wide.toml").write_text(PAIR.replace("teeth = 17", "teeth = 17\nshift = -1.25"))
    (folder / "odd.toml").write_text(NEEDS.replace("max = 96.3", "max = 1090.5").replace("min = 96.2", "min = 1096.25"))
    said += run(folder, foreign, "check", "wide.toml", codes=(1, 2))
    said += run(folder, foreign, "search", "odd.toml", "-o", "odd", codes=(2,))
    said += run(folder, foreign, "make", "drive/design.toml", "-o", "cut", "--formats", "dxf", "--kerf-mm", "7",
                codes=(1, 2))
    said += run(folder, foreign, "loop", "pair.toml", "traces.csv", "--gear", "pinion", "-o", "traces", codes=(0, 1))
    said += run(folder, foreign, "make", EXAMPLES / "boxed_pair/design.toml", "-o", "boxed", "--formats", "pdf",
                "--tolerance-um", "20")
    run(folder, foreign, "search", "needs.toml", "-o", "found", "--threads", "1", "-q")
    return said


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    foreign_locale.make(OUTPUT)
    said = [all_commands(OUTPUT / name, foreign) for name, foreign in (("plain", False), ("foreign", True))]
    other = [pair for pair in zip(*(text.splitlines() for text in said)) if pair[0] != pair[1]]
    assert said[0] == said[1], f"the commands say something else: {other[:3]}"
    files = sorted(p.relative_to(OUTPUT / "plain") for p in (OUTPUT / "plain").rglob("*") if p.is_file())
    assert files == sorted(p.relative_to(OUTPUT / "foreign") for p in (OUTPUT / "foreign").rglob("*") if p.is_file())
    assert {f.suffix for f in files} >= {".html", ".svg", ".json", ".step", ".toml", ".csv", ".3mf", ".pdf", ".dxf", ".scad", ".journal"}, files
    differ = [str(f) for f in files
              if (OUTPUT / "plain" / f).read_bytes() != (OUTPUT / "foreign" / f).read_bytes()]
    assert not differ, f"the locale changes {differ}"


if __name__ == "__main__":
    main()
