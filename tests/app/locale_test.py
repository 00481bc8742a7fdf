# SPDX-License-Identifier: GPL-3.0-or-later
"""Under a locale with decimal commas, set by a host program, everything is read and written as without.

The locale is made here (`localedef`), so that none need be installed; a small library sets it in the
program before main().
"""
import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "locale"
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
SETTER = sys.argv[1]
LOCALE = """comment_char %
escape_char /
LC_NUMERIC
decimal_point ","
thousands_sep "."
grouping 3;3
END LC_NUMERIC
"""
NEEDS = """format = 1
name = "small"
[gearbox]
kind = "3k"
[ratio]
min = 96.2
max = 96.3
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 39
planet1_max = 39
[search]
results = 1
"""
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


def environment(comma):
    plain = {key: value for key, value in os.environ.items() if not key.startswith("LC_")}
    if comma:
        plain |= {"LOCPATH": str(OUTPUT), "COMMA_LOCALE": "comma_XX", "LD_PRELOAD": SETTER,
                  "ASAN_OPTIONS": "verify_asan_link_order=0:detect_leaks=0"}
    return plain


def run(folder, comma, *arguments, codes=(0,)):
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          env=environment(comma))
    assert done.returncode in codes, (arguments, comma, done.returncode, done.stderr)
    return done.stdout + done.stderr


def all_commands(folder, comma):
    """What each command says; its files lie in the folder."""
    folder.mkdir()
    shutil.copytree(EXAMPLES / "bilateral_drive", folder / "drive")
    (folder / "needs.toml").write_text(NEEDS)
    (folder / "pair.toml").write_text(PAIR)
    (folder / "other.toml").write_text(PAIR.replace("[pinion]", "[pinion]\nshift = 0.02"))
    said = run(folder, comma, "check", "drive/design.toml", "--json", "report.json", "--tolerance", "7")
    said += run(folder, comma, "make", "drive/design.toml", "-o", "parts", "--formats",
                "stl,3mf,obj,ply,glb,step,dxf,svg,scad", "--tolerance-um", "5")
    said += run(folder, comma, "loop", "drive/design.toml", "drive/measured.csv", "-o", "loop", codes=(0, 1))
    for name in ("pair", "other"):
        said += run(folder, comma, "make", f"{name}.toml", "-o", name, "--formats", "obj,3mf", "--tolerance-um", "5",
                    "--allow-failing")
    said += run(folder, comma, "compare", "pair/pinion.obj", "other/pinion.3mf", "--picture", "difference.svg",
                codes=(0, 1))
    run(folder, comma, "search", "needs.toml", "-o", "found", "--threads", "1", "-q")
    return said


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    (OUTPUT / "comma.def").write_text(LOCALE)
    subprocess.run(["localedef", "--no-archive", "-c", "-i", "./comma.def", "./comma_XX"], cwd=OUTPUT,
                   capture_output=True)  # it ends with 1: there are categories that this locale lacks
    assert (OUTPUT / "comma_XX/LC_NUMERIC").exists(), "localedef made no locale"
    said = [all_commands(OUTPUT / name, comma) for name, comma in (("point", False), ("comma", True))]
    other = [pair for pair in zip(*(text.splitlines() for text in said)) if pair[0] != pair[1]]
    assert said[0] == said[1], f"the commands say something else: {other[:3]}"
    files = sorted(p.relative_to(OUTPUT / "point") for p in (OUTPUT / "point").rglob("*") if p.is_file())
    assert files == sorted(p.relative_to(OUTPUT / "comma") for p in (OUTPUT / "comma").rglob("*") if p.is_file())
    assert {f.suffix for f in files} >= {".html", ".svg", ".json", ".step", ".toml", ".csv", ".3mf"}, files
    differ = [str(f) for f in files
              if (OUTPUT / "point" / f).read_bytes() != (OUTPUT / "comma" / f).read_bytes()
              and f.suffix != ".journal"]
    assert not differ, f"decimal commas change {differ}"


if __name__ == "__main__":
    main()
